"""compare --html: the page's data, and that nothing in them escapes their elements."""

import json
import math
import re
import shlex
import subprocess
import unittest

from page_data import PageData
from support import DAMAGED, OCTAHEDRON, PROGRAM, SAMPLES, ProgramTest, data_lines
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

LION = SAMPLES / "lion-head.off"
TYPES = ["regular", "minimum", "saddle", "maximum"]


def exported_pieces(path, kind):
    """The straight pieces of all arcs of one kind in an exported complex, as pairs of positions."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    kinds = data.GetCellData().GetArray("kind")
    ends, points = data.GetLines().GetOffsetsArray(), data.GetLines().GetConnectivityArray()
    nodes = data.GetNumberOfVerts()
    for i in range(data.GetNumberOfLines()):
        if kinds.GetValue(nodes + i) != kind:
            continue
        line = [data.GetPoint(points.GetValue(k)) for k in range(ends.GetValue(i), ends.GetValue(i + 1))]
        yield from zip(line, line[1:])


def without_timings(text):
    """A page's text but for the seconds in its report."""
    return re.sub(r'"timings": \{.*?\n  \}', "", text, count=1, flags=re.DOTALL)


class Html(ProgramTest):
    def page(self, *arguments, name="page.html"):
        self.morsel("compare", *arguments, "--html", name)
        return PageData(self.folder / name)

    def test_the_page_holds_what_the_report_says(self):
        full = self.report(LION)
        page = self.page(LION)
        short = self.report(LION, "--no-items", name="short.json")
        del short["timings"]
        self.assertEqual({key: value for key, value in page.meta["report"].items() if key != "timings"},
                         short)
        self.assertEqual(page.meta["schema"], "morsel.page/1")
        self.assertEqual(len(page.methods), 3)
        for method, expected in zip(page.methods, full["methods"]):
            points = method["points"]
            for i, (item, persistence) in enumerate(zip(expected["items"], page.persistence(method),
                                                        strict=True)):
                told = (points["vertex"][i], TYPES[points["type"][i]], points["multiplicity"][i],
                        points["value"][i])
                self.assertEqual(told, (item["vertex"], item["type"], item["multiplicity"], item["value"]))
                self.assertEqual(points["origin"][i] - 1, -1 if item["origin"] is None else item["origin"])
                self.assertEqual(persistence, math.inf
                                 if item["persistence"] is None else item["persistence"])
                self.assertEqual(points["place"][i], item["vertex"])
            first = page.methods[0]["points"]["vertex"]
            matched = [(v, first[m - 1]) for v, m in zip(points["vertex"], points["match"]) if m > 0]
            kept = sum(a == b for a, b in matched)
            self.assertEqual((kept, len(matched) - kept),
                             (expected["compared_to_first"]["kept"], expected["compared_to_first"]["moved"]))
            self.assertEqual(len(method["pairs"]["saddle"]), expected["persistence"]["pairs"])
            segments = method["segments"]
            self.assertEqual({kind: len(set(labels)) for kind, labels in segments.items()},
                             {kind: expected["ms_complex"]["segments"][kind] for kind in segments})
            self.assertEqual(len(set(zip(segments["ascending"], segments["descending"]))),
                             expected["ms_complex"]["segments"]["morse_smale"])

    def test_what_is_rounded_is_near(self):
        page = self.page(LION)
        numbers = LION.read_text().split()
        vertices, triangles = int(numbers[1]), int(numbers[2])
        coordinates = [float(x) for x in numbers[4:4 + 3 * vertices]]
        for v in range(vertices):
            for c in range(3):
                self.assertLessEqual(abs(page.position(v)[c] - coordinates[3 * v + c]),
                                     0.5001 * page.mesh["step"])
        faces = [int(x) for x in numbers[4 + 3 * vertices:4 + 3 * vertices + 4 * triangles]]
        self.assertEqual(page.mesh["corners"], [x for i, x in enumerate(faces) if i % 4 != 0])
        self.morsel("field", LION, "-o", "f.txt")
        field = [float(line) for line in data_lines(self.folder / "f.txt")]
        values = page.methods[0]["values"]
        low, high = values["low"], values["high"]
        self.assertEqual(sum(f < low for f in field), round(0.005 * (vertices - 1)))
        self.assertEqual(sum(f > high for f in field), vertices - 1 - round(0.995 * (vertices - 1)))
        for f, step in zip(field, values["data"], strict=True):
            self.assertLessEqual(abs(low + (high - low) * step / 65535 - min(max(f, low), high)),
                                 (high - low) / 131000)

    def test_each_piece_of_the_arcs_is_there_once(self):
        self.morsel("compare", LION, "--method", "conventional", "--method", "salient", "--html", "page.html",
                    "--export", "out")
        page = PageData(self.folder / "page.html")
        cell = 8 * page.mesh["step"]  # far more than rounding, far less than pieces are long

        def rounded(pieces):
            return [tuple(tuple(round(x / cell) for x in end) for end in piece) for piece in pieces]

        for method in page.methods:
            for kind, number in (("descending", 4), ("ascending", 5)):
                got = list(page.pieces(method, kind))
                expected = list(exported_pieces(self.folder / "out" / f"{method['name']}.complex.vtp",
                                                number))
                # places that a rounding away lie in another cell are looked for in the cells around
                drawn = {}
                for piece in got:
                    drawn.setdefault(rounded([piece])[0], []).append(piece)

                def is_drawn(piece):
                    a, b = rounded([piece])[0]
                    shifts = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
                    if (a, b) in drawn:
                        return True
                    return any((tuple(p + q for p, q in zip(a, s)),
                                tuple(p + q for p, q in zip(b, t))) in drawn
                               for s in shifts for t in shifts)

                unique = set(expected)
                self.assertTrue(all(is_drawn(piece) for piece in unique))
                self.assertEqual(len(got), len(unique))

    def test_numbers_are_the_inputs_where_vertices_were_dropped(self):
        page = self.page(self.file("damaged.off", DAMAGED), "--repair", "--field", "height:axis=x",
                         "--method", "conventional")
        self.assertEqual(page.mesh["input_vertices"], [0, 2, 3, 4])
        self.assertIn("--repair", page.meta["command"])

    def test_snapped_points_are_where_they_came_from(self):
        report = self.report(LION, "--method", "salient", "--snap")
        page = self.page(LION, "--method", "salient", "--snap")
        for place, item in zip(page.methods[0]["points"]["place"], report["methods"][0]["items"],
                               strict=True):
            for x, y in zip(page.position(place), item["position"]):
                self.assertAlmostEqual(x, y, delta=page.mesh["step"])

    def test_names_cannot_break_out(self):
        names = ["</script><b>.off", "<!--<script>.off", "a'\"&amp;\\u003c\u2028\n.off"]
        (self.folder / "<").mkdir()
        plain = self.page(self.file("plain.off", OCTAHEDRON), "--field", "height:axis=z")
        for name in names:
            page = self.page(self.file(name, OCTAHEDRON), "--field", "height:axis=z")
            self.assertEqual(page.elements.tags, plain.elements.tags)
            self.assertTrue(page.meta["report"]["mesh"]["path"].endswith(name))
            self.assertNotIn("b", page.elements.tags)

    def test_bytes_that_are_no_text_are_replaced(self):
        path = bytes(self.folder) + b"/caf\xe9.off"
        with open(path, "wb") as file:
            file.write(OCTAHEDRON.encode())
        subprocess.run([PROGRAM, "compare", path, "--field", "height:axis=z", "--html", "page.html"],
                       cwd=self.folder, check=True, capture_output=True, timeout=240)
        page = PageData(self.folder / "page.html")
        self.assertTrue(page.meta["report"]["mesh"]["path"].endswith("caf\ufffd.off"))

    def test_nothing_is_asked_for_and_three_js_comes_with_its_licence(self):
        page = self.page(self.file("o.off", OCTAHEDRON), "--field", "height:axis=z")
        self.assertEqual([link for link in page.elements.links if not link.startswith(("#", "data:"))], [])
        self.assertIn("default-src 'none'", page.text)
        self.assertIn("three.js authors", page.text)
        self.assertIn("Permission is hereby granted", page.text)
        self.assertIn('REVISION="111"', page.three)

    def test_the_command_line_makes_the_page_again(self):
        mesh = self.file("it's $HOME.off", OCTAHEDRON)
        page = self.page(mesh, "--field", "height:axis=z", "--method", "conventional", "--method",
                         "tps:count=2", "--target", "2", "--points", "2", "--kind", "all", "--spacing", "1%",
                         "--fill", "height:axis=x", "--rank", "salience", "--salience-scale", "9%",
                         "--percentiles", "--threads", "1", name="a b.html")
        program, *arguments = shlex.split(page.meta["command"])
        self.assertEqual(program, "morsel")
        (self.folder / "a b.html").unlink()
        self.morsel(*arguments, "--threads", "3")
        self.assertEqual(without_timings((self.folder / "a b.html").read_text()), without_timings(page.text))

    def test_only_timings_differ_between_runs(self):
        one = self.page(LION, "--threads", "1").text
        four = self.page(LION, "--threads", "4").text
        self.assertIn('"timings"', one)
        self.assertNotIn('"timings"', without_timings(one))
        self.assertEqual(without_timings(one), without_timings(four))

    def test_an_unwritable_page_is_refused_before_the_work(self):
        self.file("taken", "")
        result = self.morsel("compare", "missing.off", "--html", "taken/page.html", code=4)
        self.assertIn("taken", result.stderr)

    def test_no_page_is_left_behind_by_a_failure(self):
        self.morsel("compare", "missing.off", "--html", "page.html", code=3)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_degenerate_fields_and_meshes_have_a_page(self):
        mesh = self.file("o.off", OCTAHEDRON)
        constant = self.file("c.txt", "1\n" * 6)
        page = self.page(mesh, "--field", f"vertex-scalar:file={constant}", "--method", "conventional")
        self.assertEqual(page.methods[0]["values"]["data"], [0] * 6)
        huge = self.file("h.txt", "-1.7e308\n1.7e308\n0\n0\n0\n0\n")
        page = self.page(mesh, "--field", f"vertex-scalar:file={huge}", "--method", "conventional")
        self.assertEqual(page.methods[0]["values"]["data"], [0, 65535, *[32768] * 4])
        json.dumps(page.meta, allow_nan=False)


if __name__ == "__main__":
    unittest.main()
