"""The program with a small stack (`ulimit -s`), and in a system without devices."""

import json
import re
import resource
import shutil
import signal
import subprocess
import unittest

from support import OCTAHEDRON, ON_MESH, PROGRAM, SAMPLES, ProgramTest, until

# A mesh of which dense eigenproblems are as large as they get.
MESH = SAMPLES / "anchor.off"


class SmallStack(ProgramTest):
    def limited(self, *arguments, kib=256, code=0):
        def limit():
            resource.setrlimit(resource.RLIMIT_STACK, (kib << 10, kib << 10))
        return self.morsel(*arguments, code=code, preexec_fn=limit)

    def test_every_method_runs(self):
        """`spectral` ended by SIGSEGV."""
        methods = re.findall(r"^([a-z]+) ", self.morsel("methods").stdout, re.MULTILINE)
        self.assertIn("spectral", methods)
        for kib in (128, 256):
            for method in methods:
                with self.subTest(method=method, kib=kib):
                    words = ("compare", MESH, "--field", "height", "--method", method, "-o")
                    self.limited(*words, "small.json", kib=kib)
                    self.morsel(*words, "usual.json")
                    small, usual = (json.loads((self.folder / name).read_text())
                                    for name in ("small.json", "usual.json"))
                    self.assertEqual(small["methods"][-1]["critical_points"],
                                     usual["methods"][-1]["critical_points"])

    def test_every_command_runs(self):
        mesh = self.file("m.off", OCTAHEDRON)
        for command, (words, options) in ON_MESH.items():
            if command == "quads":
                continue  # needs another field
            with self.subTest(command):
                self.limited(*(word.format(mesh) for word in words),
                             *(word for option, ending in options.items()
                               for word in (option, f"{command}{option}{ending}")))
        self.limited("quads", MESH, "--field", "eigenfunction:index=8", "-o", "q.obj")
        self.limited("compare", mesh, "--method", "conventional", "--figures", "f", "--size", "60x42",
                     "--export", "e", "-o", "r.json")
        self.limited("check", "r.json")
        (self.folder / "meshes").mkdir()
        shutil.copy(mesh, self.folder / "meshes/m.off")
        self.limited("batch", "meshes", "--out", "out", "--method", "conventional")

    def test_a_signal_interrupts_a_run_with_a_small_stack(self):
        words = ("compare", self.file("m.off", OCTAHEDRON), "--field", "height", "--method",
                 "salient:iterations=1000000", "-o", "x/r.json")
        for how, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, -signal.SIGHUP)):
            with self.subTest(how):
                with subprocess.Popen(["bash", "-c", 'ulimit -s 256; exec "$@"', "-", PROGRAM,
                                       *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, text=True) as process:
                    until(lambda process=process: process.poll() is not None
                          or (self.folder / "x").exists())
                    process.send_signal(how)
                    self.assertEqual(process.communicate(timeout=60)[1], "morsel: interrupted\n")
                self.assertEqual(process.returncode, code)
                self.assertFalse((self.folder / "x").exists())


class WithoutDevices(ProgramTest):
    def test_a_batch_needs_no_dev_null(self):
        """It ended with "this is a defect of the program"."""
        def without(*command):
            return subprocess.run(["unshare", "-m", "sh", "-c", 'mount -t tmpfs tmpfs /dev && exec "$@"', "-",
                                   *map(str, command)], cwd=self.folder, capture_output=True, text=True,
                                  timeout=240, stdin=subprocess.PIPE, check=False)
        if shutil.which("unshare") is None or without("true").returncode != 0:
            self.skipTest("no file system can be mounted")
        self.assertNotEqual(without("test", "-e", "/dev/null").returncode, 0)
        (self.folder / "meshes").mkdir()
        for name in ("a.off", "b.off"):
            (self.folder / "meshes" / name).write_text(OCTAHEDRON)
        (self.folder / "meshes/bad.off").write_text("junk")
        result = without(PROGRAM, "batch", "meshes", "--out", "out", "--method", "conventional")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("2 done, 1 failed", result.stdout)
        self.assertIn("bad.off: failed: ", result.stderr)


if __name__ == "__main__":
    unittest.main()
