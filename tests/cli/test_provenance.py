"""Every file that the program writes has its provenance: version, inputs with hashes, resolved
parameters; and is the same when it is made again. A reader for each kind of file, written from what the
documentation says."""

import hashlib
import json
import re
import shutil
import struct
import unittest
import xml.etree.ElementTree as xml
import zlib

import jsonschema
import networkx
from glb import read_glb
from support import OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, read_csv
from test_molecule import atom
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

PROVENANCE_SCHEMA = SCHEMA.parent / "provenance.schema.json"
VALUES = "9\n8\n-2\n0\n-1\n1\n"  # on the octahedron: two minima, two saddles, two maxima


def of_png(path):
    data, at, texts = path.read_bytes(), 8, {}
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0], path
        if kind == b"tEXt":
            keyword, text = body.split(b"\0")
            texts[keyword.decode()] = text.decode("latin-1")
        at += 12 + size
    document = json.loads(texts["Comment"])
    assert texts["Software"] == "morsel " + document["tool"]["version"]
    return document


def of_svg(path):
    return json.loads(xml.parse(path).getroot().findtext("{http://www.w3.org/2000/svg}metadata"))


def of_vtp(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    array = reader.GetOutput().GetFieldData().GetAbstractArray("provenance")
    assert array.GetNumberOfValues() == 1
    return json.loads(array.GetValue(0))


def of_lines(path, mark):
    """Of comment lines, which are short: some readers take no long ones."""
    lines = [line.decode() for line in path.read_bytes().split(b"end_header")[0].splitlines()
             if line.startswith(mark)]
    assert max(map(len, lines)) < 500
    return json.loads("".join(line[len(mark):] for line in lines))


def of_html(path):
    return json.loads(re.findall(r"<!-- ([^\n]*) -->\n$", path.read_text())[-1])


def of_object(path):
    """The object as it is among other bytes."""
    text = path.read_bytes().decode("latin-1")
    return json.JSONDecoder().raw_decode(text, text.index('{"schema":"morsel.provenance/1"'))[0]


def of_glb(path):
    return read_glb(path)[1]["extras"]["provenance"]


def of_graphml(path):
    return json.loads(networkx.read_graphml(path).graph["provenance"])


READERS = {".annot": of_object, ".gii": of_object, ".glb": of_glb, ".graphml": of_graphml,
           ".csv": lambda path: of_lines(path, b"# "),
           ".png": of_png, ".svg": of_svg, ".vtp": of_vtp, ".ply": lambda path: of_lines(path, b"comment "),
           ".off": lambda path: of_lines(path, b"# "), ".obj": lambda path: of_lines(path, b"# "),
           ".txt": lambda path: of_lines(path, b"# "), ".html": of_html,
           ".pml": lambda path: of_lines(path, b"# "), ".cxc": lambda path: of_lines(path, b"# "),
           ".pdb": lambda path: of_lines(path, b"REMARK 999 ")}


def without_timings(path):
    """The part of a file that must be the same when it is made again."""
    if path.suffix == ".json":
        document = json.loads(path.read_text())
        document.pop("timings", None)
        document.pop("seconds", None)  # of the state of a batch
        return document
    if path.suffix == ".csv":
        return [{k: v for k, v in row.items() if k != "seconds"} for row in read_csv(path)]
    if path.suffix == ".html":
        text = re.sub(r'"timings":\s*\{.*?\}\s*\}', "", path.read_text(), flags=re.DOTALL)
        return re.sub(r"<small>[\d.]+ s</small>|\bout[13]\b", "",
                      text)  # pages show the command that makes them
    return path.read_bytes()


class Provenance(ProgramTest):
    def setUp(self):
        super().setUp()
        self.schema = json.loads(PROVENANCE_SCHEMA.read_text())
        self.version = self.morsel("--version").stdout.split()[1]
        shutil.copy(SAMPLES / "sphere.off", self.folder / "a mesh--1.off")
        self.mesh = "a mesh--1.off"
        self.octahedron = self.file("octahedron.off", OCTAHEDRON).name
        self.values = self.file("values.txt", VALUES).name

    def sha256(self, name):
        return hashlib.sha256((self.folder / name).read_bytes()).hexdigest()

    def written_twice(self, *arguments, expected):
        """The files that a command writes into {out}; it writes the same, but for timings, at another number
        of threads."""
        runs = []
        for threads in (1, 3):
            out = self.folder / f"out{threads}"
            out.mkdir()
            self.morsel(*(str(word).format(out=out.name) for word in arguments), "--threads", threads)
            runs.append({str(path.relative_to(out)): path for path in sorted(out.rglob("*"))
                         if path.is_file() and path.name != ".morsel-results"})
        self.assertEqual(set(runs[0]), set(expected))
        self.assertEqual({name: without_timings(path) for name, path in runs[0].items()},
                         {name: without_timings(path) for name, path in runs[1].items()})
        shutil.rmtree(self.folder / "out3")
        return runs[0]

    def check_document(self, document, path):
        jsonschema.validate(document, self.schema)
        self.assertEqual(document["tool"]["version"], self.version)
        # The program finds what the reader found.
        self.assertEqual(json.loads(self.morsel("info", path, "--json").stdout)["provenance"], document)

    def check(self, files, command, inputs, methods, shown=None, keys=("mean-curvature", "estimator")):
        """`methods`: names of all; `shown`: those that a file shows, by its name, where these are not all."""
        hashes = [{"path": name, "sha256": self.sha256(name)} for name in inputs]
        for name, path in files.items():
            with self.subTest(file=name):
                if path.suffix == ".json":
                    document = json.loads(path.read_text())
                    self.assertEqual(document["tool"]["version"], self.version)
                    self.assertEqual((document["mesh"]["path"], document["mesh"]["sha256"]),
                                     (inputs[0], hashes[0]["sha256"]))
                    self.assertIn("request", document)
                    continue
                document = READERS[path.suffix](path)
                self.check_document(document, path)
                self.assertTrue(document["command"].startswith(f"morsel {command} "), document["command"])
                self.assertNotRegex(document["command"], "out1|threads")
                self.assertEqual(document["inputs"], hashes)
                if methods:
                    self.assertEqual(document["field"]["name"], keys[0])
                    self.assertIn(keys[1], document["field"]["parameters"])
                    wanted = next((show for start, show in (shown or {}).items() if name.startswith(start)),
                                  methods)
                    self.assertEqual([method["name"] for method in document["methods"]], wanted)
                    for method in document["methods"]:
                        if method["name"] == "salient":
                            self.assertGreater(method["parameters"]["sigma"], 0)  # 8eps, in the mesh's unit

    def test_compare(self):
        methods = ["conventional", "salient", "tps"]
        files = self.written_twice(
            "compare", self.mesh, "-o", "{out}/report.json", "--html", "{out}/page.html", "--figures",
            "{out}", "--size", "60x42",
            "--export", "{out}", "--glb", "--thumbnails", "{out}/small", expected={
                "report.json", "page.html", "small.first.png", "small.last.png", "sheet.png",
                *(f"{all_methods}.{kind}" for all_methods in ("diagrams", "persistence", "iterations")
                  for kind in ("png", "svg")),
                *(f"{method}.{kind}" for method in methods for kind in (
                    "png", "diagram.png", "diagram.svg", "surface.vtp", "complex.vtp", "nodes.vtp",
                    "complex.graphml", "glb", "points.csv"))})
        shown = {f"{method}.": [method] for method in methods} | {"small.first": ["conventional"],
                                                                  "small.last": ["tps"]}
        self.check(files, "compare", [self.mesh], methods, shown)

    def test_field(self):
        for kind in ("txt", "ply", "vtp", "glb", "shape.gii"):
            files = self.written_twice("field", self.octahedron, "--field",
                                       f"vertex-scalar:file={self.values}", "--method",
                                       "salient:iterations=2", "-o", f"{{out}}/f.{kind}",
                                       expected={f"f.{kind}"})
            self.check(files, "field", [self.octahedron, self.values], ["salient"],
                       keys=("vertex-scalar", "file_sha256"))
            shutil.rmtree(self.folder / "out1")

    def test_hierarchy(self):
        files = self.written_twice(
            "hierarchy", self.mesh, "--levels", "0,2", "-o", "{out}/h.json", "--export", "{out}",
            expected={"h.json", "surface.0.vtp", "surface.1.vtp", "complex.0.vtp", "complex.1.vtp"})
        self.check(files, "hierarchy", [self.mesh], ["salient"])
        self.assertEqual(of_vtp(files["surface.1.vtp"])["level"], {"place": 1, "asked": "2"})
        self.assertEqual(of_vtp(files["surface.1.vtp"])["request"]["levels"], "0,2")

    def test_segment(self):
        for kind, names in (("ply", {"s.ply"}), ("vtp", {"s.vtp"}), ("glb", {"s.glb"}),
                            ("annot", {"s.annot"}), ("label.gii", {"s.label.gii"}),
                            ("txt", {"s.vertices.txt", "s.faces.txt"})):
            files = self.written_twice("segment", self.mesh, "--persistence", "1%", "-o", f"{{out}}/s.{kind}",
                                       "--json",
                                       "{out}/s.json", expected={"s.json", *names})
            self.check(files, "segment", [self.mesh], ["conventional"])
            shutil.rmtree(self.folder / "out1")

    def test_points(self):
        for kind in ("csv", "json", "ply", "vtp", "glb"):
            files = self.written_twice("points", self.mesh, "--field", "mean-curvature", "--method",
                                       "salient:iterations=2", "--rank", "salience", "-o",
                                       f"{{out}}/p.{kind}", expected={f"p.{kind}"})
            self.check(files, "points", [self.mesh], ["salient"])
            shutil.rmtree(self.folder / "out1")
        files = self.written_twice("points", self.octahedron, "--field", "height", "--fill",
                                   f"vertex-scalar:file={self.values}", "--points", "6", "--kind", "all",
                                   "-o", "{out}/p.ply", expected={"p.ply"})
        document = READERS[".ply"](files["p.ply"])
        self.check_document(document, files["p.ply"])
        self.assertEqual([file["path"] for file in document["inputs"]], [self.octahedron, self.values])
        self.assertEqual(document["fill"]["name"], "vertex-scalar")
        self.assertEqual(document["fill"]["parameters"]["file_sha256"], self.sha256(self.values))

    def test_cut(self):
        for kind in ("off", "ply"):
            files = self.written_twice("cut", self.mesh, "--field", "mean-curvature", "--method",
                                       "salient+tps:count=8", "-o",
                                       f"{{out}}/c.{kind}", "--json", "{out}/c.json", "--graph",
                                       "{out}/g.vtp",
                                       expected={f"c.{kind}", "c.json", "g.vtp"})
            self.check(files, "cut", [self.mesh], ["salient+tps"])
            self.assertEqual(READERS[f".{kind}"](files[f"c.{kind}"])["request"]["shorten"], True)
            shutil.rmtree(self.folder / "out1")

    def test_quads(self):
        files = self.written_twice("quads", self.octahedron, "--field", f"vertex-scalar:file={self.values}",
                                   "-o",
                                   "{out}/q.obj", "--json", "{out}/q.json", expected={"q.obj", "q.json"})
        self.check(files, "quads", [self.octahedron, self.values], ["conventional"],
                   keys=("vertex-scalar", "file"))
        report = json.loads(files["q.json"].read_text())
        self.assertEqual(report["field"]["parameters"]["file_sha256"], self.sha256(self.values))

    def test_render(self):
        files = self.written_twice("render", self.mesh, "--method", "salient", "--size", "160x120",
                                   "--samples", "1", "--inset", "7",
                                   "--view=-20/10", "--caption", "über <&> --", "-o", "{out}/p.png",
                                   expected={"p.png"})
        self.check(files, "render", [self.mesh], ["salient"])
        document = of_png(files["p.png"])
        self.assertEqual(document["command"],
                         "morsel render 'a mesh--1.off' --method salient --size 160x120 --samples 1 "
                         "--inset 7 --view=-20/10 --caption 'über <&> --'")
        self.assertEqual(document["picture"]["inset"], {"vertex": 7, "radius": "15eps"})
        self.assertEqual((document["picture"]["view"], document["picture"]["caption"]),
                         ("-20/10", "über <&> --"))

    def test_residues(self):
        self.file("two.pdb", atom(1, (0, 0, 0)) + atom(2, (2, 0, 0)))
        self.morsel("molecule", "two.pdb", "-o", "two.off")
        for kind in ("pml", "cxc", "pdb"):
            self.morsel("segment", "two.off", "--field", "height", "-o", "s.txt", "--molecule", "two.pdb",
                        "--residues", f"r.{kind}")
            document = READERS[f".{kind}"](self.folder / f"r.{kind}")
            self.check_document(document, self.folder / f"r.{kind}")
            self.assertEqual([file["path"] for file in document["inputs"]], ["two.off", "two.pdb"])
            self.assertEqual(document["request"]["residues"]["atoms"]["radii"], "auto")

    def test_molecule(self):
        self.file("two.pdb", atom(1, (0, 0, 0)) + atom(2, (2, 0, 0)))
        for kind in ("off", "ply"):
            files = self.written_twice("molecule", "two.pdb", "-o", f"{{out}}/m.{kind}",
                                       expected={f"m.{kind}"})
            self.check(files, "molecule", ["two.pdb"], [])
            request = READERS[f".{kind}"](files[f"m.{kind}"])["request"]
            self.assertEqual((request["kind"], request["resolution"], request["hetero"]),
                             ("gaussian", 0.5, "residues"))
            shutil.rmtree(self.folder / "out1")

    def test_stability(self):
        for kind in ("json", "csv"):
            files = self.written_twice("stability", self.mesh, "--noise", "0.1", "--trials", "2", "--seed",
                                       "7", "-o",
                                       f"{{out}}/s.{kind}", "--figures", "{out}",
                                       expected={f"s.{kind}", "noise.png", "noise.svg"})
            self.assertEqual(of_svg(files["noise.svg"])["request"]["seed"], 7)
            if kind == "json":
                self.check(files, "stability", [self.mesh], [])
                self.assertEqual(json.loads(files["s.json"].read_text())["request"]["seed"], 7)
            else:
                for row in without_timings(files["s.csv"]):
                    self.assertEqual((row["version"], row["mesh"], row["sha256"], row["seed"]),
                                     (self.version, self.mesh, self.sha256(self.mesh), "7"))
                    self.assertIn("estimator", json.loads(row["field_parameters"]))
                    json.loads(row["method_parameters"])
            shutil.rmtree(self.folder / "out1")

    def test_landmarks(self):
        (self.folder / "marks.txt").write_text("0 3 5\n")
        (self.folder / "marked.csv").write_text(f"{self.mesh},marks.txt\n")
        inputs = ["marked.csv", self.mesh, "marks.txt"]
        files = self.written_twice("landmarks", "marked.csv", "--seed", "7", "-o", "{out}/l.json",
                                   "--figures", "{out}",
                                   expected={"l.json", *(f"{plot}.{kind}" for plot in ("errors", "scores")
                                                         for kind in ("png", "svg"))})
        document = json.loads(files.pop("l.json").read_text())
        mesh, = document["meshes"]
        self.assertEqual(
            [document["list"], {key: mesh["mesh"][key] for key in ("path", "sha256")}, mesh["marks"]],
            [{"path": name, "sha256": self.sha256(name)} for name in inputs])
        self.assertEqual((document["tool"]["version"], document["request"]["seed"]), (self.version, 7))
        self.assertIn("spread", mesh["fields"][0]["parameters"])
        self.check(files, "landmarks", inputs, [])
        self.assertEqual(of_svg(files["errors.svg"])["request"], document["request"])
        shutil.rmtree(self.folder / "out1")
        files = self.written_twice("landmarks", "marked.csv", "-o", "{out}/l.csv", expected={"l.csv"})
        for row in without_timings(files["l.csv"]):
            self.assertEqual((row["version"], row["mesh"], row["sha256"], row["marks_sha256"]),
                             (self.version, self.mesh, self.sha256(self.mesh), self.sha256("marks.txt")))

    def test_sweep(self):
        files = self.written_twice("sweep", self.mesh, "--vary", "iterations=1..3", "--vary",
                                   "range=1std,local", "-o",
                                   "{out}/s.json", "--figures", "{out}",
                                   expected={"s.json", *(f"{key}.{kind}" for key in ("iterations", "range")
                                                         for kind in ("png", "svg"))})
        self.check(files, "sweep", [self.mesh], [])
        self.assertEqual(of_svg(files["range.svg"])["request"]["variations"][0],
                         {"key": "iterations", "values": ["1", "2", "3"]})
        shutil.rmtree(self.folder / "out1")
        files = self.written_twice("sweep", self.octahedron, "--field", f"vertex-scalar:file={self.values}",
                                   "--vary",
                                   "iterations=1..3", "-o", "{out}/s.csv", expected={"s.csv"})
        for row in without_timings(files["s.csv"]):
            self.assertEqual((row["version"], row["mesh"], row["sha256"]),
                             (self.version, self.octahedron, self.sha256(self.octahedron)))
            self.assertEqual(json.loads(row["field_parameters"])["file_sha256"], self.sha256(self.values))

    def test_reproduce(self):
        names = ("lion", "squirrel", "protein")
        (self.folder / "data").mkdir()
        for name in names:
            shutil.copy(self.folder / self.mesh, self.folder / "data" / f"{name}.off")
        panels = {1: "abcd", 2: "ab", 3: "abcde", 4: "abc"}
        files = self.written_twice(
            "reproduce", "{out}", "--data", "data", "--size", "40x34", "--samples", "1",
            expected={"table1.csv", "controls.csv", "torus.off", "reproduction.json", "index.html",
                      "section3.1.png", *(f"section3.1{letter}.png" for letter in "abcd"),
                      *(f"figure{n}.png" for n in panels),
                      *(f"figure{n}{letter}.png" for n, letters in panels.items() for letter in letters)})
        meshes = [{"path": f"data/{name}.off", "sha256": self.sha256(self.mesh)} for name in names]
        meshes.append({"path": "torus.off", "sha256": self.sha256(files["torus.off"])})
        for name, path in files.items():
            with self.subTest(file=name):
                if name == "reproduction.json":
                    document = json.loads(path.read_text())
                    self.assertEqual(document["tool"]["version"], self.version)
                    self.assertEqual([{k: model["mesh"][k] for k in meshes[0]}
                                      for model in document["models"]], meshes)
                elif name in ("table1.csv", "controls.csv"):
                    for row in without_timings(path):
                        self.assertEqual((row["version"], row["sha256"]), (self.version, meshes[0]["sha256"]))
                        self.assertIn("estimator", json.loads(row["field_parameters"]))
                        self.assertEqual("sigma" in json.loads(row["method_parameters"]),
                                         row["method"].startswith("salient"))
                else:
                    document = READERS[path.suffix](path)
                    self.check_document(document, path)
                    self.assertTrue(all(file in meshes for file in document["inputs"]))
                    if name == "torus.off":
                        self.assertEqual(document["inputs"], [])
                        continue
                    self.assertTrue(document["runs"] if name == "index.html" else document["methods"])
                    panel = re.fullmatch(r"(figure\d|section3\.1)[a-e]\.png", name)
                    self.assertTrue(document["command"].startswith("morsel render "
                                                                   if panel else "morsel reproduce "))

    def test_batch(self):
        (self.folder / "meshes").mkdir()
        for name in ("a.off", "b.off"):
            shutil.copy(self.folder / self.mesh, self.folder / "meshes" / name)
        files = self.written_twice(
            "batch", "meshes", "--out", "{out}", expected={
                "summary.csv", "summary.json", "index.html",
                *(f"plots/{plot}.svg" for plot in ("histogram", "cumulative", "against-size")),
                *(name for mesh in "ab" for name in (f"reports/{mesh}.off.json", f"state/{mesh}.off.json",
                                                     f"thumbnails/{mesh}.off.first.png",
                                                     f"thumbnails/{mesh}.off.last.png"))})
        hashed = self.sha256(self.mesh)
        sums = "".join(f"{hashed}  {name}\n" for name in ("a.off", "b.off"))
        collection = [{"path": "meshes", "sha256": hashlib.sha256(sums.encode()).hexdigest()}]
        for name, path in files.items():
            with self.subTest(file=name):
                if path.suffix == ".json":
                    text = path.read_text()
                    self.assertIn(f'"version": "{self.version}"', text)
                    self.assertIn(f'"sha256": "{hashed}"', text)
                    self.assertIn('"sigma":', text)
                elif path.suffix == ".csv":
                    for row in without_timings(path):
                        self.assertEqual((row["version"], row["sha256"], row["field"]),
                                         (self.version, hashed, "mean-curvature"))
                        self.assertIn("estimator", json.loads(row["field_parameters"]))
                        self.assertEqual("sigma" in json.loads(row["method_parameters"]),
                                         row["method"] == "salient")
                else:
                    document = READERS[path.suffix](path)
                    self.check_document(document, path)
                    self.assertEqual(document["inputs"], collection if path.suffix != ".png" else [
                        {"path": f"meshes/{path.name[:5]}", "sha256": hashed}])
                    self.assertEqual(document["request"]["methods"],
                                     ["conventional", "salient", "tps:count=salient"])

    def test_no_command_is_left_out(self):
        """A new command has its files looked at here, too."""
        tested = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        writing = {name for name in self.commands() if "[OPTIONS]" in self.usage(name)}
        self.assertEqual(writing - tested, {"info", "check"})  # which write no file

    def test_a_command_is_told_without_what_leaves_the_contents_of_files_as_they_are(self):
        """However an option is written."""
        shutil.copy(self.folder / self.mesh, self.folder / "-m.off")
        for words, told in (
                (("a mesh--1.off", "-o", "f.txt", "--threads", "3", "--field", "height"),
                 "'a mesh--1.off' --field height"),
                (("--quiet", "--threads=1", "--field=height", "-of.txt", "--", "-m.off"),
                 "--field=height -- -m.off"),
                (("a mesh--1.off", "--output=f.txt", "--repair"), "'a mesh--1.off' --repair")):
            self.morsel("field", *words)
            self.assertEqual(of_lines(self.folder / "f.txt", b"# ")["command"], f"morsel field {told}")
        self.morsel("cut", self.mesh, "-o", "c.off", "--json", "c.json", "--graph=g.vtp")
        self.assertEqual(of_vtp(self.folder / "g.vtp")["command"], "morsel cut 'a mesh--1.off'")
        self.morsel("compare", self.mesh, "--method", "conventional", "-or.json", "--html", "p.html",
                    "--html-place", "there.html", "--view=-20/10", "--export=e")
        self.assertEqual(of_html(self.folder / "p.html")["command"],
                         "morsel compare 'a mesh--1.off' --method conventional --view=-20/10")


if __name__ == "__main__":
    unittest.main()
