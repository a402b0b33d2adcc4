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


def pymol_selects(expression, atoms):
    """The serial numbers that a selection of PyMOL has, of atoms {serial: (chain, number)}."""
    found = set()
    for term in expression.split(" or "):
        if residues := re.fullmatch(r"\(chain (\w+) and resi ([\w+]+)\)", term):
            chain, numbers = residues.group(1), residues.group(2).split("+")
            found |= {serial for serial, atom in atoms.items() if atom[0] == chain and atom[1] in numbers}
            continue
        for run in re.fullmatch(r"\(id ([\d+-]+)\)", term).group(1).split("+"):
            first, last = (run.split("-") * 2)[:2]
            found |= {serial for serial in atoms if int(first) <= serial <= int(last)}
    return found


def chimerax_selects(expression, atoms):
    """The same of ChimeraX."""
    found = set()
    for term in expression.split(" | "):
        if residues := re.fullmatch(r"/(\w+):([\w,]+)", term):
            chain, numbers = residues.group(1), residues.group(2).split(",")
            found |= {serial for serial, atom in atoms.items() if atom[0] == chain and atom[1] in numbers}
            continue
        if one := re.fullmatch(r"@@serial_number=(\d+)", term):
            first = last = int(one.group(1))
        else:
            first, last = map(int, re.fullmatch(
                r"\(@@serial_number>=(\d+) & @@serial_number<=(\d+) \)", term).groups())
        found |= {serial for serial in atoms if first <= serial <= last}
    return found


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

    def compare_files(self, residues, *options):
        """The files of segment 0, 1, … have the residues of the table, and colours those of the .ply file.

        `residues`: the serial numbers, chain and number of each residue. Returns both scripts.
        """
        atoms = {serial: (chain, str(number)) for serials, chain, number in residues for serial in serials}
        for kind in ("csv", "pml", "cxc", "pdb"):
            self.segment(f"r.{kind}", *options)
        areas = collections.defaultdict(collections.Counter)  # by segment, then atom
        for row in rows_of(self.folder / "r.csv"):
            areas[int(row["segment"])][int(row["serial"])] += float(row["area"])
        touched, main = collections.defaultdict(set), collections.defaultdict(set)
        for serials, _, _ in residues:
            parts = {s: sum(own[serial] for serial in serials) for s, own in areas.items()
                     if set(own) & set(serials)}
            for segment in parts:
                touched[segment] |= set(serials)
            if parts:
                main[max(parts, key=lambda s, parts=parts: (parts[s], -s))] |= set(serials)
        pml, cxc = ((self.folder / f"r.{kind}").read_text() for kind in ("pml", "cxc"))
        selected = {int(n): pymol_selects(e, atoms)
                    for n, e in re.findall(r"(?m)^select segment_(\d+), (.*)$", pml)}
        self.assertEqual(selected, touched)
        self.assertEqual({int(n): chimerax_selects(e, atoms)
                          for n, e in re.findall(r"(?m)^name segment_(\d+) (.*)$", cxc)}, touched)
        painted = {int(n): pymol_selects(e, atoms)
                   for n, e in re.findall(r"(?m)^color segment_(\d+)_color, (.*)$", pml)}
        self.assertEqual(painted, main)
        lines = re.findall(r"(?m)^color (.*) #([0-9a-f]{6})$", cxc)
        self.assertEqual([chimerax_selects(e, atoms) for e, _ in lines], [main[n] for n in sorted(main)])
        # The temperature factor is that of the atom, which may be another one than its residue's.
        for line in (self.folder / "r.pdb").read_text().splitlines():
            if line.startswith("ATOM"):
                own = {s: found[int(line[6:11])] for s, found in areas.items() if int(line[6:11]) in found}
                expected = max(own, key=lambda s, own=own: (own[s], -s)) if own else -1
                self.assertEqual(float(line[60:66]), expected)
        # A segment has one colour in all files.
        colors = dict(zip(sorted(main), (tuple(bytes.fromhex(c)) for _, c in lines)))
        for n, rgb in re.findall(r"(?m)^set_color segment_(\d+)_color, \[(.*)\]$", pml):
            self.assertEqual(tuple(round(255 * float(x)) for x in rgb.split(", ")), colors[int(n)])
        in_ply = self.colors_of_faces(*options)
        for n, color in colors.items():
            self.assertEqual(in_ply[n], {color})
        return pml, cxc

    def colors_of_faces(self, *options):
        """The colours of each segment's triangles in `segment -o x.ply`."""
        self.morsel("segment", "row.off", "--field", "height:axis=x", "--by", "ascending", "-o", "s.ply",
                    *options)
        head, _, body = (self.folder / "s.ply").read_bytes().partition(b"end_header\n")
        self.assertIn(b"binary_little_endian", head)
        sizes = {"double": 8, "float": 4, "int": 4, "uint": 4, "uchar": 1}
        counts, rows = {}, collections.defaultdict(list)
        for line in head.decode().splitlines():
            words = line.split()
            if words[0] == "element":
                element = words[1]
                counts[element] = int(words[2])
            elif words[0] == "property":
                rows[element].append((words[-1], words[1:-1]))
        at = counts["vertex"] * sum(sizes[kind] for _, (kind,) in rows["vertex"])
        found = collections.defaultdict(set)
        for _ in range(counts["face"]):
            face = {}
            for name, kind in rows["face"]:
                if kind[0] == "list":
                    at += sizes[kind[1]] + body[at] * sizes[kind[2]]
                    continue
                face[name] = int.from_bytes(body[at:at + sizes[kind[0]]], "little", signed=kind[0] == "int")
                at += sizes[kind[0]]
            found[face["segment"]].add((face["red"], face["green"], face["blue"]))
        return found

    def test_scripts(self):
        residues = [([i + 1], "A", number) for i, (_, _, number) in enumerate(self.atoms)]
        pml, cxc = self.compare_files(residues)
        self.assertRegex(pml, r"(?m)^select segment_0, \(chain A and resi [123+]+\)$")
        self.assertRegex(pml, r"(?m)^set_color segment_0_color, \[[01]\.\d+, [01]\.\d+, [01]\.\d+\]$")
        self.assertRegex(cxc, r"(?m)^name segment_0 /A:[123,]+$")

    def monomers(self, count, size, chain="A", gap=0, space=6):
        """A row of monomers with the same names and numbers, two atoms a residue; its residues."""
        text, residues, serial = "", [], 1
        for monomer in range(count):
            for number in range(1, size + 1):
                serials = [serial, serial + 1]
                for k, name in enumerate(("C", "N")):
                    x = 1.3 * (serial - 1 + k) + space * monomer
                    text += atom(serial + k, (x, 0, 0), name=name, residue="GLY", number=number, chain=chain,
                                 element=name)
                residues.append((serials, chain.strip(), number))
                serial += 2
            serial += gap
        self.pdb = self.file("row.pdb", text)
        self.morsel("molecule", self.pdb, "-o", "row.off", "--kind", "vdw", "--resolution", "0.25")
        return residues

    def test_residues_of_two_monomers_in_one_chain_do_not_merge(self):
        for chain in "A", " ":
            with self.subTest(chain=chain):
                residues = self.monomers(2, 3, chain)
                pml, cxc = self.compare_files(residues, "--segments", "2")
                # Each monomer is a segment.
                selected = re.findall(r"(?m)^select segment_\d+, (.*)$", pml)
                self.assertEqual(set(selected), {"(id 1-6)", "(id 7-12)"})
                self.assertIn(" (@@serial_number>=1 & @@serial_number<=6 )\n", cxc)

    def test_only_residues_of_repeated_numbers_are_named_by_serials(self):
        residues = self.monomers(2, 3)
        text = (self.folder / "row.pdb").read_text().splitlines(keepends=True)
        self.file("row.pdb", "".join(line if i < 8 else line[:22] + f"{int(line[22:26]) + 10:4}" + line[26:]
                                     for i, line in enumerate(text)))
        residues = [(serials, chain, number if i < 4 else number + 10)
                    for i, (serials, chain, number) in enumerate(residues)]
        pml, _ = self.compare_files(residues, "--segments", "2")
        selected = re.findall(r"(?m)^select segment_\d+, (.*)$", pml)
        self.assertEqual(set(selected), {"(chain A and resi 2+3) or (id 1-2)",
                                         "(chain A and resi 12+13) or (id 7-8)"})

    def test_runs_of_serials_do_not_go_over_atoms_that_were_not_taken(self):
        self.monomers(2, 3, " ", gap=1, space=0)
        text = (self.folder / "row.pdb").read_text().splitlines(keepends=True)
        ligand = atom(7, (60, 0, 0), record="HETATM", residue="LIG", number=9, chain=" ")
        self.file("row.pdb", "".join(text[:6]) + ligand + "".join(text[6:]))
        self.segment("r.pml", "--segments", "1")
        self.assertRegex((self.folder / "r.pml").read_text(), r"(?m)^select segment_\d+, \(id 1-6\+8-13\)$")

    def test_atoms_of_the_same_serials_and_numbers_are_refused_in_scripts(self):
        self.monomers(2, 3)
        text = (self.folder / "row.pdb").read_text().splitlines(keepends=True)
        self.file("row.pdb", "".join(line if i < 6 else line[:6] + f"{i - 5:5}" + line[11:]
                                     for i, line in enumerate(text)))
        for kind in "pml", "cxc":
            said = self.segment(f"r.{kind}", "--segments", "2", code=3).stderr
            self.assertIn("which has the same serial number: write the residues as .pdb or .csv", said)
            self.assertFalse((self.folder / f"r.{kind}").exists())
        self.segment("r.csv", "--segments", "2")

    def test_tables_are_read_by_numpy_and_pandas(self):
        self.segment("r.csv", "--segments", "2")
        lines = (self.folder / "r.csv").read_text().splitlines()
        self.assertEqual(lines[0], "segment,chain,residue,sequence_id,atom,element,serial,area")
        first = next(i for i, line in enumerate(lines) if line.startswith("#"))
        self.assertTrue(all(line.startswith("#") for line in lines[first:]))
        try:
            import numpy
            import pandas
        except ImportError as error:
            self.skipTest(f"{error.name} is not installed")
        rows = rows_of(self.folder / "r.csv")
        table = numpy.genfromtxt(self.folder / "r.csv", delimiter=",", names=True, dtype=None,
                                 encoding="utf-8")
        self.assertEqual(table.dtype.names, tuple(lines[0].split(",")))
        self.assertEqual(table["area"].tolist(), [float(row["area"]) for row in rows])
        frame = pandas.read_csv(self.folder / "r.csv", comment="#")
        self.assertEqual(list(frame.columns), lines[0].split(","))
        self.assertEqual(frame["residue"].tolist(), [row["residue"] for row in rows])

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
        for kind, command in (("pml", r"(select|color|set_color) [a-z0-9_]+, [][a-zA-Z0-9_()+., -]+"),
                              ("cxc", r"(name [a-z0-9_]+ |color )[()<>&@/:|=, a-zA-Z0-9_]+( #[0-9a-f]{6})?")):
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
