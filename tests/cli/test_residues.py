"""segment and hierarchy with --residues: the residues and atoms at the segments of a molecular surface."""

import collections
import csv
import math
import re
import unittest

from support import ProgramTest
from test_molecule import atom


def rows_of(path):
    """Rows of a table below comment lines."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def cif(rows):
    """An mmCIF file of atoms: (chain, residue, number, atom, position)."""
    text = "data_x\nloop_\n" + "".join(f"_atom_site.{name}\n" for name in (
        "id", "type_symbol", "label_atom_id", "auth_comp_id", "auth_asym_id", "auth_seq_id", "Cartn_x",
        "Cartn_y", "Cartn_z"))
    for serial, (chain, residue, number, name, position) in enumerate(rows, 1):
        text += f"{serial} C {name} {residue} {chain} {number} {position[0]} {position[1]} {position[2]}\n"
    return text


class Residues(ProgramTest):
    def setUp(self):
        super().setUp()
        # Three atoms in a row, far enough apart to be three bumps of one surface.
        self.atoms = [((0, 0, 0), "GLY", 1), ((2.6, 0, 0), "SER", 2), ((5.2, 0, 0), "LEU", 3)]
        self.pdb = self.file("row.pdb", "".join(
            atom(i + 1, p, residue=residue, number=number)
            for i, (p, residue, number) in enumerate(self.atoms)))
        self.morsel("molecule", self.pdb, "-o", "row.off", "--kind", "vdw", "--resolution", "0.25")

    def segment(self, out, *options, code=0):
        return self.morsel("segment", "row.off", "--field", "height:axis=x", "--by", "ascending", "-o",
                           "s.txt", "--molecule", self.pdb, "--residues", out, *options, code=code)

    def labels(self):
        return [int(line) for line in (self.folder / "s.faces.txt").read_text().splitlines()
                if not line.startswith("#")]

    def nearest(self):
        """By brute force: (segment, atom) and its area."""
        lines = [line.split() for line in (self.folder / "row.off").read_text().splitlines()
                 if line and not line.startswith("#")][1:]
        count, faces = int(lines[0][0]), int(lines[0][1])
        points = [tuple(map(float, line)) for line in lines[1:1 + count]]
        triangles = [tuple(map(int, line[1:])) for line in lines[1 + count:1 + count + faces]]
        own = [min(range(3), key=lambda i, p=p: math.dist(p, self.atoms[i][0])) for p in points]
        areas = collections.Counter()
        for label, corners in zip(self.labels(), triangles):
            a, b, c = (points[v] for v in corners)
            u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            for corner in corners:
                areas[label, own[corner]] += math.hypot(*cross) / 6
        return areas

    def test_rows_are_the_nearest_atoms_and_their_areas(self):
        said = self.segment("r.csv", "--segments", "2").stderr
        self.assertIn("3 of 3 atoms are at the surface", said)
        rows = rows_of(self.folder / "r.csv")
        expected = self.nearest()
        self.assertEqual({(int(row["segment"]), int(row["serial"]) - 1) for row in rows}, set(expected))
        for row in rows:
            i = int(row["serial"]) - 1
            self.assertAlmostEqual(float(row["area"]), expected[int(row["segment"]), i], places=9)
            self.assertEqual((row["chain"], row["residue"], row["sequence_id"], row["atom"], row["element"]),
                             ("A", self.atoms[i][1], str(self.atoms[i][2]), "C", "C"))

    def test_scripts(self):
        self.segment("r.pml")
        script = (self.folder / "r.pml").read_text()
        self.assertRegex(script, r"(?m)^select segment_0, \(chain A and resi [123+]+\)$")
        self.assertRegex(script, r"(?m)^set_color segment_0_color, \[0\.\d+, 0\.\d+, 0\.\d+\]$")
        self.assertRegex(script, r"(?m)^color segment_0_color, \(chain A and resi [123+]+\)$")
        self.segment("r.cxc")
        script = (self.folder / "r.cxc").read_text()
        self.assertRegex(script, r"(?m)^name segment_0 /A:[123,]+$")
        self.assertRegex(script, r"(?m)^color /A:[123,]+ #[0-9a-f]{6}$")

    def test_the_segment_is_the_temperature_factor(self):
        self.segment("r.pdb")
        self.segment("r.csv")
        areas = collections.defaultdict(dict)
        for row in rows_of(self.folder / "r.csv"):
            areas[int(row["serial"])][int(row["segment"])] = float(row["area"])
        lines = [line for line in (self.folder / "r.pdb").read_text().splitlines()
                 if line.startswith("ATOM")]
        self.assertEqual(len(lines), 3)
        for i, line in enumerate(lines):
            own = areas[int(line[6:11])]
            self.assertEqual(float(line[60:66]), max(own, key=lambda s, own=own: (own[s], -s)))
            self.assertEqual(line[30:54], "".join(f"{x:8.3f}" for x in self.atoms[i][0]))
            self.assertEqual(line[17:26], f"{self.atoms[i][1]} A{self.atoms[i][2]:4}")
        # What was written is read again.
        self.morsel("molecule", "r.pdb", "-o", "again.off", "--kind", "vdw", "--resolution", "0.25")

    def test_an_atom_within_has_no_segment(self):
        around = [(2, 0, 0), (-2, 0, 0), (0, 2, 0), (0, -2, 0), (0, 0, 2), (0, 0, -2), (0, 0, 0)]
        around += [(x, y, z) for x in (-1.3, 1.3) for y in (-1.3, 1.3) for z in (-1.3, 1.3)]
        pdb = self.file("ball.pdb", "".join(atom(i + 1, p) for i, p in enumerate(around)))
        self.morsel("molecule", pdb, "-o", "ball.off", "--kind", "vdw")
        said = self.morsel("segment", "ball.off", "-o", "s.txt", "--molecule", pdb, "--residues",
                           "b.pdb").stderr
        self.assertIn("14 of 15 atoms are at the surface", said)
        factors = [line[60:66] for line in (self.folder / "b.pdb").read_text().splitlines()
                   if line.startswith("ATOM")]
        self.assertEqual([i for i, factor in enumerate(factors) if float(factor) == -1], [6])

    def test_levels_of_a_hierarchy(self):
        hierarchy = ("hierarchy", "row.off", "--field", "height:axis=x", "--levels", "0,2", "--molecule",
                     self.pdb, "--residues")
        self.morsel(*hierarchy, "h.csv", "--cells", "ascending")
        self.assertEqual({row["level"] for row in rows_of(self.folder / "h.csv")}, {"0", "1"})
        self.morsel(*hierarchy, "h.pml")
        self.assertIn("select level_1_segment_0, ", (self.folder / "h.pml").read_text())
        self.morsel(*hierarchy, "h.pdb")
        text = (self.folder / "h.pdb").read_text()
        self.assertIn("MODEL        2\n", text)
        self.assertEqual(text.count("ENDMDL\n"), 2)
        self.assertIn("(one of 2 models)", self.morsel("molecule", "h.pdb", "-o", "x.off").stderr)

    def test_names_cannot_inject_commands(self):
        hostile = ["'A;\nquit\n'", "\"B) or all; shell rm\"", "'/C:1 #ff0000; close'", "A", "\"'\""]
        rows = [(chain, "\"G;L\"", "'1+2)'" if i == 3 else i + 1, "\"C;\"", (2.6 * i, 0, 0))
                for i, chain in enumerate(hostile) if "\n" not in chain]
        pdb = self.file("hostile;quit.cif", cif(rows))
        self.morsel("molecule", pdb, "-o", "hostile.off", "--kind", "vdw")
        for kind, command in (("pml", r"(select|color|set_color) [a-z0-9_]+, [][a-zA-Z0-9_()+., ]+"),
                              ("cxc", r"(name [a-z0-9_]+ |color )[@/:|=, a-zA-Z0-9_]+( #[0-9a-f]{6})?")):
            self.morsel("segment", "hostile.off", "-o", "s.txt", "--molecule", pdb, "--residues",
                        f"h.{kind}")
            lines = (self.folder / f"h.{kind}").read_text().splitlines()
            for line in lines:
                self.assertNotIn(";", line)
                if not line.startswith("# "):
                    self.assertRegex(line, f"^{command}$")
            self.assertTrue(any("quit" in line and line.startswith("# ") for line in lines))
        result = self.morsel("segment", "hostile.off", "-o", "s.txt", "--molecule", pdb, "--residues",
                             "h.pdb", code=3)
        self.assertIn("does not fit into a PDB file", result.stderr)
        self.morsel("segment", "hostile.off", "-o", "s.txt", "--molecule", pdb, "--residues", "h.csv")
        self.assertEqual({row["chain"].lstrip("'") for row in rows_of(self.folder / "h.csv")},
                         {"B) or all; shell rm", "/C:1 #ff0000; close", "A", ""})

    def test_the_same_atoms_as_the_surface(self):
        file = self.file("ion.pdb", atom(1, (0, 0, 0)) + atom(2, (20, 0, 0), name="CLA", residue="CLA",
                                                             element="CL"))
        self.morsel("molecule", file, "-o", "ion.off", "--hetero", "all")
        segment = ("segment", "ion.off", "-o", "s.txt", "--molecule", file, "--residues", "i.csv")
        said = self.morsel(*segment).stderr
        self.assertRegex(said, r"[\d,]+ of [\d,]+ vertices are more than 5 Å from all atoms")
        self.assertEqual({row["residue"] for row in rows_of(self.folder / "i.csv")}, {"GLY"})
        said = self.morsel(*segment, "--atoms", "hetero=all").stderr
        self.assertNotIn("5 Å", said)
        self.assertEqual({row["residue"] for row in rows_of(self.folder / "i.csv")}, {"GLY", "CLA"})
        self.morsel(*segment, "--atoms", "select=chain A and not ion")
        self.assertIn("hetero", self.morsel(*segment, "--atoms", "hetero=some", code=2).stderr)
        self.assertIn("no parameter", self.morsel(*segment, "--atoms", "color=red", code=2).stderr)

    def test_what_is_refused(self):
        self.assertIn(".pml", self.segment("r.txt", code=2).stderr)
        result = self.morsel("segment", "row.off", "-o", "s.txt", "--residues", "r.csv", code=2)
        self.assertIn("--molecule", result.stderr)
        far = self.file("far.pdb", atom(1, (900, 0, 0)))
        result = self.morsel("segment", "row.off", "-o", "s.txt", "--molecule", far, "--residues", "r.csv",
                             code=3)
        self.assertIn("no vertex of the mesh lies within 5 Å", result.stderr)
        self.assertIn("--molecule", self.segment("row.pdb", code=2).stderr)
        self.assertFalse(re.search("Traceback|terminate", result.stderr))


if __name__ == "__main__":
    unittest.main()
