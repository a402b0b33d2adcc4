"""Vertices that a mask, or a field without values, leaves out of a mesh."""

import json
import unittest

import jsonschema
from support import SCHEMA, ProgramTest
from test_weld import parsed

SIDE = 9


def bumps():
    """A square of SIDE × SIDE vertices."""
    positions = [f"{x} {y} {(x * 7 + y * 5) % 4}" for y in range(SIDE) for x in range(SIDE)]
    faces = []
    for y in range(SIDE - 1):
        for x in range(SIDE - 1):
            v = y * SIDE + x
            faces += [f"3 {v} {v + 1} {v + SIDE + 1}", f"3 {v} {v + SIDE + 1} {v + SIDE}"]
    return f"OFF\n{len(positions)} {len(faces)} 0\n" + "\n".join(positions + faces) + "\n"


def without(off, gone):
    """The mesh as a file of its own, and its vertices' numbers in the whole."""
    positions, faces = parsed(off)
    faces = [face for face in faces if not set(face) & gone]
    numbers = sorted({v for face in faces for v in face})
    place = {v: i for i, v in enumerate(numbers)}
    text = (f"OFF\n{len(numbers)} {len(faces)} 0\n" + "".join(positions[v] + "\n" for v in numbers) +
            "".join("3 " + " ".join(str(place[v]) for v in face) + "\n" for face in faces))
    return text, numbers


class Mask(ProgramTest):
    def setUp(self):
        super().setUp()
        self.off = bumps()
        self.gone = set(range(2 * SIDE)) | {40}  # two rows and a hole
        self.mesh = self.file("whole.off", self.off)
        part, self.numbers = without(self.off, self.gone)
        self.part = self.file("part.off", part)
        kept = ["0" if v in self.gone else "1" for v in range(SIDE * SIDE)]
        self.mask = self.file("mask.txt", "\n".join(kept) + "\n")
        values = ["nan" if v in self.gone else str(v * 37 % 23) for v in range(SIDE * SIDE)]
        self.values = self.file("values.txt", "\n".join(values) + "\n")
        self.told = ["the mask mask.txt is 0 or nan at 19 of 81 vertices",
                     "19 of 81 vertices and 38 faces were left out"]

    def items(self, *arguments):
        report = self.report(*arguments, "--method", "conventional")
        return report, [(item["type"], item["vertex"]) for item in report["methods"][0]["items"]]

    def test_results_are_those_of_the_part(self):
        for field in ("height:axis=z", "mean-curvature", "geodesic:source=64"):
            with self.subTest(field):
                of_part = field.replace("=64", f"={self.numbers.index(64)}")
                _, part = self.items(self.part, "--field", of_part)
                report, whole = self.items(self.mesh, "--mask", "mask.txt", "--field", field)
                self.assertEqual(whole, [(kind, self.numbers[v]) for kind, v in part])
                self.assertEqual(report["mesh"]["warnings"], self.told)
                self.assertEqual(report["request"]["mask"], "file=mask.txt")
                self.assertIn({"action": "left_out_vertices", "count": 19}, report["mesh"]["repairs"])
                jsonschema.validate(report, json.loads(SCHEMA.read_text()))

    def test_a_written_field_has_nan_there(self):
        self.morsel("field", self.mesh, "--mask", "mask.txt", "--field", "height", "-o", "f.txt")
        lines = [line for line in (self.folder / "f.txt").read_text().split("\n")
                 if line and not line.startswith("#")]
        self.assertEqual({v for v, line in enumerate(lines) if line == "nan"}, self.gone)

    def test_values_that_are_nan_leave_vertices_out_in_every_command(self):
        field = ("--field", "vertex-scalar:file=values.txt")
        told = ("morsel: warning: values.txt has no value (nan) at 19 of 81 vertices\n"
                "morsel: warning: 19 of 81 vertices and 38 faces were left out\n")
        for line in (("compare", self.mesh, "-o", "c.json"), ("field", self.mesh, "-o", "f.txt"),
                     ("points", self.mesh, "-o", "p.csv", "--points", "3", "--fill", "none"),
                     ("segment", self.mesh, "-o", "s.txt"), ("hierarchy", self.mesh, "-o", "h.json"),
                     ("cut", self.mesh, "-o", "cut.off"),
                     ("sweep", self.mesh, "-o", "w.json", "--method", "salient", "--vary", "iterations=1,2"),
                     ("stability", self.mesh, "-o", "st.json", "--trials", "1")):
            with self.subTest(line[0]):
                self.assertIn(told, self.morsel(*line, *field).stderr)
        values = (self.folder / "values.txt").read_text().split()
        self.file("part.txt", "\n".join(values[v] for v in self.numbers) + "\n")
        _, part = self.items(self.part, "--field", "vertex-scalar:file=part.txt")
        _, whole = self.items(self.mesh, *field)
        self.assertEqual(whole, [(kind, self.numbers[v]) for kind, v in part])
        self.assertIn("unchanged", self.morsel("check", "report.json").stdout)

    def test_check_runs_it_again_and_sees_another_mask(self):
        self.items(self.mesh, "--mask", "mask.txt", "--field", "height")
        self.assertIn("unchanged", self.morsel("check", "report.json").stdout)
        self.file("mask.txt", "1\n" * (SIDE * SIDE))
        self.assertIn("sha256", self.morsel("check", "report.json", code=1).stdout)
        report = json.loads((self.folder / "report.json").read_text())
        report["request"]["mask"] = "column=2"
        self.file("report.json", json.dumps(report))
        self.assertIn("mask", self.morsel("check", "report.json", code=3).stderr)

    def test_it_is_part_of_info_and_provenance(self):
        info = json.loads(self.morsel("info", "--json", self.mesh, "--mask", "mask.txt").stdout)
        self.assertEqual((info["mesh"]["vertices"], info["mesh"]["boundary_loops"]), (62, 2))
        self.morsel("field", self.mesh, "--mask", "mask.txt", "--field", "height", "-o", "f.ply")
        shown = json.loads(self.morsel("info", "--json", "f.ply").stdout)["provenance"]
        self.assertIn("--mask mask.txt", shown["command"])
        self.assertEqual(shown["request"]["mask"], "file=mask.txt")

    def test_batch_makes_it_again_for_another_mask(self):
        (self.folder / "meshes").mkdir()
        self.file("meshes/a.off", self.off)
        batch = ("batch", "meshes", "--out", "out", "--field", "height", "--method", "conventional",
                 "--no-thumbnails", "--mask", "mask.txt")
        self.assertIn("1 done", self.morsel(*batch).stdout + self.morsel(*batch).stderr)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["meshes"][0]["mesh"]["vertices"], 62)
        self.assertEqual(summary["request"]["mask"], "file=mask.txt")
        self.file("mask.txt", "1\n" * (SIDE * SIDE))
        self.morsel(*batch)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["meshes"][0]["mesh"]["vertices"], SIDE * SIDE)

    def test_what_cannot_be_a_mask_is_refused(self):
        for mask, code, text in (("column=2", 2, "names neither a file nor a property"),
                                 ("file=a,file=b", 2, '"file" twice'),
                                 ("missing.txt", 3, "missing.txt"),
                                 ("property=inside", 3, "which the mesh's file does not have"),
                                 ("short.txt", 3, "has 2 values, but the mesh's file has 81 vertices"),
                                 ("none.txt", 3, "no face is left")):
            self.file("short.txt", "1\n0\n")
            self.file("none.txt", "0\n" * (SIDE * SIDE))
            with self.subTest(mask):
                result = self.morsel("field", self.mesh, "--mask", mask, "--field", "height", "-o", "f.txt",
                                     code=code)
                self.assertIn(text, result.stderr)
                self.assertFalse((self.folder / "f.txt").exists())
        result = self.morsel("field", self.mesh, "--mask", "mask.txt", "--field", "height", "-o", "mask.txt",
                             code=2)
        self.assertIn("--mask mask.txt", result.stderr)
        self.file("inf.txt", "inf\n" * (SIDE * SIDE))
        result = self.morsel("field", self.mesh, "--field", "vertex-scalar:file=inf.txt", "-o", "f.txt",
                             code=3)
        self.assertIn("not finite", result.stderr)


if __name__ == "__main__":
    unittest.main()
