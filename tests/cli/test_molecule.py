"""morsel molecule: surfaces of molecules of a few atoms, and atomic-density on them."""

import gzip
import hashlib
import json
import math
import re
import subprocess
import unittest

from support import OCTAHEDRON, PROGRAM, ProgramTest, data_lines, without_comments


def atom(serial, position, *, name="C", residue="GLY", chain="A", number=1, element="C", record="ATOM",
         alternate=" ",
         occupancy=1):
    x, y, z = position
    return (f"{record:<6}{serial:5}  {name:<3}{alternate}{residue:>3} {chain}{number:4}    "
            f"{x:8.3f}{y:8.3f}{z:8.3f}{occupancy:6.2f}{0:6.2f}          {element:>2}\n")


CIF = """data_TEST
loop_
_atom_site.group_PDB
_atom_site.id
_atom_site.type_symbol
_atom_site.label_comp_id
_atom_site.auth_asym_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
ATOM 1 C GLY A 0 0 0
ATOM 2 C GLY B 20 0 0
HETATM 3 O HOH A 40 0 0
"""


class Molecule(ProgramTest):
    def surface(self, molecule, *options, name="surface.off"):
        """The surface's positions and triangles, and what was said."""
        result = self.morsel("molecule", molecule, "-o", name, *options)
        lines = data_lines(self.folder / name)
        self.assertEqual(lines[0], "OFF")
        vertices, triangles, _ = map(int, lines[1].split())
        numbers = [line.split() for line in lines[2:] if line]
        positions = [tuple(map(float, line)) for line in numbers[:vertices]]
        faces = [tuple(map(int, line[1:])) for line in numbers[vertices:]]
        self.assertEqual(len(faces), triangles)
        return positions, faces, result.stderr

    def check_closed(self, faces):
        edges = [edge for a, b, c in faces for edge in ((a, b), (b, c), (c, a))]
        self.assertEqual(len(edges), len(set(edges)))
        self.assertEqual(set(edges), {(b, a) for a, b in edges})

    def info(self, name="surface.off"):
        return self.morsel("info", name).stdout.split()

    def components(self, name="surface.off"):
        words = self.info(name)
        return int(words[words.index("components") + 1])

    def test_standard_input_and_output(self):
        self.file("a.pdb", atom(1, (0, 0, 0)))
        self.morsel("molecule", "a.pdb", "-o", "a.off")
        for data in (atom(1, (0, 0, 0)).encode(), gzip.compress(atom(1, (0, 0, 0)).encode())):
            result = subprocess.run([PROGRAM, "molecule", "-", "--format", "pdb", "-o", "-", "--as", "off"],
                                    cwd=self.folder, input=data, capture_output=True, timeout=60, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(without_comments(result.stdout.decode()), data_lines(self.folder / "a.off"))
            self.assertIn(hashlib.sha256(data).hexdigest(), result.stdout.decode().replace("\n# ", ""))
            self.assertIn("atoms: 1 of 1", result.stderr.decode())
        self.assertIn("the format must be given: --format pdb, mmcif or pqr",
                      self.morsel("molecule", "-", "-o", "x.off", code=2, input="").stderr)
        self.assertIn("standard input has no atoms",
                      self.morsel("molecule", "-", "--format", "pdb", "-o", "x.off", code=3, input="").stderr)
        self.assertIn("the format must be given: --as off or ply",
                      self.morsel("molecule", "a.pdb", "-o", "-", code=2).stderr)
        self.file("a.dat", CIF)
        self.morsel("molecule", "a.dat", "--format", "mmcif", "-o", "b.off")

    def test_an_atom_is_a_sphere(self):
        file = self.file("one.pdb", atom(1, (1, 2, 3)))
        for kind, radius in (("gaussian", 1.7), ("ses", 1.7), ("vdw", 1.7), ("sas", 3.1)):
            positions, faces, said = self.surface(file, "--kind", kind, "--resolution", "0.2")
            self.check_closed(faces)
            self.assertIn("atoms: 1 of 1", said)
            self.assertIn("1 component, genus 0", said)
            for p in positions:
                self.assertAlmostEqual(math.dist(p, (1, 2, 3)), radius, delta=0.04)
        positions, _, _ = self.surface(file, "--kind", "sas", "--probe", "0.5")
        self.assertAlmostEqual(max(p[0] for p in positions), 3.2, delta=0.1)

    def test_two_atoms_apart_are_two_spheres_in_both_formats(self):
        self.surface(self.file("two.cif", CIF))
        self.assertEqual(self.components(), 2)
        self.surface(self.file("two.pdb", atom(1, (0, 0, 0)) + atom(2, (20, 0, 0))), name="pdb.off")
        self.assertEqual(data_lines(self.folder / "surface.off"), data_lines(self.folder / "pdb.off"))
        self.morsel("molecule", "two.cif", "-o", "surface.ply")
        self.assertEqual(self.components("surface.ply"), 2)

    def test_waters_hetero_atoms_and_chains_are_options(self):
        file = self.file("two.cif", CIF)
        _, _, said = self.surface(file, "--waters")
        self.assertEqual(self.components(), 3)
        self.assertIn("atoms: 3 of 3", said)
        _, _, said = self.surface(file, "--chains", "B")
        self.assertEqual(self.components(), 1)
        self.assertIn("left out: 2 of other chains", said)
        self.surface(file, "--chains", "A/B")
        self.assertEqual(self.components(), 2)
        ion = self.file("ion.pdb", atom(1, (0, 0, 0)) + atom(2, (20, 0, 0), name="ZN", residue="ZN",
                                                             element="ZN",
                                                             record="HETATM"))
        _, _, said = self.surface(ion)
        self.assertIn("left out: 1 hetero", said)
        self.surface(ion, "--hetero", "all")
        self.assertEqual(self.components(), 2)
        result = self.morsel("molecule", file, "-o", "x.off", "--chains", "C", code=3)
        self.assertIn('no chain "C"', result.stderr)
        self.assertIn('"A", "B"', result.stderr)

    def area(self, file, *options):
        said = self.morsel("molecule", file, "-o", "a.off", *options).stderr
        return float(re.search(r"area ([\d,.]+)", said)[1].replace(",", "")), said

    def test_names_without_columns_of_elements(self):
        lone = self.file("ca.pdb", "ATOM      2 CA   ALA A   1       1.460   0.000   0.000  1.00  0.00\n")
        positions, faces, said = self.surface(lone, "--kind", "vdw", "--resolution", "0.1")
        self.check_closed(faces)
        for p in positions:
            self.assertAlmostEqual(math.dist(p, (1.46, 0, 0)), 1.7, delta=0.01)
        self.assertIn("area 36 ", said)
        self.assertIn("radii: all-atom", said)

    def test_dialects_of_simulations_have_the_same_surface(self):
        """A peptide with waters and ions as CHARMM, AMBER and GROMACS write it, and as the PDB has it."""
        names = {  # atom and residue, columns 13 to 16 and 18 to 21
            "pdb": [(" N  ", "MET"), (" H1 ", "MET"), (" CA ", "MET"), (" HA ", "MET"), (" CB ", "MET"),
                    (" SD ", "MET"), (" C  ", "MET"), (" O  ", "MET"), (" N  ", "HIS"), (" CA ", "HIS"),
                    (" CD2", "HIS"), (" C  ", "HIS"), (" O  ", "HOH"), (" H1 ", "HOH"), ("NA  ", "NA "),
                    ("CL  ", "CL ")],
            "charmm": [(" N  ", "MET"), (" HT1", "MET"), (" CA ", "MET"), (" HA ", "MET"), (" CB ", "MET"),
                       (" SD ", "MET"), (" C  ", "MET"), (" OT1", "MET"), (" N  ", "HSD"), (" CA ", "HSD"),
                       (" CD2", "HSD"), (" C  ", "HSD"), (" OH2", "TIP3"), (" H1 ", "TIP3"), ("SOD ", "SOD"),
                       ("CLA ", "CLA")],
            "amber": [("N   ", "NMET"), ("H1  ", "NMET"), ("CA  ", "NMET"), ("HA  ", "NMET"),
                      ("CB  ", "NMET"),
                      ("SD  ", "NMET"), ("C   ", "NMET"), ("O   ", "NMET"), ("N   ", "HIE"), ("CA  ", "HIE"),
                      ("CD2 ", "HIE"), ("C   ", "HIE"), ("O   ", "WAT"), ("H1  ", "WAT"), ("Na+ ", "Na+"),
                      ("Cl- ", "Cl-")],
            "gromacs": [("N   ", "MET"), ("H1  ", "MET"), ("CA  ", "MET"), ("HA  ", "MET"), ("CB  ", "MET"),
                        ("SD  ", "MET"), ("C   ", "MET"), ("O   ", "MET"), ("N   ", "HISH"),
                        ("CA  ", "HISH"),
                        ("CD2 ", "HISH"), ("C   ", "HISH"), ("OW  ", "SOL"), ("HW1 ", "SOL"), ("NA  ", "NA"),
                        ("CL  ", "CL")]}
        residues = [1] * 8 + [2] * 4 + [3, 3, 4, 5]
        said = {}
        for dialect, atoms in names.items():
            lines = [f"ATOM  {i + 1:5} {name} {residue:<4} {number:4}    {1.3 * i:8.3f}{i % 3:8.3f}"
                     f"{i % 2:8.3f}  1.00  0.00\n"
                     for i, ((name, residue), number) in enumerate(zip(atoms, residues))]
            file = self.file(f"{dialect}.pdb", "".join(lines) + "END\n")
            self.morsel("molecule", file, "-o", f"{dialect}.off", "--kind", "ses")
            said[dialect] = (self.area(file, "--kind", "ses")[1].splitlines()[:2],
                             self.area(file, "--select", "polymer or water or ion")[1].splitlines()[:2])
            self.assertEqual(data_lines(self.folder / f"{dialect}.off"), data_lines(self.folder / "pdb.off"))
        self.assertIn("atoms: 12 of 16; left out: 2 of waters, 2 hetero", said["pdb"][0][0])
        for dialect, lines in said.items():
            self.assertEqual(lines, said["pdb"], dialect)

    def test_an_expression_selects(self):
        file = self.file("two.cif", CIF)
        _, _, said = self.surface(file, "--select", "chain B or water")
        self.assertEqual(self.components(), 2)
        self.assertIn("left out: 1 not selected", said)
        for words, code, error in ((("--select", "chain"), 2, "at character 6"),
                                   (("--select", "all", "--waters"), 2, "--waters"),
                                   (("--select", "chain X"), 3, "3 not selected")):
            self.assertIn(error, self.morsel("molecule", file, "-o", "x.off", *words, code=code).stderr)

    def test_radii(self):
        file = self.file("one.pdb", atom(1, (0, 0, 0)))
        table = self.file("radii.txt", "GLY C 2.5\n")
        positions, _, said = self.surface(file, "--radii", table, "--kind", "vdw")
        self.assertAlmostEqual(max(p[0] for p in positions), 2.5, delta=0.05)
        self.assertIn("radii: of a table", said)
        pqr = self.file("one.pqr", "ATOM 1 C GLY 1 0 0 0 0.5 3\n")
        positions, _, said = self.surface(pqr, "--kind", "vdw")
        self.assertAlmostEqual(max(p[0] for p in positions), 3, delta=0.05)
        self.assertIn("radii: of the structure's file", said)
        chain = self.file("chain.pdb", "".join(
            atom(i, (3.8 * i, 0, 0), name="CA", number=i) for i in range(1, 12)))
        self.assertIn("radii: united-atom", self.surface(chain)[2])
        provenance = "".join(line[2:].rstrip("\n") for line in open(self.folder / "surface.off")
                             if line.startswith("# "))
        self.assertEqual(json.loads(provenance)["request"]["radii"], "united-atom")
        self.assertIn("radii: all-atom", self.surface(chain, "--radii", "all-atom")[2])
        self.assertIn("no-such-file", self.morsel("molecule", file, "-o", "x.off", "--radii", "no-such-file",
                                                  code=3).stderr)
        self.morsel("molecule", file, "-o", "radii.off", "--radii", "radii.off", code=2)

    def test_what_is_odd_is_told(self):
        model = "MODEL        1\n" + atom(1, (0, 0, 0)) + "ENDMDL\n"
        _, _, said = self.surface(self.file("twice.pdb", model + model))
        self.assertIn("twice.pdb: line 4: another model has the number 1", said)
        self.assertIn("atoms: 1 of 1", said)
        self.file("o.off", OCTAHEDRON)
        report = self.report("o.off", "--field", "atomic-density:structure=twice.pdb", "--method",
                             "conventional")
        self.assertIn("another model", report["field"]["warnings"][0])
        component = self.file("ala.cif", "data_ALA\nloop_\n_chem_comp_atom.comp_id\n"
                                         "_chem_comp_atom.atom_id\nALA CA\n")
        self.assertIn("chemical component (\"ALA\")",
                      self.morsel("molecule", component, "-o", "x.off", code=3).stderr)

    def test_alternate_locations_are_an_option(self):
        file = self.file("alt.pdb", atom(1, (0, 0, 0), alternate="A", occupancy=0.3)
                         + atom(2, (20, 0, 0), alternate="B", occupancy=0.7))

        def middle(*options):
            positions, _, _ = self.surface(file, *options)
            return round(sum(p[0] for p in positions) / len(positions))

        self.assertEqual(middle(), 20)
        self.assertEqual(middle("--altloc", "first"), 0)
        self.assertEqual(middle("--altloc", "A"), 0)
        self.assertEqual(middle("--altloc", "all"), 10)

    def test_cavities_are_kept_or_dropped(self):
        shell = "".join(
            atom(i, (8 * math.sqrt(1 - z * z) * math.cos(i * 2.399963),
                     8 * math.sqrt(1 - z * z) * math.sin(i * 2.399963), 8 * z))
            for i in range(200) for z in [1 - (2 * i + 1) / 200])
        file = self.file("shell.pdb", shell)
        _, _, said = self.surface(file, "--kind", "ses")
        self.assertIn("1 cavity dropped", said)
        self.assertEqual(self.components(), 1)
        self.surface(file, "--kind", "ses", "--cavities", "keep")
        self.assertEqual(self.components(), 2)

    def test_threads_change_nothing(self):
        file = self.file("row.pdb", "".join(atom(i, (1.5 * i, math.sin(i), math.cos(i))) for i in range(40)))
        for kind in ("gaussian", "ses"):
            self.surface(file, "--kind", kind, "--threads", "1")
            self.surface(file, "--kind", kind, "--threads", "4", name="again.off")
            self.assertEqual((self.folder / "surface.off").read_text(),
                             (self.folder / "again.off").read_text())

    def test_files_without_atoms_and_damaged_ones_are_refused(self):
        for name, text, said in (
                ("empty.pdb", "", "empty.pdb has no atoms"),
                ("wet.pdb", atom(1, (0, 0, 0), residue="HOH", element="O", record="HETATM"),
                 "no atoms left of 1"),
                ("cut.pdb", atom(1, (0, 0, 0))[:40], "cut.pdb, line 1"),
                ("bad.pdb", atom(1, (0, 0, 0)).replace("0.000", "0.0x0", 1), '"0.0x0"'),
                ("empty.cif", "data_x\n", "empty.cif has no atoms"),
                ("cut.cif", CIF[:-10], "cut.cif, line 2: "),
                ("bad.cif", CIF.replace(" 20 ", " twenty "), '"twenty"'),
                ("x.gz", "", "without an extension"),
                ("x.xyz", "", ".mmcif")):
            result = self.morsel("molecule", self.file(name, text), "-o", "x.off", code=3)
            self.assertIn(said, result.stderr)
            self.assertFalse((self.folder / "x.off").exists())
        self.morsel("molecule", "missing.pdb", "-o", "x.off", code=3)

    def test_wrong_usage(self):
        file = self.file("one.pdb", atom(1, (0, 0, 0)))
        for options in (("--resolution", "0"), ("--resolution", "nan"), ("--probe", "-1"),
                        ("--kind", "cartoon"),
                        ("--blobbiness", "0"), ("--altloc", "AB"), ("--hetero", "some"), ("--model", "0"),
                        ("--cavities", "fill"), ("--repair",)):
            said = self.morsel("molecule", file, "-o", "x.off", *options, code=2).stderr
            self.assertNotIn("molecule:", said)
        self.assertIn('--hetero must be none, residues or all, not "residue"; did you mean residues?',
                      self.morsel("molecule", file, "-o", "x.off", "--hetero", "residue", code=2).stderr)
        self.morsel("molecule", file, code=2)
        self.assertIn(".ply", self.morsel("molecule", file, "-o", "x.stl", code=2).stderr)
        self.assertFalse((self.folder / "x.off").exists())

    def test_a_resolution_out_of_reason_is_refused_at_once(self):
        file = self.file("one.pdb", atom(1, (0, 0, 0)))
        self.assertIn("too coarse", self.morsel("molecule", file, "-o", "x.off", "--resolution", "3",
                                                code=3).stderr)
        self.assertIn("a grid of", self.morsel("molecule", file, "-o", "x.off", "--resolution", "1e-4",
                                               code=3).stderr)
        self.assertIn("model 2", self.morsel("molecule", file, "-o", "x.off", "--model", "2", code=3).stderr)

    def test_an_output_that_cannot_be_written(self):
        file = self.file("one.pdb", atom(1, (0, 0, 0)))
        self.morsel("molecule", file, "-o", "one.pdb/x.off", code=4)

    def test_atomic_density_is_the_sum_of_gaussians(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.file("two.pdb", atom(1, (0, 0, 2)) + atom(2, (0, 0, -3), element="N", name="N"))
        self.morsel("field", mesh, "--field", "atomic-density:structure=two.pdb,decay=1", "-o", "d.txt")
        values = [float(line) for line in data_lines(self.folder / "d.txt")]
        squares = [(1, 16), (9, 4)] + [(5, 10)] * 4
        for value, (carbon, nitrogen) in zip(values, squares):
            self.assertAlmostEqual(value, math.exp(-carbon / 1.7**2) + math.exp(-nitrogen / 1.55**2),
                                   places=14)

    def test_atomic_density_in_a_report(self):
        self.surface(self.file("row.pdb", "".join(atom(i, (1.4 * i, math.sin(i), math.cos(i)))
                                                  for i in range(12))))
        report = self.report("surface.off", "--field", "atomic-density:structure=row.pdb", "--method",
                             "conventional")
        self.assertEqual(report["field"]["parameters"]["atoms"], 12)
        self.assertEqual(report["field"]["parameters"]["decay"], 0.5)
        self.morsel("check", "report.json")

    def test_atomic_density_refuses_a_mesh_elsewhere(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.file("far.pdb", atom(1, (900, 0, 0)))
        self.file("none.pdb", "END\n")
        for field, code, said in (("structure=far.pdb", 3, "no vertex of the mesh"),
                                  ("structure=none.pdb", 3, "none.pdb has no atoms"),
                                  ("decay=1", 2, "structure"),
                                  ("structure=far.pdb,decay=0", 2, "decay"),
                                  ("structure=far.pdb,chains=X", 3, 'no chain "X"')):
            result = self.morsel("field", mesh, "--field", "atomic-density:" + field, "-o", "x.txt",
                                 code=code)
            self.assertIn(said, result.stderr)


if __name__ == "__main__":
    unittest.main()
