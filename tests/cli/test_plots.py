"""The plots of compare --figures, read by readers of their own: XML and VTK's PNG reader."""

import math
import re
import struct
import unittest
import xml.etree.ElementTree as xml
import zlib

from support import OCTAHEDRON, SAMPLES, ProgramTest, made_in
from vtkmodules.vtkIOImage import vtkPNGReader

SVG = "{http://www.w3.org/2000/svg}"


def groups(svg):
    """The series of an SVG: (name, path elements) in order."""
    return [(group.findtext(f"{SVG}title"), group.findall(f"{SVG}path")) for group in svg.iter(f"{SVG}g")]


def marks(path):
    """Where the shapes of a path begin."""
    return [tuple(map(float, start)) for start in re.findall(r"M(\S+) ([-\d.]+)", path.get("d"))]


def texts(svg):
    return [element.text for element in svg.iter(f"{SVG}text")]


def pixels(path):
    """Rows of RGB bytes, by zlib alone: enough of PNG for 8-bit RGB."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, body, head = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + chunk) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            body += chunk
        at += 12 + length
    width, height, depth, color = head[:4]
    assert (depth, color) == (8, 2), head
    assert len(zlib.decompress(body)) == height * (3 * width + 1)
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    assert reader.GetOutput().GetDimensions() == (width, height, 1)
    assert scalars.GetNumberOfComponents() == 3
    return width, height, bytes(memoryview(scalars))


class Plots(ProgramTest):
    def compare(self, *arguments, folder="plots"):
        report = self.report(*arguments, "--figures", folder, "--size", "120x84")
        return report, {path.name: path for path in made_in(self.folder / folder)}

    def test_the_lions_plots_show_what_the_report_says(self):
        report, files = self.compare(SAMPLES / "lion-head.off")
        names = ["conventional", "salient", "tps"]
        pictures = {"sheet.png", *(f"{name}.png" for name in names)}
        self.assertEqual(set(files), set(f"{n}.{e}" for e in ("svg", "png") for n in (
            *(f"{m}.diagram" for m in names), "diagrams", "persistence", "iterations")) | pictures)
        titles = report["request"]["methods"]
        for method, title in zip(report["methods"], titles):
            svg = xml.parse(files[f"{method['name']}.diagram.svg"]).getroot()
            listed = [item["kind"] for item in method["persistence"]["diagram"]]
            drawn = {name.split(" (")[0]: (name, len(marks(path))) for name, (path,) in groups(svg) if name}
            for kind, name in (("minimum-saddle", "minimum–saddle"), ("saddle-maximum", "saddle–maximum"),
                               ("essential-minimum", "essential")):
                count = listed.count(kind)
                self.assertEqual(drawn.pop(name), (f"{name} ({count})", count))
            self.assertEqual(drawn, {})
            self.assertIn(title, texts(svg))
        sheet = xml.parse(files["diagrams.svg"]).getroot()
        for method, title in zip(report["methods"], titles):
            self.assertIn(title, texts(sheet))
            self.assertIn(f"{method['persistence']['pairs']:,} pairs, 1 essential", texts(sheet))
        self.assertIn("mean curvature at birth", texts(sheet))

    def test_the_line_of_iterations_goes_through_the_reports_counts(self):
        report, files = self.compare(SAMPLES / "lion-head.off", "--method", "salient:iterations=4")
        svg = xml.parse(files["iterations.svg"]).getroot()
        (name, paths), = groups(svg)
        self.assertEqual(name, "salient:iterations=4")
        counts = [record["total"] for record in report["methods"][0]["iterations"]]
        self.assertEqual(len(counts), 5)
        dots = marks(paths[-1])
        self.assertEqual(len(dots), 5)
        for (x, _), (after, _) in zip(dots, dots[1:]):
            self.assertAlmostEqual(after - x, dots[1][0] - dots[0][0], delta=0.03)
        down = dots[-1][1] - dots[0][1]
        for (_, y), count in zip(dots, counts):
            share = math.log(count / counts[0]) / math.log(counts[-1] / counts[0])
            self.assertAlmostEqual(y, dots[0][1] + share * down, delta=0.03)

    def test_the_curve_of_persistence_starts_at_all_pairs_and_ends_at_one(self):
        _, files = self.compare(SAMPLES / "lion-head.off", "--method", "conventional")
        svg = xml.parse(files["persistence.svg"]).getroot()
        (_, (path,)), = groups(svg)
        points = [float(n) for n in re.findall(r"-?[\d.]+", path.get("d"))]
        frame = next(r for r in svg.iter(f"{SVG}rect") if r.get("stroke"))
        self.assertAlmostEqual(points[0], float(frame.get("x")), delta=0.02)
        one = [e for e in svg.iter(f"{SVG}text") if e.text == "1" and e.get("text-anchor") == "end"]
        self.assertAlmostEqual(points[-1], float(one[0].get("y")) - 0.365 * 7, delta=0.05)

    def test_pictures_are_of_the_size_and_not_blank(self):
        _, files = self.compare(self.file("o.off", OCTAHEDRON), "--field", "height")
        for name, expected in (("diagrams.png", 2150), ("persistence.png", 1050), ("tps.diagram.png", 1050)):
            width, height, data = pixels(files[name])
            self.assertEqual(width, expected)
            self.assertGreater(height, 0.2 * width)
            colors = {data[i:i + 3] for i in range(0, len(data), 3)}
            self.assertIn(b"\xff\xff\xff", colors)
            self.assertGreater(len(colors), 50)
            # A margin of 6 points of 1/72 inch at 300 pixels an inch, of which numbers at the ends of axes
            # take half.
            row, margin = 3 * width, 10
            self.assertEqual(set(data[:margin * row]) | set(data[-margin * row:]), {0xff})
            for y in range(0, height, 7):
                line = data[y * row:(y + 1) * row]
                self.assertEqual(set(line[:3 * margin]) | set(line[-3 * margin:]), {0xff}, (name, y))

    def test_a_field_without_pairs_has_plots_of_its_essential_classes(self):
        _, files = self.compare(self.file("o.off", OCTAHEDRON), "--field", "height", "--method",
                                "conventional")
        self.assertNotIn("iterations.svg", files)
        svg = xml.parse(files["conventional.diagram.svg"]).getroot()
        named = [(name, paths) for name, paths in groups(svg) if name]
        self.assertEqual([name for name, _ in named], ["essential (2)"])
        self.assertEqual(len(marks(named[0][1][0])), 2)
        self.assertIn("0 pairs, 2 essential", texts(svg))
        xml.parse(files["persistence.svg"])

    def test_the_same_bytes_at_any_number_of_threads(self):
        made = []
        for threads in (1, 2, 7):
            _, files = self.compare(SAMPLES / "lion-head.off", "--threads", threads, folder=f"t{threads}")
            made.append({name: path.read_bytes() for name, path in files.items()})
        self.assertEqual(made[0], made[1])
        self.assertEqual(made[0], made[2])

    def test_methods_of_one_name_get_files_of_their_own(self):
        _, files = self.compare(self.file("o.off", OCTAHEDRON), "--method", "tps", "--method",
                                "tps:threshold=1%")
        self.assertIn("tps.diagram.svg", files)
        self.assertIn("tps-2.diagram.svg", files)

    def test_a_folder_that_cannot_be_written_is_refused_before_the_work(self):
        self.file("taken", "")
        # The mesh does not exist: that would be reported, by another code, if work had begun.
        result = self.morsel("compare", "no-such-mesh.off", "--figures", "taken", code=4)
        self.assertIn("taken", result.stderr)
        self.morsel("compare", "no-such-mesh.off", "--figures", "taken/below", code=4)
        self.morsel("compare", "no-such-mesh.off", "--figures", "/proc/no", code=4)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["taken"])


if __name__ == "__main__":
    unittest.main()
