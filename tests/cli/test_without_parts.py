"""A program that was built without molecules and pictures: what needs them says so, all else works."""

import gzip
import unittest

from support import OCTAHEDRON, ProgramTest

FORMATS = ("built without the kinds of files that libraries read, which {} needs: build it with "
           "-DMORSEL_WITH_FORMATS=ON")
MOLECULES = "built without molecules, which {} needs: build it with -DMORSEL_WITH_MOLECULES=ON"
PICTURES = "built without pictures, which {} needs: build it with -DMORSEL_WITH_PICTURES=ON"


class WithoutParts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file("o.off", OCTAHEDRON)
        self.file("m.pdb", "")

    def refused(self, sentence, *arguments):
        before = sorted(self.folder.rglob("*"))
        result = self.morsel(*arguments, code=2)
        self.assertIn(sentence, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_formats(self):
        (self.folder / "o.off.gz").write_bytes(gzip.compress(OCTAHEDRON.encode()))
        self.refused('built without the kinds of files that libraries read, which the compressed file '
                     '"o.off.gz" needs: build it with -DMORSEL_WITH_FORMATS=ON', "info", "o.off.gz")

        self.file("s.gii", "<GIFTI/>")
        self.refused('which the GIFTI file "s.gii" needs', "info", "s.gii")
        self.refused('which the GIFTI file "s.gii" needs', "compare", "o.off", "--field",
                     "vertex-scalar:file=s.gii")
        self.refused(FORMATS.format("a glTF file"), "info", self.file("m.gltf", "{}").name)

    def test_molecules(self):
        self.refused(MOLECULES.format("morsel molecule"), "molecule", "m.pdb", "-o", "m.off")
        self.refused(MOLECULES.format("--residues"), "segment", "m.off", "-o", "s.ply", "--molecule", "m.pdb",
                     "--residues", "r.pml")
        self.refused(MOLECULES.format("atomic-density"), "compare", "o.off", "--field",
                     "atomic-density:structure=m.pdb")

    def test_pictures(self):
        self.refused(PICTURES.format("morsel render"), "render", "o.off", "-o", "o.png")
        self.refused(PICTURES.format("morsel reproduce"), "reproduce", "paper")
        self.refused(PICTURES.format("--figures"), "compare", "o.off", "--figures", "out")
        self.refused(PICTURES.format("--thumbnails"), "compare", "o.off", "--thumbnails", "small")
        self.refused(PICTURES.format("--figures"), "sweep", "o.off", "--method", "tps", "--vary", "count=1,2",
                     "--figures", "out")
        self.refused(PICTURES.format("morsel batch without --no-thumbnails"), "batch", ".", "--out", "out")

    def test_help_shows_all_the_same(self):
        self.assertIn("--figures", self.morsel("compare", "--help").stdout)
        self.assertIn("render", self.morsel("--help").stdout)
        self.assertIn("structure", self.morsel("fields", "atomic-density").stdout)

    def test_all_else_works(self):
        self.morsel("compare", "o.off", "--field", "height:axis=x", "-o", "r.json", "--html", "p.html",
                    "--export", "files")
        self.morsel("check", "r.json")
        self.morsel("info", "o.off")
        (self.folder / "meshes").mkdir()
        self.file("meshes/o.off", OCTAHEDRON)
        self.morsel("batch", "meshes", "--out", "out", "--field", "height:axis=x", "--no-thumbnails")
        self.assertTrue((self.folder / "out/index.html").exists())
        self.assertFalse((self.folder / "out/plots").exists())


if __name__ == "__main__":
    unittest.main()
