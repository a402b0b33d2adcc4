"""morsel field: fields written and read back."""

import math
import unittest

from support import DAMAGED, OCTAHEDRON, SAMPLES, ProgramTest, data_lines


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

    def test_a_method_can_be_applied(self):
        self.morsel("field", SAMPLES / "lion-head.off", "--method", "salient:iterations=1", "-o", "s.txt")
        self.morsel("field", SAMPLES / "lion-head.off", "-o", "h.txt")
        self.assertLess(max(self.values("s.txt")), max(self.values("h.txt")))

    def test_an_unknown_ending_is_refused(self):
        result = self.morsel("field", self.file("o.off", OCTAHEDRON), "-o", "x.csv", code=2)
        self.assertIn(".vtp", result.stderr)


if __name__ == "__main__":
    unittest.main()
