"""Standard descriptors that are closed when the program begins: no output file gets their numbers."""

import json
import subprocess
import unittest

from support import OCTAHEDRON, PROGRAM, ProgramTest, made_in

QUICK = ("--field", "height", "--method", "conventional")


class ClosedStreams(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("m.off", OCTAHEDRON)

    def closed(self, which, *arguments, code=0):
        """Runs the program as a shell does with `which`, such as "<&- 2>&-"."""
        result = subprocess.run(["sh", "-c", f'exec "$0" "$@" {which}', PROGRAM, *map(str, arguments)],
                                cwd=self.folder, capture_output=True, text=True, timeout=240, check=False)
        self.assertEqual(result.returncode, code, f"{which} {arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def test_messages_are_not_written_into_the_list_of_a_folder(self):
        self.morsel("compare", self.mesh, *QUICK, "--export", "whole")
        for number, which in enumerate(("<&- 2>&-", "2>&-", "<&- >&- 2>&-", "<&- >&-")):
            with self.subTest(which):
                out = f"d{number}"
                self.closed(which, "compare", self.mesh, *QUICK, "--export", out,
                            code=4 if ">&-" in which.replace("2>&-", "") else 0)
                # What was made is complete, and the folder still morsel's own.
                self.morsel("compare", self.mesh, *QUICK, "--export", out)
                self.assertEqual([path.name for path in made_in(self.folder / out)],
                                 [path.name for path in made_in(self.folder / "whole")])

    def test_a_batch_does_not_write_messages_into_its_list(self):
        folder = self.folder / "meshes"
        folder.mkdir()
        (folder / "a.off").write_text(OCTAHEDRON)
        words = ("batch", "meshes", "--repair", "--out", "out", *QUICK, "--no-thumbnails")
        self.closed("<&- 2>&-", *words)
        self.morsel(*words)

    def test_a_warning_is_not_written_into_the_document(self):
        self.file("s.json.journal", '{"schema":"morsel.journal/1","key":{"x":1}}')
        self.closed("2>&-", "sweep", self.mesh, "--field", "height", "--vary", "iterations=1,2", "-o",
                    "s.json")
        self.assertEqual(len(json.loads((self.folder / "s.json").read_text())["rows"]), 2)

    def test_writing_to_a_closed_standard_output_fails(self):
        self.assertIn("standard output", self.closed(">&-", "info", self.mesh, code=4).stderr)
        self.assertIn("morsel: ", self.closed(">&-", "compare", self.mesh, *QUICK, "-o", "/dev/stdout",
                                              code=4).stderr)


if __name__ == "__main__":
    unittest.main()
