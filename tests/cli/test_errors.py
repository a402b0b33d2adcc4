"""Wrong usage, bad input, writing that fails, interruption: one clear sentence, the right exit code, no file left."""

import os
import pathlib
import signal
import subprocess
import time
import unittest

from support import DAMAGED, OCTAHEDRON, PROGRAM, SAMPLES, ProgramTest


class RefusedMesh(ProgramTest):
    def test_every_command_names_the_file_of_a_mesh_that_it_refuses(self):
        damaged = self.file("damaged.off", DAMAGED)
        for command in (["compare"], ["field", "-o", "f.txt"], ["hierarchy"], ["segment", "-o", "s.ply"],
                        ["cut", "-o", "c.off"], ["quads", "-o", "q.obj"], ["render", "-o", "r.png"]):
            with self.subTest(command=command[0]):
                result = self.morsel(command[0], damaged, *command[1:], code=3)
                self.assertIn("damaged.off", result.stderr)
                self.assertIn("--repair", result.stderr)


class Usage(ProgramTest):
    def refuse(self, *arguments, naming):
        result = self.morsel("compare", self.mesh, *arguments, code=2)
        for word in naming:
            self.assertIn(word, result.stderr)

    def setUp(self):
        super().setUp()
        self.mesh = self.file("octahedron.off", OCTAHEDRON)

    def test_unknown_names_and_keys_list_the_valid_ones(self):
        self.refuse("--field", "hight", naming=["hight", "height", "mean-curvature", "vertex-scalar"])
        self.refuse("--method", "nonsense", naming=["nonsense", "conventional", "salient", "tps"])
        self.refuse("--method", "salient:iteration=3", naming=["iteration", "iterations", "sigma", "range"])
        self.refuse("--field", "mean-curvature:axis=z", naming=["axis"])

    def test_values_out_of_range_are_named(self):
        self.refuse("--method", "salient:sigma=0", naming=["sigma", "0"])
        self.refuse("--method", "salient:iterations=-1", naming=["iterations", "-1"])
        self.refuse("--method", "salient:range=-2", naming=["range", "-2"])
        self.refuse("--method", "salient:precision=single,ball=connected", naming=["precision", "connected"])
        self.refuse("--method", "gaussian:sigma=0", naming=["gaussian:sigma", "0"])
        self.refuse("--method", "saliency:scales=2eps/0", naming=["scales", "0"])
        self.refuse("--method", "denoise:sigma-c=0", naming=["sigma-c", "0"])
        self.refuse("--field", "mean-curvature:scale=-1edges", naming=["mean-curvature:scale", "-1"])
        self.refuse("--field", "shape-index:scale=wide", naming=["shape-index:scale", "3edges", "wide"])
        self.refuse("--method", "salient:preset=best", naming=["preset", "paper", "robust", "best"])
        self.refuse("--method", "tps+salient:preset=robust", naming=["salient", "tps", "first step"])
        self.refuse("--method", "salient+denoise", naming=["denoise", "salient", "first step"])
        self.refuse("--method", "tps:threshold=-5", naming=["threshold", "-5"])
        self.refuse("--method", "tps:threshold=nan", naming=["threshold", "nan"])
        self.refuse("--method", "tps:threshold=1%,count=5", naming=["threshold", "count"])
        self.refuse("--field", "height:axis=w", naming=["axis", "w"])
        self.refuse("--field", "mean-curvature:estimator=fast", naming=["fast", "taubin", "cotangent", "quadric"])
        self.refuse("--field", "shape-index:estimator=quadric,radius=0", naming=["radius", "0"])
        self.refuse("--field", "mean-curvature:estimator=diffused,diffusion=0", naming=["diffusion", "0"])
        self.refuse("--field", "mean-curvature:diffusion=8eps", naming=["diffusion", "estimator=diffused", "taubin"])
        self.refuse("--field", "shape-index:estimator=diffused", naming=["diffused", "taubin", "quadric"])
        self.refuse("--field", "height:direction=0/0/0", naming=["direction"])
        self.refuse("--field", "vertex-scalar", naming=["file", "property"])

        self.refuse("--field", "eigenfunction:index=0", naming=["index", "0"])
        self.refuse("--field", "geodesic", naming=["source"])
        self.refuse("--field", "geodesic:source=-3", naming=["source", "-3"])
        self.refuse("--field", "geodesic:source=max-w", naming=["source", "max-w", "max-z"])
        self.refuse("--method", "spectral:modes=0", naming=["modes", "0"])
        self.refuse("--method", "fair:extrema=0", naming=["extrema", "0"])

    def test_broken_specifications(self):
        self.refuse("--method", "salient:", naming=["salient:"])
        self.refuse("--method", "salient:iterations", naming=["key=value"])
        self.refuse("--method", "salient++tps", naming=["empty name"])
        self.refuse("--field", "height+height", naming=["chain"])

    def test_wrong_options(self):
        self.morsel(code=2)
        self.morsel("nonsense", code=2)
        self.morsel("compare", code=2)
        self.refuse("--nonsense", naming=["--nonsense"])
        self.refuse("--threads", "0", naming=["threads"])
        self.refuse("--threads", "many", naming=["threads"])

    def test_help_teaches(self):
        self.assertIn("compare", self.morsel("--help").stdout)
        text = self.morsel("compare", "--help").stdout
        for word in ("mean-curvature", "salient", "sigma=8eps", "threshold=0.1%", "--export"):
            self.assertIn(word, text)
        for command in ("field", "info", "check"):
            self.assertIn("Usage", self.morsel(command, "--help").stdout)
        self.assertRegex(self.morsel("--version").stdout, r"^morsel \d+\.\d+\.\d+\n$")


class BadInput(ProgramTest):
    def test_meshes(self):
        for name, text, words in (
                ("empty.off", "", ["empty.off"]),
                ("points.off", "OFF\n1 0 0\n0 0 0\n", ["triangle"]),
                ("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", ["index.off"]),
                ("nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", ["nan.off"]),
                ("mesh.xyz", "1 2 3\n", [".off", ".obj", ".ply", ".stl"])):
            result = self.morsel("compare", self.file(name, text), "-o", "report.json", code=3)
            for word in words:
                self.assertIn(word, result.stderr)
            self.assertEqual(sorted(p.name for p in self.folder.iterdir() if "report" in p.name), [])
        self.morsel("compare", "absent.off", code=3)
        self.morsel("compare", self.folder, code=3)

    def test_values_that_do_not_fit_the_mesh(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        corners = [[int(x) for x in line.split()] for line in OCTAHEDRON.splitlines()[2:]]
        vertices, faces = corners[:6], corners[6:]
        both = [(x + dx, y, z) for dx in (0, 9) for x, y, z in vertices]
        both += [(3, a + d, b + d, c + d) for d in (0, 6) for _, a, b, c in faces]
        two = self.file("two.off", "OFF\n12 16 0\n" + "\n".join(" ".join(map(str, row)) for row in both) + "\n")
        for path, option, text, words in (
                (mesh, "--field", "eigenfunction:index=6", ["6", "1 to 5"]),
                (mesh, "--field", "geodesic:source=6", ["vertex 6", "6 vertices"]),
                (two, "--field", "geodesic:source=0", ["1 of 2 components"]),
                (two, "--field", "geodesic:mode=average", ["2 components"]),
                (mesh, "--method", "spectral:modes=6", ["6", "1 to 5"]),
                (two, "--method", "fair:extrema=3", ["3 extrema", "at least 4"])):
            result = self.morsel("compare", path, option, text, code=3)
            for word in words:
                self.assertIn(word, result.stderr)

    def test_a_refused_mesh_names_defect_place_number_and_repair(self):
        fan = "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n"
        result = self.morsel("compare", self.file("fan.off", fan), code=3)
        for word in ("1 non-manifold edge", "0-1", "--repair"):
            self.assertIn(word, result.stderr)

    def test_field_files(self):
        mesh = self.file("o.off", OCTAHEDRON)
        for text, words in (("1\n2\n3\n", ["6", "3"]), ("1\n2\nx\n4\n5\n6\n", ["line 3", "x"]),
                            ("1\n2\nnan\n4\n5\n6\n", ["nan"]), ("1\n2\n3\n4\n5\n1e999\n", ["1e999"])):
            self.file("f.txt", text)
            result = self.morsel("compare", mesh, "--field", "vertex-scalar:file=f.txt", code=3)
            for word in words + ["f.txt"]:
                self.assertIn(word, result.stderr)
        self.morsel("compare", mesh, "--field", "vertex-scalar:file=absent.txt", code=3)
        self.morsel("compare", mesh, "--field", "vertex-scalar:property=absent", code=3)


class Writing(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("octahedron.off", OCTAHEDRON)

    def test_a_target_that_cannot_be_written(self):
        self.morsel("compare", self.mesh, "-o", "absent/report.json", code=4)
        self.morsel("field", self.mesh, "-o", "absent/z.txt", code=4)
        self.file("taken", "")
        self.morsel("compare", self.mesh, "--export", "taken", code=4)

    def test_a_full_device(self):
        if not pathlib.Path("/dev/full").exists():
            self.skipTest("no /dev/full")
        self.morsel("compare", self.mesh, "-o", "/dev/full", code=4)
        with open("/dev/full", "w", encoding="ascii") as full:
            result = subprocess.run([PROGRAM, "compare", self.mesh], stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 4)

    def test_a_bad_method_leaves_the_old_report_as_it_was(self):
        self.file("report.json", "old")
        self.morsel("compare", self.mesh, "--field", "vertex-scalar:property=none", "-o", "report.json", code=3)
        self.assertEqual((self.folder / "report.json").read_text(), "old")
        self.assertEqual(sorted(os.listdir(self.folder)), ["octahedron.off", "report.json"])


class Interruption(ProgramTest):
    def test_signals_stop_the_work_and_leave_nothing(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            process = subprocess.Popen(
                [PROGRAM, "compare", SAMPLES / "bunny00.off", "--method", "salient:iterations=100000", "-o",
                 self.folder / "report.json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(1.5)
            process.send_signal(number)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code, errors)
            self.assertEqual(errors, b"morsel: interrupted\n")
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
