"""morsel quads: the mesh, the document, invalid input."""

import collections
import json
import math
import unittest

import jsonschema
from support import OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, data_lines

QUADS_SCHEMA = SCHEMA.parent / "quads.schema.json"
SADDLES = "9\n8\n-2\n0\n-1\n1\n"  # on the octahedron: two minima, two saddles, two maxima


def read_obj(path):
    vertices, quads = [], []
    for line in data_lines(path):
        kind, *values = line.split()
        if kind == "v":
            vertices.append([float(x) for x in values])
        else:
            quads.append([int(x) - 1 for x in values])
    return vertices, quads


class Quads(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("octahedron.off", OCTAHEDRON)
        self.file("values.txt", SADDLES)

    def quads(self, *arguments):
        result = self.morsel("quads", *arguments, "-o", "quads.obj", "--json", "quads.json")
        report = json.loads((self.folder / "quads.json").read_text())
        return *read_obj(self.folder / "quads.obj"), report, result

    def check(self, vertices, quads, document):
        """A manifold of quads that is what the document says."""
        jsonschema.validate(document, json.loads(QUADS_SCHEMA.read_text()))
        self.assertEqual((len(vertices), len(quads)), (document["quads"]["vertices"],
                                                       document["quads"]["quads"]))
        self.assertTrue(all(len(q) == 4 for q in quads))
        sides = {(q[i], q[(i + 1) % 4]) for q in quads for i in range(4)}
        self.assertEqual(len(sides), 4 * len(quads))
        boundary = {(a, b) for a, b in sides if (b, a) not in sides}
        self.assertEqual(bool(boundary), document["mesh"]["boundary_loops"] > 0)
        edges = {frozenset(side) for side in sides}
        self.assertEqual(len(vertices) - len(edges) + len(quads), document["mesh"]["euler_characteristic"])
        valence = collections.Counter(v for edge in edges for v in edge)
        valences = collections.Counter(valence.values())
        self.assertEqual(dict(valences), {v["valence"]: v["vertices"]
                                          for v in document["quality"]["valences"]})
        on_boundary = {v for side in boundary for v in side}
        self.assertEqual(document["quality"]["extraordinary_vertices"],
                         sum(k != (3 if v in on_boundary else 4) for v, k in valence.items()))
        layout, resolution = document["layout"], document["request"]["resolution"]
        self.assertEqual(layout["patches"], 2 * layout["saddles"])
        self.assertEqual(layout["arcs"], 4 * layout["saddles"])
        self.assertEqual(len(document["patches"]), layout["patches"])
        pentagons = sum(p["sides"] == 5 for p in document["patches"])
        self.assertEqual(pentagons, layout["boundary_patches"])
        self.assertEqual(len(quads), (4 * layout["patches"] + pentagons) * resolution ** 2 // 4)
        area = sum(p["area"] for p in document["patches"])
        self.assertAlmostEqual(area / len(quads) / document["quality"]["area"]["mean"], 1, 9)

    def test_a_field_of_ones_own(self):
        vertices, quads, document, _ = self.quads(self.mesh, "--field", "vertex-scalar:file=values.txt",
                                                  "--resolution", "4", "--relaxation", "0")
        self.check(vertices, quads, document)
        self.assertEqual(document["repairs"], [])
        self.assertEqual([document["layout"][k] for k in ("minima", "saddles", "maxima")], [2, 2, 2])
        # nodes come first: the minima are input vertices 2 and 4
        self.assertEqual(vertices[:2], [[1, 0, 0], [-1, 0, 0]])
        self.assertEqual({p["minimum"] for p in document["patches"]}, {2, 4})
        self.assertEqual({p["maximum"] for p in document["patches"]}, {0, 1})
        for v in vertices:  # on the octahedron
            self.assertAlmostEqual(sum(map(abs, v)), 1, 12)

    def test_the_elephant(self):
        vertices, quads, document, result = self.quads(SAMPLES / "elephant.off", "--field",
                                                       "eigenfunction:index=20",
                                                       "--resolution", "6")
        self.check(vertices, quads, document)
        self.assertIn("patches", result.stdout)
        self.assertIn(f"{len(document['repairs'])} dangling", result.stdout)
        quality = document["quality"]
        self.assertLess(quality["angle"]["mean"], 30)
        self.assertLess(quality["distance"]["max"], 0.06 * document["mesh"]["bbox_diagonal"])
        for repair in document["repairs"]:
            self.assertGreater(repair["persistence"], 0)

    def test_a_boundary_loop(self):
        vertices, quads, document, result = self.quads(SAMPLES / "lion-head.off", "--field",
                                                       "eigenfunction:index=30")
        self.check(vertices, quads, document)
        self.assertGreater(document["layout"]["boundary_patches"], 0)
        self.assertIn("of five sides", result.stdout)

    def test_simplification(self):
        _, _, fine, _ = self.quads(SAMPLES / "elephant.off", "--field", "eigenfunction:index=20")
        vertices, quads, coarse, result = self.quads(SAMPLES / "elephant.off", "--field",
                                                     "eigenfunction:index=20",
                                                     "--persistence", "20%")
        self.check(vertices, quads, coarse)
        self.assertEqual(fine["simplification"], {"threshold": 0, "cancelled_pairs": 0})
        self.assertGreater(coarse["simplification"]["cancelled_pairs"], 0)
        extent = coarse["field"]["max"] - coarse["field"]["min"]
        self.assertTrue(math.isclose(coarse["simplification"]["threshold"], 0.2 * extent))
        self.assertLess(coarse["layout"]["patches"], fine["layout"]["patches"])
        self.assertIn("cancelled", result.stdout)

    def test_two_runs_differ_in_timings_alone(self):
        arguments = (SAMPLES / "elephant.off", "--field", "eigenfunction:index=10")
        first = self.quads(*arguments, "--threads", "1")
        second = self.quads(*arguments, "--threads", "5")
        self.assertEqual(first[:2], second[:2])
        for document in (first[2], second[2]):
            del document["timings"]
        self.assertEqual(first[2], second[2])

    def test_the_document_on_standard_output(self):
        result = self.morsel("quads", self.mesh, "--field", "vertex-scalar:file=values.txt", "-o", "q.obj",
                             "--json", "-")
        self.assertEqual(json.loads(result.stdout)["schema"], "morsel.quads/1")

    def test_what_is_refused(self):
        for arguments, code, words in (
                ((self.mesh, "--field", "height"), 3, ["no saddle", "more critical points"]),
                ((SAMPLES / "lion-head.off", "--resolution", "5"), 2, ["resolution", "even"]),
                ((self.mesh, "--resolution", "1"), 2, ["resolution"]),
                ((self.mesh, "--relaxation", "-1"), 2, ["relaxation"]),
                ((self.mesh, "--persistence", "much"), 2, ["persistence", "much"])):
            result = self.morsel("quads", *arguments, "-o", "bad.obj", "--json", "bad.json", code=code)
            for word in words:
                self.assertIn(word, result.stderr)
            self.assertFalse((self.folder / "bad.obj").exists() or (self.folder / "bad.json").exists())
        result = self.morsel("quads", self.mesh, "-o", "quads.ply", code=2)
        self.assertIn(".obj", result.stderr)
        self.morsel("quads", self.mesh, "-o", f"{self.file('taken', '')}/quads.obj", code=4)


if __name__ == "__main__":
    unittest.main()
