"""Wrong usage, bad input, writing that fails, interruption: one clear sentence, the right exit code, no file
left."""

import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import time
import unittest

from support import DAMAGED, OCTAHEDRON, ON_MESH, PROGRAM, SAMPLES, ProgramTest


class RefusedMesh(ProgramTest):
    def test_every_command_names_the_file_of_a_mesh_that_it_refuses(self):
        self.assertEqual(set(ON_MESH), {name for name in self.commands() if " MESH" in self.usage(name)})
        damaged = self.file("damaged.off", DAMAGED)
        for command, (words, options) in ON_MESH.items():
            with self.subTest(command=command):
                outputs = (word for option, ending in options.items()
                           for word in (option, f"out{option}{ending}"))
                result = self.morsel(*(word.format(damaged) for word in words), *outputs, code=3)
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
        self.refuse("--field", "mean-curvature:estimator=fast",
                    naming=["fast", "taubin", "cotangent", "quadric"])
        self.refuse("--field", "shape-index:estimator=quadric,radius=0", naming=["radius", "0"])
        self.refuse("--field", "mean-curvature:estimator=diffused,diffusion=0", naming=["diffusion", "0"])
        self.refuse("--field", "mean-curvature:diffusion=8eps",
                    naming=["diffusion", "estimator=diffused", "taubin"])
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
        for command, said in (
                (("nonsense",), "no command \"nonsense\""),
                (("comapre", "m.off"), "did you mean compare?"),
                (("compare.d",), 'there is no command "compare.d"; did you mean compare?'),
                (("--threads", "3", "compare"), "--threads came before"),
                (("help", "comapre"), "did you mean compare?"),
                (("help", "compare", "field"), '"field" is one argument too many'),
                (("help", "compare", "--x"), "help has no option --x"),
                (("help", "--x"), "help has no option --x"),
                (("--versoin",), "there is no option --versoin; did you mean --version?"),
                (("--nonsense", "compare"), "there is no option --nonsense (morsel --help"),
                (("compare", "m.off", "-z"), "there is no option -z (morsel compare --help"),
                (("compare",), "compare needs MESH"),
                (("cut", "m.off"), "cut needs -o OUT"),
                (("compare", "m.off", "n.off"), '"n.off" is one argument too many (morsel compare'),
                (("compare", "m.off", "--weld", "0.01"),
                 '"0.01" is one argument too many; a value of --weld is written with =: --weld=0.01 ('),
                (("compare", "--weld", "0.1eps", "m.off"),
                 '"m.off" is one argument too many; a value of --weld is written with =: --weld=0.1eps ('),
                (("compare", "--weld", "m.off", "n.off"), '"n.off" is one argument too many (morsel compare'),
                (("compare", "m.off", "--nonsense"), "no option --nonsense"),
                (("compare", "m.off", "--feild=height"), "no option --feild; did you mean --field?"),
                (("cut", "m.off", "--ouput", "x.off"), "did you mean --output?"),
                (("compare", "m.off", "--method"), "--method needs a value: M"),
                (("compare", "m.off", "-o"), "-o needs a value: REPORT.json"),
                (("compare", "m.off", "--quiet=3"), "--quiet takes no value"),
                (("render", "m.off", "-o", "x.png", "--no-points=false"), "--no-points takes no value"),
                (("compare", "m.off", "--field", "height", "--field", "height"), "--field was given 2 times"),
                (("compare", "m.off", "--up", "w"), "--up must be x, y or z, not \"w\""),
                (("molecule", "m.pdb", "-o", "m.off", "--kind", "guassian"), "did you mean gaussian?"),
                (("segment", "m.off", "-o", "m.ply", "--by", "descendin"),
                 '--by must be descending, ascending or morse-smale, not "descendin"; did you mean '
                 'descending?'),
                (("render", "m.off", "-o", "m.png", "--colormap", "viridi"), "did you mean viridis?"),
                (("render", "m.off", "-o", "m.png", "--colormap", ""), "--colormap must be blue-orange, "),
                (("render", "m.off", "-o", "m.png", "--view", "fron"),
                 'there is no view "fron"; did you mean front? There are: best, front, '),
                (("compare", "m.off", "--field", "mean-curvature:estimator=taubn"),
                 "did you mean taubin?"),
                (("reproduce", "new", "--view", "loin=front"), 'no model "loin"; did you mean lion?'),
                (("reproduce", "new", "--up", "w"), 'the axis that points up must be x, y or z, not "w"'),
                (("batch", "x", "--out", "y", "--size", "3x3"), "--size needs --figures"),
                (("batch", "x", "--out", "y", "--inset", "3"), "--inset needs --figures"),
                (("compare", "m.off", "--size", "3x3"), "--size needs --figures"),
                (("compare", "m.off", "--inset", "3", "--html", "m.html"), "--inset needs --figures"),
                (("compare", "m.off", "--html-place", "m.html"), "--html-place needs --html"),
                (("batch", "x", "--out", "y", "--plan", "--summary-only"),
                 "--plan and --summary-only exclude"),
                (("batch", "x", "--out", "y", "--time-limit", "0"), "a finite number above 0, not \"0\""),
                (("batch", "x", "--out", "y", "--memory-limit", "9"), "a whole number from 64 to"),
                (("compare", "m.off", "--target", "0"), "a whole number of at least 1, not \"0\""),
                (("compare", "m.off", "--target", "3.5"), "--target must be a whole number"),
                (("stability", "m.off", "--noise", "0.1,,2"), "--noise must be a finite number, not \"\""),
                (("stability", "m.off", "--seed", "99999999999999999999"), "--seed must be a whole number"),
                (("methods", "saliet"), "no method \"saliet\"; did you mean salient?"),
                (("fields", "salient"), "no Morse function \"salient\"")):
            with self.subTest(command):
                self.assertIn(said, self.morsel(*command, code=2).stderr)
        for value in ("0", "many", "-1", "", "5000", "1e3"):
            self.assertIn(f'--threads must be a whole number from 1 to 4096, not "{value}"',
                          self.morsel("compare", "m.off", "--threads", value, code=2).stderr)

    def test_options_are_read_however_they_are_written(self):
        mesh = self.file("-m.off", OCTAHEDRON)
        self.file("m.off", OCTAHEDRON)
        plain = ("compare", "m.off", "--field", "height", "--method", "conventional", "--method", "salient",
                 "-o", "-")
        report = json.loads(self.morsel(*plain).stdout)
        report.pop("timings")
        for words in (
                ("m.off", "--field=height", "--method=conventional", "--method", "salient", "--output=-"),
                ("compare", "--field", "height", "--method", "conventional", "m.off", "--method", "salient",
                 "-o-"),
                ("compare", "-o", "-", "--field", "height", "--method", "conventional", "--method", "salient",
                 "--", "m.off")):
            again = json.loads(self.morsel(*words).stdout)
            again.pop("timings")
            self.assertEqual(again, report, words)
        self.assertIn("vertices", self.morsel("info", "--", mesh.name).stdout)

    def test_a_missing_file_named_like_a_mesh_is_one_to_compare(self):
        for name in ("missing.off", "missing.PLY", "missing.stl", "missing.obj"):
            self.assertIn(name, self.morsel(name, code=3).stderr)
        shutil.copy(self.mesh, self.folder / "mesh.txt")  # there is one, whatever its name
        self.assertIn("meshes are read from", self.morsel("mesh.txt", code=3).stderr)

    def test_help(self):
        """Without a command, with an option and as a command; the same text for each command, which fits a
        terminal."""
        text = self.morsel().stdout
        self.assertEqual(self.morsel("--help").stdout, text)
        for words in (("help",), ("help", "help"), ("help", "--help"), ("help", "help", "--help")):
            self.assertEqual(self.morsel(*words).stdout, text)
        self.assertIn("compare", self.commands())
        for command in self.commands():
            text = self.morsel(command, "--help").stdout
            self.assertEqual(self.morsel("help", command).stdout, text)
            self.assertTrue(text.startswith(f"Usage: morsel {command} "), text)
            examples = text.split("Examples:")[1]
            self.assertGreaterEqual(len(re.findall(rf"\n  morsel {command}\b", examples)), 2)
            for internal in ("->", "POSITIVE", "INT in", "{false}", "OR {"):
                self.assertNotIn(internal, text)
            self.assertLessEqual(len(text.splitlines()), 48, command)
            for line in text.splitlines():
                self.assertTrue(len(line) <= 100 or line.startswith("  morsel "), line)
        self.assertRegex(self.morsel("--version").stdout, r"^morsel \d+\.\d+\.\d+\n$")

    def test_names_are_listed(self):
        for command, names in (("fields", ("mean-curvature", "height")), ("methods", ("salient", "tps"))):
            listed = self.morsel(command).stdout.splitlines()
            for name in names:
                self.assertTrue(any(line.startswith(f"{name} ") for line in listed), name)
            for line in listed:
                name = line.split()[0]
                self.assertTrue(self.morsel(command, name).stdout.startswith(f"{name}: "))
        for key in ("iterations=10", "sigma=8eps"):
            self.assertIn(key, self.morsel("methods", "salient").stdout)
        self.assertIn("axis=z", self.morsel("fields", "height").stdout)

    def test_every_example_of_help_is_read(self):
        """None has a name, a key or an option that does not exist: each ends with a file that is missing."""
        for command in ON_MESH:
            text = self.morsel(command, "--help").stdout
            for example in re.findall(r"^  morsel (.*)$", text, re.MULTILINE):
                with self.subTest(example):
                    self.assertIn(example.split()[1], self.morsel(*shlex.split(example), code=3).stderr)


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
        two = self.file("two.off", "OFF\n12 16 0\n" + "\n".join(" ".join(map(str, row))
                                                                for row in both) + "\n")
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
                            ("1\n2\ninf\n4\n5\n6\n", ["inf"]), ("1\n2\n3\n4\n5\n1e999\n", ["1e999"])):
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
        self.file("taken", "")
        self.morsel("compare", self.mesh, "-o", "taken/report.json", code=4)
        self.morsel("field", self.mesh, "-o", "taken/below/z.txt", code=4)
        self.morsel("compare", self.mesh, "--export", "taken", code=4)

    def test_folders_of_a_target_are_made(self):
        """As those of --figures are; of a run that fails none is left."""
        self.morsel("field", self.mesh, "-o", "new/deep/z.txt")
        self.morsel("compare", self.mesh, "--method", "conventional", "-o", "new/r.json", "--html",
                    "pages/p.html",
                    "--figures", "figures/octahedron", "--size", "60x42")
        for made in ("new/deep/z.txt", "new/r.json", "pages/p.html", "figures/octahedron/conventional.png"):
            self.assertTrue((self.folder / made).is_file(), made)
        damaged = self.file("damaged.off", DAMAGED)
        self.morsel("field", damaged, "-o", "other/deep/z.txt", code=3)
        self.morsel("compare", damaged, "-o", "other/r.json", "--html", "other/p.html", "--export", "other/e",
                    "--figures",
                    "other/f", code=3)
        self.morsel("hierarchy", damaged, "--export", "other/deep/e", code=3)
        self.morsel("sweep", damaged, "--vary", "iterations=1..2", "--figures", "other", "-o", "more/s.csv",
                    code=3)
        for folder in ("other", "more"):
            self.assertFalse((self.folder / folder).exists(), folder)

    def test_an_output_of_another_format_is_refused_in_one_wording(self):
        """Before it is found to be the input, in every command."""
        for words, said in (
                (("field", "x.jpg", "-o", "x.jpg"),
                 "a field is written to .txt, .ply, .vtp, .glb, .shape.gii or .func.gii"),
                (("segment", "x.jpg", "-o", "x.jpg"),
                 "labels are written to .ply, .vtp, .txt, .annot, .label.gii or .glb"),
                (("points", "x.jpg", "-o", "x.jpg"), "points are written to .csv, .json, .ply, .vtp or .glb"),
                (("cut", "x.jpg", "-o", "x.jpg"), "a cut mesh is written to .off or .ply"),
                (("cut", "x.jpg", "-o", "x.off", "--graph", "x.jpg"),
                 "a cut is written for ParaView to .vtp"),
                (("quads", "x.jpg", "-o", "x.jpg"), "quads are written to .obj"),
                (("render", "x.jpg", "-o", "x.jpg"), "a picture is written to .png"),
                (("molecule", "x.jpg", "-o", "x.jpg"), "a surface is written to .off or .ply"),
                (("stability", "x.jpg", "-o", "x.jpg"), "a table is written to .json or .csv"),
                (("sweep", "x.jpg", "--vary", "iterations=1..2", "-o", "x.jpg"),
                 "a table is written to .json or .csv")):
            with self.subTest(words):
                self.assertIn(f'morsel: {said}, not to "x.jpg"\n', self.morsel(*words, code=2).stderr)
        self.assertEqual(os.listdir(self.folder), [self.mesh.name])

    def test_a_document_does_not_replace_a_mesh(self):
        """`morsel compare a.off -o b.off` once replaced the second scan by a report."""
        meshes = [self.file(f"scan{ending}", "the only copy") for ending in (".off", ".OBJ", ".ply", ".stl")]
        for command, (words, options) in ON_MESH.items():
            if command in ("field", "points", "render"):
                continue  # of which a mesh is a format, or that name theirs
            for option in options.keys() & {"-o", "--html", "--json"}:
                if option == "-o" and command in ("segment", "cut", "quads"):
                    continue
                for mesh in meshes:
                    required = () if option == "-o" else ("-o", f"free{options['-o']}")
                    with self.subTest(command=command, option=option, mesh=mesh.name):
                        result = self.morsel(*(word.format(self.mesh) for word in words), *required, option,
                                             mesh.name, code=2)
                        self.assertIn(mesh.name, result.stderr)
                        self.assertEqual(mesh.read_text(), "the only copy")
        self.assertEqual(sorted(os.listdir(self.folder)),
                         sorted([self.mesh.name, *(mesh.name for mesh in meshes)]))

    def test_outputs_are_tried_before_the_mesh_is_read(self):
        self.file("taken", "")
        for command, (words, options) in ON_MESH.items():
            for option, ending in options.items():
                required = () if option == "-o" else ("-o", f"free{options['-o']}")
                with self.subTest(command=command, option=option):
                    self.morsel(*(word.format("missing.off") for word in words), *required, option,
                                f"taken/x{ending}", code=4)

    def test_a_pipe_gets_the_whole_file(self):
        for words, ending in ((("field",), ".txt"), (("points",), ".csv"), (("cut",), ".off"),
                              (("segment",), ".ply"), (("render", "--size", "40x30"), ".png")):
            command = (words[0], self.mesh, "--field", "height", *words[1:], "-o")
            pipe = self.folder / f"pipe-{words[0]}{ending}"
            os.mkfifo(pipe)
            with self.subTest(words), subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE) as reader:
                self.morsel(*command, pipe)
                read, _ = reader.communicate(timeout=60)
                self.morsel(*command, f"file{ending}")
                self.assertEqual(read, (self.folder / f"file{ending}").read_bytes())

    def test_an_ending_in_capital_letters_is_that_format(self):
        plain = ("--field", "height", "--method", "conventional")
        for words in (("field", self.mesh, *plain), ("segment", self.mesh, *plain),
                      ("points", self.mesh, *plain), ("cut", self.mesh, *plain)):
            for ending in (".ply", ".PLY"):
                self.morsel(*words, "-o", f"{words[0]}{ending}")
            small, capital = ((self.folder / f"{words[0]}{ending}").read_bytes()
                              for ending in (".ply", ".PLY"))
            self.assertEqual(capital, small, words)
        self.morsel("cut", self.mesh, *plain, "-o", "c.OFF", "--graph", "c.VTP")
        self.assertTrue((self.folder / "c.OFF").read_bytes().startswith(b"OFF"))
        self.assertIn(b"VTKFile", (self.folder / "c.VTP").read_bytes())

    def test_a_full_device(self):
        if not pathlib.Path("/dev/full").exists():
            self.skipTest("no /dev/full")
        self.morsel("compare", self.mesh, "-o", "/dev/full", code=4)
        with open("/dev/full", "w", encoding="ascii") as full:
            result = subprocess.run([PROGRAM, "compare", self.mesh], stdout=full, stderr=subprocess.PIPE,
                                    check=False)
        self.assertEqual(result.returncode, 4)

    def test_a_bad_method_leaves_the_old_report_as_it_was(self):
        self.file("report.json", "old")
        self.morsel("compare", self.mesh, "--field", "vertex-scalar:property=none", "-o", "report.json",
                    code=3)
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
