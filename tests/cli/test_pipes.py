"""A named pipe in the place of an input is refused: nothing waits for somebody to write into it."""

import os
import subprocess
import unittest

from support import OCTAHEDRON, PROGRAM, ProgramTest

QUICK = ("--field", "height", "--method", "conventional")


class Pipes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("m.off", OCTAHEDRON)
        for name in ("pipe.off", "pipe.txt", "pipe.json"):
            os.mkfifo(self.folder / name)

    def morsel(self, *arguments, code=0, cwd=None, **options):
        """Must end soon."""
        result = subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd or self.folder, timeout=60,
                                capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
                                **options)
        self.assertEqual(result.returncode, code, f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def test_a_batch_hashes_no_pipe(self):
        self.file("list", "pipe.off\nm.off\n")
        for _ in range(2):
            self.morsel("batch", "list", "--out", "out", *QUICK, "--no-thumbnails", code=1)
            errors = (self.folder / "out/summary.csv").read_text()
            self.assertIn("not a regular file", errors)
        self.assertTrue((self.folder / "out/reports/m.off.json").is_file())
        self.morsel("batch", "list", "--out", "out", *QUICK, "--no-thumbnails", "--plan")

    def test_values_and_reports_are_not_read_from_a_pipe(self):
        for words in (("field", self.mesh, "--field", "vertex-scalar:file=pipe.txt", "-o", "z.txt"),
                      ("compare", self.mesh, "--field", "vertex-scalar:file=pipe.txt"),
                      ("check", "pipe.json"), ("info", "pipe.off"), ("compare", "pipe.off")):
            with self.subTest(words):
                self.assertIn("not a regular file", self.morsel(*words, code=3).stderr)


if __name__ == "__main__":
    unittest.main()
