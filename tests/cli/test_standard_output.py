"""- as an output: standard output, in a format that --as names."""

import csv
import gzip
import io
import json
import math
import os
import pathlib
import pty
import signal
import subprocess
import unittest

from support import OCTAHEDRON, ON_MESH, PROGRAM, ProgramTest

HEIGHT = ("--field", "height:axis=z", "--method", "conventional")
# A field that quads can be laid out by, and a quick picture.
EIGEN = ("--field", "eigenfunction:index=4")
QUICK = ("--size", "40x30", "--samples", "1")

# The words of a command, and each format that standard output gets of it; None: without --as.
COMMANDS = (
    (("field", "{}", *HEIGHT), (None, "txt", "ply", "vtp", "glb", "shape.gii", "func.gii")),
    (("points", "{}", *HEIGHT), (None, "json", "csv", "ply", "vtp", "glb")),
    (("segment", "{}", *HEIGHT), ("ply", "vtp", "annot", "label.gii", "glb")),
    (("cut", "{}", *HEIGHT), ("off", "ply")),
    (("render", "{}", *HEIGHT, *QUICK), (None,)),
    (("hierarchy", "{}", *HEIGHT, "--levels", "0", "--by", "persistence"), (None,)),
    (("sweep", "{}", "--field", "height", "--vary", "iterations=1,2"), (None, "json", "csv")),
    (("stability", "{}", *HEIGHT, "--noise", "0.1", "--trials", "1"), (None, "json", "csv")),
)
# What a format is without --as.
STANDARD = {"field": "txt", "render": "png"}


def torus(around=24, across=12):
    """A torus as OFF, whose eigenfunctions have saddles."""
    lines = [f"OFF\n{around * across} {2 * around * across} 0"]
    for i in range(around):
        for k in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * k / across
            r = 2 + 0.7 * math.cos(b)
            lines.append(f"{r * math.cos(a)} {r * math.sin(a) * 1.1} {0.7 * math.sin(b)}")
    for i in range(around):
        for k in range(across):
            p, q = i * across + k, i * across + (k + 1) % across
            r, s = (i + 1) % around * across + k, (i + 1) % around * across + (k + 1) % across
            lines += [f"3 {p} {r} {s}", f"3 {p} {s} {q}"]
    return "\n".join(lines) + "\n"


def without_times(data):
    """A JSON document without its timings, a table without its seconds; other bytes as they are."""
    try:
        document = json.loads(data)
    except ValueError:
        head, _, rows = data.partition(b"\n")
        if not head.endswith(b",seconds"):
            return data
        return [head, *(row.rpartition(b",")[0] for row in rows.split(b"\n"))]
    document.pop("timings", None)
    return document


class StandardOutput(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("m.off", OCTAHEDRON)

    def bytes_of(self, *words, code=0, **options):
        result = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True,
                                timeout=120, check=False, **options)
        self.assertEqual(result.returncode, code, result.stderr.decode())
        return result.stdout, result.stderr.decode()

    def test_it_gets_the_bytes_of_the_file(self):
        for words, formats in COMMANDS:
            words = [word.format("m.off") for word in words]
            for name in formats:
                with self.subTest(command=words[0], format=name):
                    extension = name or STANDARD.get(words[0], "json")
                    out = f"{words[0]}.{extension}"
                    said = self.morsel(*words, "-o", out).stderr
                    self.assertIn(out, said)
                    data, said = self.bytes_of(*words, "-o", "-", *(() if name is None else ("--as", name)))
                    self.assertEqual(without_times(data), without_times((self.folder / out).read_bytes()))
                    self.assertNotIn("standard output", said)
        self.assertFalse((self.folder / "-").exists())

    def test_quads(self):
        self.file("torus.off", torus())
        self.morsel("quads", "torus.off", *EIGEN, "-o", "q.obj")
        data, _ = self.bytes_of("quads", "torus.off", *EIGEN, "-o", "-")  # no table among it
        self.assertEqual(data, (self.folder / "q.obj").read_bytes())

    def test_outputs_besides_the_first(self):
        self.morsel("cut", "m.off", *HEIGHT, "-o", "c.off", "--graph", "g.vtp", "--json", "c.json")
        data, said = self.bytes_of("cut", "m.off", *HEIGHT, "-o", "c.off", "--graph", "-")
        self.assertEqual(data, (self.folder / "g.vtp").read_bytes())
        self.assertEqual(said, "cut mesh: c.off\n")
        data, _ = self.bytes_of("cut", "m.off", *HEIGHT, "-o", "c.off", "--json", "-")
        self.assertEqual(without_times(data), without_times((self.folder / "c.json").read_bytes()))
        data, _ = self.bytes_of("compare", "m.off", *HEIGHT, "--html", "-")
        self.assertTrue(data.startswith(b"<!doctype html>"), data[:40])
        # A table on standard output has no other one around it.
        data, _ = self.bytes_of("sweep", "m.off", "--field", "height", "--vary", "iterations=1,2", "-o", "-",
                                "--as=csv")
        rows = list(csv.DictReader(line for line in io.StringIO(data.decode()) if not line.startswith("#")))
        self.assertEqual(len(rows), 2)
        self.assertFalse(any(path.name.endswith(".journal") for path in self.folder.iterdir()))

    def test_a_pipeline(self):
        data, _ = self.bytes_of("segment", "-", "--format", "off", *HEIGHT, "-o", "-", "--as", "ply",
                                input=gzip.compress(OCTAHEDRON.encode()))
        again, _ = self.bytes_of("info", "-", "--format", "ply", "--json", input=data)
        document = json.loads(again)
        self.assertEqual(document["mesh"]["vertices"], 6)
        self.assertEqual(document["provenance"]["command"],
                         "morsel segment - --format off --field height:axis=z --method conventional")

    def test_what_is_wrong_is_said(self):
        for words, sentence in (
                (("segment", "m.off", "-o", "-"),
                 "of standard output (-) the format must be given: --as ply, vtp, annot, label.gii or glb"),
                (("cut", "m.off", "-o", "-"), "must be given: --as off or ply"),
                (("segment", "m.off", "-o", "-", "--as", "txt"),
                 "--as must be ply, vtp, annot, label.gii, glb, pml, cxc, pdb or csv, not \"txt\""),
                (("cut", "m.off", "-o", "c.off", "--as", "ply"),
                 "--as ply is the format of standard output, and no output is -"),
                (("cut", "m.off", "-o", "c.off", "--json", "-", "--as", "ply"),
                 "--json - is written as json, not as ply"),
                (("cut", "m.off", "-o", "-", "--as", "off", "--json", "-"),
                 "-o and --json are both standard output (-), which takes one of them"),
                (("quads", "m.off", "-o", "-", "--as", "obj"), "there is no option --as")):
            with self.subTest(words=words):
                self.assertIn(sentence, self.morsel(*words, code=2).stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["m.off"])

    def test_help_tells_of_it(self):
        for command in ("field", "points", "segment", "cut", "molecule", "sweep", "stability", "landmarks",
                        "hierarchy"):
            self.assertIn("--as FORMAT", self.morsel(command, "--help").stdout)

    def test_binary_data_are_not_written_to_a_terminal(self):
        for words, code in ((("cut", "m.off", *HEIGHT, "-o", "-", "--as", "ply"), 2),
                            (("render", "m.off", *HEIGHT, *QUICK, "-o", "-"), 2),
                            (("cut", "m.off", *HEIGHT, "-o", "-", "--as", "off"), 0)):
            with self.subTest(words=words):
                control, terminal = pty.openpty()
                result = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=terminal,
                                        stderr=subprocess.PIPE, text=True, timeout=60, check=False)
                os.close(terminal)
                os.close(control)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertEqual("is a terminal" in result.stderr, code == 2)
                self.assertLessEqual(result.stderr.count("\n"), 1)

    def test_a_full_device_and_a_closed_pipe(self):
        if not pathlib.Path("/dev/full").exists():
            self.skipTest("no /dev/full")
        for words in (("cut", "m.off", *HEIGHT, "-o", "-", "--as", "ply"),
                      ("field", "m.off", *HEIGHT, "-o", "-"), ("points", "m.off", *HEIGHT, "-o", "-"),
                      ("render", "m.off", *HEIGHT, *QUICK, "-o", "-")):
            with self.subTest(words=words):
                with open("/dev/full", "wb") as full:
                    result = subprocess.run([PROGRAM, *words, "--quiet"], cwd=self.folder, stdout=full,
                                            stderr=subprocess.PIPE, text=True, timeout=60, check=False)
                self.assertEqual((result.returncode, result.stderr),
                                 (4, "morsel: cannot write to standard output: No space left on device\n"))
                for ignored in (False, True):  # by whoever started it, as a service does
                    reading, writing = os.pipe()
                    os.close(reading)
                    result = subprocess.run([PROGRAM, *words, "--quiet"], cwd=self.folder, stdout=writing,
                                            stderr=subprocess.PIPE, text=True, timeout=60, check=False,
                                            restore_signals=not ignored)
                    os.close(writing)
                    self.assertEqual((result.returncode, result.stderr),
                                     (4, "morsel: cannot write to standard output: Broken pipe\n") if ignored
                                     else (-signal.SIGPIPE, ""))
                closed = subprocess.run(["sh", "-c", 'exec "$0" "$@" >&-', PROGRAM, *words, "--quiet"],
                                        cwd=self.folder, stderr=subprocess.PIPE, text=True, timeout=60,
                                        check=False)
                self.assertEqual((closed.returncode, closed.stderr),
                                 (4, "morsel: cannot write to standard output: Bad file descriptor\n"))

    def test_the_file_behind_standard_output_is_no_input_and_no_other_output(self):
        for words in (("cut", "m.off", *HEIGHT, "-o", "-", "--as", "off"),
                      ("compare", "m.off", *HEIGHT, "-o", "-"),
                      ("cut", "m.off", *HEIGHT, "-o", "o.off", "--json", "-")):
            with self.subTest(words=words):
                with open(self.folder / ("o.off" if "o.off" in words else "m.off"), "ab") as stream:
                    result = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=stream,
                                            stderr=subprocess.PIPE, text=True, timeout=60, check=False)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(self.mesh.read_text(), OCTAHEDRON)

    def test_every_command_with_one_output_has_it(self):
        known = {words[0] for words, _ in COMMANDS} | {"quads", "compare"}
        self.assertEqual(known, set(ON_MESH))


if __name__ == "__main__":
    unittest.main()
