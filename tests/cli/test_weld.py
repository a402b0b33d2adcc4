"""Meshes whose vertices coincide: told everywhere, and joined by --weld."""

import json
import subprocess
import unittest

import jsonschema
from support import OCTAHEDRON, ON_MESH, PROGRAM, SCHEMA, ProgramTest


def parsed(off):
    lines = off.split("\n")
    vertices, faces = map(int, lines[1].split()[:2])
    return lines[2:2 + vertices], [list(map(int, line.split()[1:])) for line in lines[2 + vertices:][:faces]]


def loose(off, shift=0.0):
    """Each triangle with vertices of its own, the coordinates of each later copy shifted."""
    vertices, faces = parsed(off)
    positions, triangles, seen = [], [], {}
    for face in faces:
        for v in face:
            x, y, z = map(float, vertices[v].split())
            copy = seen[v] = seen.get(v, -1) + 1
            positions.append(f"{x + copy * shift!r} {y!r} {z!r}")
        triangles.append(f"3 {len(positions) - 3} {len(positions) - 2} {len(positions) - 1}")
    return f"OFF\n{len(positions)} {len(triangles)} 0\n" + "\n".join(positions + triangles) + "\n"


def subdivided(off):
    """Each triangle in four, so that there is more than one vertex to a point."""
    vertices, faces = parsed(off)
    middle, triangles = {}, []

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            p, q = ([float(x) for x in vertices[v].split()] for v in key)
            middle[key] = len(vertices)
            vertices.append(" ".join(repr((x + y) * 0.7) for x, y in zip(p, q)))
        return middle[key]

    for a, b, c in faces:
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        triangles += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (f"OFF\n{len(vertices)} {len(triangles)} 0\n" + "\n".join(vertices) + "\n" +
            "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles))


class Weld(ProgramTest):
    def setUp(self):
        super().setUp()
        self.off = subdivided(OCTAHEDRON)  # 18 vertices, 32 faces
        self.whole = self.file("whole.off", self.off)
        self.mesh = self.file("loose.off", loose(self.off))
        self.told = ("78 of 96 vertices coincide with others, so that faces are not joined there; "
                     "welding (--weld) joins them")

    def info(self, *arguments):
        return json.loads(self.morsel("info", "--json", *arguments).stdout)

    def test_info_tells_it_and_what_is_joined(self):
        info = self.info(self.mesh)
        self.assertEqual(info["mesh"]["warnings"], [self.told])
        self.assertEqual(info["mesh"]["components"], 32)
        self.assertRegex(self.morsel("info", self.mesh).stdout, "warning +78 of 96 vertices")
        welded = self.info("--weld", self.mesh)["mesh"]
        self.assertEqual([welded[key] for key in ("vertices", "euler_characteristic", "boundary_loops")],
                         [18, 2, 0])
        self.assertEqual(welded["repairs"], [{"action": "welded_vertices", "count": 78}])
        self.assertNotIn("warnings", welded)
        self.assertNotIn("warnings", self.info(self.whole)["mesh"])

    def test_a_length_joins_what_is_near(self):
        near = self.file("near.off", loose(self.off, 1e-6))
        self.assertNotIn("warnings", self.info(near)["mesh"])
        self.assertEqual(self.info("--weld", near)["mesh"]["components"], 32)
        for length in ("1e-4", "0.1eps", "0.01edges", "0.1%", "0.001rootarea"):
            self.assertEqual(self.info(f"--weld={length}", near)["mesh"]["vertices"], 18)
        for wrong in ("-1", "near", "1meter"):
            self.assertIn("--weld", self.morsel("info", near, f"--weld={wrong}", code=2).stderr)
        # What is too long leaves no face.
        result = self.morsel("field", near, "--weld=10", "-o", "f.txt", code=3)
        self.assertIn("it has no triangle", result.stderr)

    def test_every_command_warns_once_and_all_agree_when_joined(self):
        for command, (words, outputs) in ON_MESH.items():
            with self.subTest(command):
                def run(mesh, *more):
                    names = [word for option, ending in outputs.items()
                             for word in (option, f"{command}{ending}")]
                    line = [str(mesh) if word == "{}" else word for word in words]
                    return subprocess.run([PROGRAM, *line, *names, *more], capture_output=True, text=True,
                                          cwd=self.folder, check=False)

                result = run(self.mesh)
                self.assertEqual(result.stderr.count(f"morsel: warning: {self.told}\n"), 1, result.stderr)
                if result.returncode:  # another cause is not left as the only one
                    self.assertEqual(result.returncode, 3)
                    self.assertIn(f"; the cause may be that {self.told}", result.stderr)
                else:
                    self.validate(outputs.values(), command, [self.told])
                joined = run(self.mesh, "--weld")
                self.assertNotIn("coincide", joined.stderr)
                if command == "quads":  # the height of a sphere has no saddle
                    self.assertIn("there is no quad layout", joined.stderr)
                    continue
                self.assertEqual(joined.returncode, 0, joined.stderr)
                self.validate(outputs.values(), command, None)

    def validate(self, endings, command, warnings):
        if ".json" not in endings:
            return
        document = json.loads((self.folder / f"{command}.json").read_text())
        name = document["schema"].removeprefix("morsel.").split("/")[0]
        jsonschema.validate(document, json.loads((SCHEMA.parent / f"{name}.schema.json").read_text()))
        self.assertEqual(document["mesh"].get("warnings"), warnings)
        self.assertEqual(document["request"].get("weld"), None if warnings else "0")

    def test_results_are_those_of_the_whole_mesh_in_the_numbers_of_the_file(self):
        self.morsel("field", self.whole, "--field", "height", "-o", "whole.txt")
        self.morsel("field", self.mesh, "--field", "height", "--weld", "-o", "loose.txt")

        def values(name):
            return [float(line) for line in (self.folder / name).read_text().split("\n")
                    if line and not line.startswith("#")]

        corners = [v for face in parsed(self.off)[1] for v in face]
        whole = values("whole.txt")
        self.assertEqual(values("loose.txt"), [whole[v] for v in corners])
        report = self.report(self.mesh, "--weld", "--field", "height", "--method", "conventional")
        items = report["methods"][0]["items"]
        self.assertEqual({corners[item["vertex"]] for item in items if item["type"] == "minimum"}, {1})
        self.assertEqual(report["request"]["weld"], "0")

    def test_check_runs_it_again(self):
        for weld in ([], ["--weld"], ["--weld=0.1eps", "--repair"]):
            self.report(self.mesh, *weld, "--field", "height")
            self.assertIn("unchanged", self.morsel("check", "report.json").stdout)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual((report["request"]["weld"], report["request"]["repair"]), ("0.1eps", True))
        report["request"]["weld"] = "-1"
        self.file("report.json", json.dumps(report))
        self.morsel("check", "report.json", code=3)

    def test_values_that_differ_are_told(self):
        values = [0.0] * 96
        values[95] = 0.25
        self.file("values.txt", "\n".join(map(str, values)) + "\n")
        result = self.morsel("field", self.mesh, "--weld", "--field", "vertex-scalar:file=values.txt", "-o",
                             "f.txt")
        self.assertIn("joined vertices have different values in values.txt at 1 (by up to 0.25)",
                      result.stderr)

    def test_batch_tells_and_joins(self):
        (self.folder / "meshes").mkdir()
        self.file("meshes/a.off", loose(self.off))
        batch = ("batch", "meshes", "--out", "out", "--field", "height", "--method", "conventional",
                 "--no-thumbnails")
        self.assertIn(f"morsel: warning: a.off: {self.told}\n", self.morsel(*batch).stderr)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["meshes"][0]["mesh"]["warnings"], [self.told])
        self.assertIn(self.told, (self.folder / "out" / "index.html").read_text())
        self.assertNotIn("coincide", self.morsel(*batch, "--weld").stderr)  # not taken from the earlier run
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["request"]["weld"], "0")
        self.assertEqual(summary["meshes"][0]["mesh"]["vertices"], 18)

    def test_landmarks_tell_and_join(self):
        self.file("marks.txt", "0\n4\n40\n")
        self.file("list.txt", "loose.off marks.txt\n")
        result = self.morsel("landmarks", "list.txt", "--weld", "--field", "height", "-o", "l.json",
                             "--resamples", "100")
        self.assertNotIn("coincide", result.stderr)
        document = json.loads((self.folder / "l.json").read_text())
        self.assertEqual((document["request"]["weld"], document["meshes"][0]["mesh"]["vertices"]), ("0", 18))
        self.assertIn("unchanged", self.morsel("check", "l.json").stdout)

    def test_what_info_calls_repairable_is_repaired(self):
        nan = self.file("nan.off", OCTAHEDRON.replace("6 8 0", "7 8 0")
                        .replace("0 -1 0\n3", "0 -1 0\nnan 0 0\n3"))
        info = self.info(nan)
        self.assertEqual([d["kind"] for d in info["defects"]], ["unreferenced_vertex"])
        self.assertTrue(info["repairable"])
        self.assertTrue(self.info("--repair", nan)["valid"])
        used = self.file("used.off", OCTAHEDRON.replace("0 0 1\n", "nan 0 1\n", 1)
                         .replace("3 1 2 5", "3 1 1 5"))
        info = self.info(used)
        self.assertFalse(info["repairable"])
        text = self.morsel("info", used).stdout
        self.assertIn("vertex with a non-finite coordinate (0); no repair fixes this", text)
        self.assertRegex(text, r"after --repair +no mesh: it still has 1 vertex with a non-finite coordinate")
        self.assertFalse(self.info("--repair", used)["valid"])


if __name__ == "__main__":
    unittest.main()
