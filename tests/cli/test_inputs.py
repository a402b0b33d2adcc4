"""What may stand for a mesh: standard input, compressed files, files with other names."""

import bz2
import fcntl
import gzip
import hashlib
import json
import lzma
import os
import signal
import subprocess
import termios
import time
import unittest

from support import OCTAHEDRON, PROGRAM, ProgramTest, without_comments

HEIGHT = ("--field", "height:axis=z", "--method", "conventional")


class Inputs(ProgramTest):
    def piped(self, data, *arguments, code=0):
        result = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, input=data,
                                capture_output=True, timeout=60, check=False)
        self.assertEqual(result.returncode, code, result.stderr.decode())
        return result.stdout.decode(), result.stderr.decode()

    def test_standard_input_is_a_mesh(self):
        self.file("o.off", OCTAHEDRON)
        plain = self.morsel("compare", "o.off", *HEIGHT, "-o", "-").stdout
        data = OCTAHEDRON.encode()
        output, said = self.piped(data, "compare", "-", "--format", "off", *HEIGHT, "-o", "-")
        self.assertEqual(said, "")
        one, other = json.loads(plain), json.loads(output)
        self.assertEqual(other["mesh"]["path"], "-")
        self.assertEqual(other["mesh"]["sha256"], hashlib.sha256(data).hexdigest())
        self.assertEqual(other["request"]["format"], "off")
        self.assertEqual(one["methods"], other["methods"])
        # Without the command, compressed, and by another command.
        packed = gzip.compress(data)  # with the time in it
        output, _ = self.piped(packed, "-", "--format=off", *HEIGHT, "-o", "-")
        self.assertEqual(json.loads(output)["mesh"]["sha256"], hashlib.sha256(packed).hexdigest())
        self.piped(data, "field", "-", "--format", "off", "--field", "height:axis=z", "-o", "z.txt")
        self.assertIn("morsel field - --format off", (self.folder / "z.txt").read_text())

    def test_a_field_goes_from_standard_input_to_standard_output(self):
        output, said = self.piped(OCTAHEDRON.encode(), "field", "-", "--format", "off", "--field",
                                  "height:axis=z", "-o", "-")
        self.assertEqual(said, "")
        self.assertEqual(without_comments(output), ["1", "-1", "0", "0", "0", "0"])
        with open(self.folder / "o.txt", "w") as stream:
            subprocess.run([PROGRAM, "field", self.file("o.off", OCTAHEDRON), "--field", "height:axis=z",
                            "-o", "-"], stdout=stream, check=True, timeout=60)
        self.assertEqual((self.folder / "o.txt").read_text().splitlines()[-6:],
                         ["1", "-1", "0", "0", "0", "0"])

    def test_info_describes_standard_input(self):
        self.file("o.off", OCTAHEDRON)
        self.morsel("cut", "o.off", "--field", "height:axis=z", "-o", "cut.off")
        data = (self.folder / "cut.off").read_bytes()
        output, _ = self.piped(data, "info", "-", "--format", "off", "--json")
        document = json.loads(output)
        self.assertEqual(document["mesh"]["sha256"], hashlib.sha256(data).hexdigest())
        self.assertIn("cut", document["provenance"]["command"])
        self.assertIn("cut", self.piped(gzip.compress(data), "info", "-", "--format", "off")[0])

    def test_what_is_wrong_with_standard_input_is_said(self):
        _, said = self.piped(b"", "compare", "-", code=2)
        self.assertIn("the format must be given: --format off, obj", said)
        _, said = self.piped(b"OFF\n1 0 0\n", "compare", "-", "--format", "off", code=3)
        self.assertIn('cannot read "standard input": ', said)
        _, said = self.piped(b"", "compare", "-", "--format", "off", code=3)
        self.assertIn("it is empty", said)
        _, said = self.piped(b"", "compare", "-", "--format", "step", code=2)
        self.assertIn("--format", said)
        self.file("r.json", self.piped(OCTAHEDRON.encode(), "compare", "-", "--format", "off", *HEIGHT, "-o",
                                       "-")[0])
        self.assertIn("standard input", self.morsel("check", "r.json", code=1).stdout)

    def test_the_file_behind_standard_input_is_no_output(self):
        mesh = self.folder / self.file("o.off", OCTAHEDRON)
        with open(mesh, "rb") as stream:
            result = subprocess.run([PROGRAM, "cut", "-", "--format", "off", "-o", "o.off"], cwd=self.folder,
                                    stdin=stream, capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(mesh.read_text(), OCTAHEDRON)

    def test_waiting_for_standard_input_can_be_interrupted(self):
        read, write = os.pipe()
        with subprocess.Popen([PROGRAM, "compare", "-", "--format", "off"], stdin=read,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            os.write(write, OCTAHEDRON[:20].encode())
            while fcntl.ioctl(read, termios.FIONREAD, bytes(4)) != bytes(4):  # until it has read that
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=30)
        os.close(read)
        os.close(write)
        self.assertEqual(process.returncode, 130)

    def test_compressed_files_are_what_they_hold(self):
        data = OCTAHEDRON.encode()
        for name, packed in (("a.off.gz", gzip.compress(data)), ("b.OFF.XZ", lzma.compress(data)),
                             ("c.off", gzip.compress(data))):
            (self.folder / name).write_bytes(packed)
            document = json.loads(self.morsel("info", name, "--json").stdout)
            self.assertEqual(document["mesh"]["vertices"], 6)
            self.assertEqual(document["mesh"]["sha256"], hashlib.sha256(packed).hexdigest())
        (self.folder / "cut.off.gz").write_bytes(gzip.compress(data)[:-9])
        self.assertIn("truncated", self.morsel("info", "cut.off.gz", code=3).stderr)
        (self.folder / "d.off").write_bytes(bz2.compress(data))
        self.assertIn("it is bzip2 data, though read as .off", self.morsel("info", "d.off", code=3).stderr)

    def test_a_collection_has_compressed_meshes(self):
        (self.folder / "meshes").mkdir()
        self.file("meshes/a.off", OCTAHEDRON)
        (self.folder / "meshes/b.off.gz").write_bytes(gzip.compress(OCTAHEDRON.encode()))
        (self.folder / "meshes/notes.txt.gz").write_bytes(gzip.compress(b"no mesh"))
        self.morsel("batch", "meshes", "--out", "out", *HEIGHT, "--no-thumbnails")
        reports = [json.loads((self.folder / f"out/reports/{name}.json").read_text())
                   for name in ("a.off", "b.off.gz")]
        self.assertEqual(reports[0]["methods"], reports[1]["methods"])
        self.assertFalse((self.folder / "out/reports/notes.txt.gz.json").exists())

    def test_values_may_be_compressed(self):
        self.file("o.off", OCTAHEDRON)
        (self.folder / "v.txt.gz").write_bytes(gzip.compress(b"1\n2\n3\n4\n5\n6\n"))
        self.file("v.txt", "1\n2\n3\n4\n5\n6\n")
        for name in ("v.txt.gz", "v.txt"):
            self.morsel("field", "o.off", "--field", f"vertex-scalar:file={name}", "-o", f"of-{name}.txt")
        lines = [[line for line in (self.folder / f"of-{name}.txt").read_text().splitlines()
                  if not line.startswith("#")] for name in ("v.txt.gz", "v.txt")]
        self.assertEqual(lines[0], ["1", "2", "3", "4", "5", "6"])
        self.assertEqual(lines[0], lines[1])

    def test_a_format_is_read_whatever_the_name(self):
        self.file("mesh.dat", OCTAHEDRON)
        self.assertIn("an OFF file: name it .off or use --format off",
                      self.morsel("compare", "mesh.dat", *HEIGHT, code=3).stderr)
        self.morsel("compare", "mesh.dat", "--format", "off", *HEIGHT, "-o", "r.json")
        self.morsel("check", "r.json")
        self.file("o.obj", OCTAHEDRON)
        self.assertIn("it is an OFF file, though read as .obj",
                      self.morsel("compare", "o.obj", *HEIGHT, code=3).stderr)
        self.morsel("info", "o.obj", "--format", "off")
        self.file("cube.dat", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        said = self.morsel("info", "cube.dat", "--format", "off", code=3).stderr
        self.assertIn("it is an OBJ file, though the format that was given is off (line 1: ", said)
        self.assertTrue(said.endswith("): use --format obj\n"), said)

    def test_of_columns_of_one_name_none_is_taken(self):
        self.file("o.off", OCTAHEDRON)
        self.file("v.csv", "a,a\n" + "1,2\n" * 6)
        said = self.morsel("field", "o.off", "--field", "vertex-scalar:file=v.csv,column=a", "-o", "x.txt",
                           code=3).stderr
        self.assertIn('the columns 1 and 2 are called "a": choose one by its number, as in column=1', said)
        self.assertEqual(said.count("v.csv"), 1, said)
        self.morsel("field", "o.off", "--field", "vertex-scalar:file=v.csv,column=2", "-o", "x.txt")


if __name__ == "__main__":
    unittest.main()
