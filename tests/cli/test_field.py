"""morsel field: fields written and read back."""

import json
import math
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, data_lines
from test_points import read_ply
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


class Field(ProgramTest):
    def values(self, name):
        return [float(line) for line in data_lines(self.folder / name)]

    def test_text_has_a_value_a_line(self):
        self.morsel("field", self.file("o.off", OCTAHEDRON), "--field", "height:axis=z", "-o", "z.txt")
        self.assertEqual(self.values("z.txt"), [1, -1, 0, 0, 0, 0])

    def test_a_dropped_vertex_is_nan_and_numbers_are_the_inputs(self):
        mesh = self.file("d.off", DAMAGED)
        self.morsel("field", mesh, "--repair", "--field", "height:axis=x", "-o", "x.txt")
        x = self.values("x.txt")
        self.assertTrue(math.isnan(x[1]))
        self.assertEqual(x[:1] + x[2:], [0, 1, 1, 0])
        # and such a file can be a field again
        report = self.report(mesh, "--repair", "--field", "vertex-scalar:file=x.txt", "--method",
                             "conventional")
        self.assertEqual((report["field"]["min"], report["field"]["max"]), (0, 1))

    def test_text_and_ply_read_back_to_the_same_bits(self):
        lion = SAMPLES / "lion-head.off"
        self.morsel("field", lion, "-o", "h.txt")
        self.morsel("field", lion, "-o", "h.ply")
        self.morsel("field", lion, "--field", "vertex-scalar:file=h.txt", "-o", "again.txt")
        self.assertEqual(data_lines(self.folder / "h.txt"), data_lines(self.folder / "again.txt"))
        self.morsel("field", "h.ply", "--field", "vertex-scalar:property=mean-curvature", "-o",
                    "from_ply.txt")
        self.assertEqual(data_lines(self.folder / "h.txt"), data_lines(self.folder / "from_ply.txt"))

    def test_ply_has_quality_and_colours_for_meshlab_and_blender(self):
        mesh = self.file("d.off", DAMAGED)
        self.morsel("field", mesh, "--repair", "--field", "height:axis=x", "-o", "x.ply")
        rows = read_ply(self.folder / "x.ply")
        self.assertEqual(list(rows[0]), ["x", "y", "z", "height", "quality", "red", "green", "blue"])
        self.assertEqual([row["quality"] for row in rows[:1] + rows[2:]], [0, 1, 1, 0])
        colors = [(row["red"], row["green"], row["blue"]) for row in rows]
        self.assertTrue(math.isnan(rows[1]["quality"]))
        self.assertEqual(colors[1], (128, 128, 128))  # dropped
        self.assertEqual((colors[0], colors[2]), (colors[4], colors[3]))
        self.assertEqual(len(set(colors)), 3)
        # the ends of the colour map of pictures
        self.morsel("field", self.file("o.off", OCTAHEDRON), "--field", "height:axis=z", "-o", "z.ply")
        low, middle, high = ([row[channel] for channel in ("red", "green", "blue")]
                             for row in (read_ply(self.folder / "z.ply")[v] for v in (1, 2, 0)))
        self.assertGreater(min(middle), 235)  # diverging, white in the middle
        self.assertEqual((low[2] > low[0] + 80, high[0] > high[2] + 80), (True, True))  # blue, orange
        # colours are properties as others are, and the field is found by its name
        self.assertEqual(json.loads(self.morsel("info", "z.ply", "--json").stdout)["vertex_properties"],
                         ["height", "quality", "red", "green", "blue"])

    def test_colours_of_values_of_any_size(self):
        self.file("v.txt", "1.7e308\n-1.7e308\n0\n0\n1e308\n-1e308\n")
        self.morsel("field", self.file("o.off", OCTAHEDRON), "--field", "vertex-scalar:file=v.txt", "-o",
                    "v.ply")
        rows = read_ply(self.folder / "v.ply")
        self.assertEqual([row["quality"] for row in rows], [1.7e308, -1.7e308, 0, 0, 1e308, -1e308])
        self.assertEqual(len({(row["red"], row["green"], row["blue"]) for row in rows}), 5)

    def test_a_method_can_be_applied(self):
        self.morsel("field", SAMPLES / "lion-head.off", "--method", "salient:iterations=1", "-o", "s.txt")
        self.morsel("field", SAMPLES / "lion-head.off", "-o", "h.txt")
        self.assertLess(max(self.values("s.txt")), max(self.values("h.txt")))

    def test_chosen_points_are_marked_and_listed(self):
        lion = SAMPLES / "lion-head.off"
        words = ("--method", "salient", "--points", 12, "--spacing", "3%")
        said = self.morsel("field", lion, *words, "-o", "s.vtp", "--json", "p.json").stderr
        self.assertIn("points: 12, at least ", said)
        self.assertIn("points: p.json\n", said)
        document = json.loads((self.folder / "p.json").read_text())
        jsonschema.validate(document, json.loads((SCHEMA.parent / "points.schema.json").read_text()))
        self.morsel("points", lion, "--field", "mean-curvature", *words, "--fill", "none", "-o", "alone.json")
        alone = json.loads((self.folder / "alone.json").read_text())
        self.assertEqual(document["points"], alone["points"])
        order = {point["vertex"]: i + 1 for i, point in enumerate(alone["points"])}
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "s.vtp"))
        reader.Update()
        chosen = reader.GetOutput().GetPointData().GetArray("chosen")
        self.assertEqual({v: int(chosen.GetValue(v)) for v in range(chosen.GetNumberOfTuples())
                          if chosen.GetValue(v) > 0}, order)
        # a property that can be a field again
        self.morsel("field", lion, *words, "-o", "s.ply")
        self.morsel("field", "s.ply", "--field", "vertex-scalar:property=chosen", "-o", "chosen.txt")
        self.assertEqual({v: int(x) for v, x in enumerate(self.values("chosen.txt")) if x > 0}, order)
        # the field itself is the same
        self.morsel("field", lion, *words, "-o", "with.txt", "--json", "-")
        self.morsel("field", lion, "--method", "salient", "-o", "without.txt")
        self.assertEqual(self.values("with.txt"), self.values("without.txt"))

    def test_chosen_points_have_the_inputs_numbers(self):
        mesh = self.file("d.off", DAMAGED)
        self.morsel("field", mesh, "--repair", "--field", "height:axis=x", "--points", 5, "--kind", "all",
                    "--spacing", 0, "-o", "x.vtp", "--json", "p.json")
        points = json.loads((self.folder / "p.json").read_text())["points"]
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "x.vtp"))
        reader.Update()
        chosen = reader.GetOutput().GetPointData().GetArray("chosen")
        marked = [int(chosen.GetValue(v)) for v in range(chosen.GetNumberOfTuples())]
        self.assertEqual([marked.index(i + 1) for i in range(len(points))], [p["vertex"] for p in points])

    def test_points_that_no_file_would_hold_are_refused(self):
        mesh = self.file("o.off", OCTAHEDRON)
        error = self.morsel("field", mesh, "--points", 3, "-o", "x.txt", code=2).stderr
        self.assertIn("--json", error)
        for more in (("-o", "x.txt", "--json", "p.json"), ("-o", "x.ply", "--kind", "all")):
            self.assertIn("--points", self.morsel("field", mesh, *more, code=2).stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["o.off"])

    def test_an_unknown_ending_is_refused(self):
        result = self.morsel("field", self.file("o.off", OCTAHEDRON), "-o", "x.csv", code=2)
        self.assertIn(".vtp", result.stderr)


if __name__ == "__main__":
    unittest.main()
