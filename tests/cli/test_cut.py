"""morsel cut: the cut mesh, its document and its lines for ParaView."""

import collections
import json
import struct
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, data_lines

ELEPHANT = SAMPLES / "refined_elephant.off"


def read_off(path):
    """Positions as texts, and faces."""
    words = " ".join(data_lines(path)).split()
    assert words[0] == "OFF"
    vertices, faces = int(words[1]), int(words[2])
    at = 4 + 3 * vertices
    positions = [tuple(words[i:i + 3]) for i in range(4, at, 3)]
    triangles = []
    for _ in range(faces):
        assert words[at] == "3"
        triangles.append(tuple(map(int, words[at + 1:at + 4])))
        at += 4
    return positions, triangles


def read_input_vertices(path):
    """The property of a PLY file that has x, y, z and input_vertex, all double."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    assert [line.split()[2] for line in lines if line.startswith("property double")] == ["x", "y", "z",
                                                                                         "input_vertex"]
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    return [int(row[3]) for row in struct.iter_unpack("<4d", body[:32 * count])]


class Cut(ProgramTest):
    def cut(self, *arguments, out="cut.off"):
        self.morsel("cut", *arguments, "-o", out, "--json", "cut.json")
        document = json.loads((self.folder / "cut.json").read_text())
        jsonschema.validate(document, json.loads((SCHEMA.parent / "cut.schema.json").read_text()))
        return document

    def test_a_drawn_mesh_has_the_right_numbers(self):
        document = self.cut(self.file("o.off", OCTAHEDRON))
        self.assertEqual(document["field"]["name"], "height")
        self.assertAlmostEqual(document["cut"]["length"], 2 * 2 ** 0.5)
        self.assertEqual([p["vertices"] for p in document["cut"]["paths"]], [[0, 2, 1]])
        self.assertEqual(document["output"], {"vertices": 7, "faces": 8, "first_copy": 6, "copied": [2]})
        component, = document["cut"]["components"]
        self.assertEqual((component["vertices"], component["genus"], component["boundary_loops"],
                          component["copies"]),
                         (6, 0, 0, 1))

    def test_the_cut_mesh_is_a_disc_that_glues_back(self):
        document = self.cut(ELEPHANT, "--graph", "cut.vtp")
        info = json.loads(self.morsel("info", "cut.off", "--json").stdout)
        self.assertEqual((info["mesh"]["euler_characteristic"], info["mesh"]["boundary_loops"]), (1, 1))
        positions, triangles = read_off(self.folder / "cut.off")
        original_positions, original_triangles = read_off(ELEPHANT)
        copied = document["output"]["copied"]
        count = document["output"]["first_copy"]
        self.assertEqual(count, len(original_positions))
        self.assertEqual(len(positions), count + len(copied))
        glued = [tuple(v if v < count else copied[v - count] for v in t) for t in triangles]
        self.assertEqual(glued, original_triangles)
        for v, copy in enumerate(copied, start=count):
            self.assertEqual(positions[v], positions[copy])
        # The edges with one triangle are two for each edge of the paths.
        sides = collections.Counter(frozenset((t[i], t[i - 1])) for t in triangles for i in range(3))
        rim = [tuple(sorted(v if v < count else copied[v - count] for v in side))
               for side, uses in sides.items() if uses == 1]
        steps = [tuple(sorted(step)) for path in document["cut"]["paths"]
                 for step in zip(path["vertices"], path["vertices"][1:])]
        self.assertEqual(sorted(rim), sorted(2 * steps))
        self.assertEqual(len(steps), document["cut"]["edges"])

    def test_shortening_shortens(self):
        short = self.cut(ELEPHANT)
        long = self.cut(ELEPHANT, "--no-shorten")
        self.assertEqual(short["cut"]["length_found"], long["cut"]["length_found"])
        self.assertEqual(long["cut"]["length"], long["cut"]["length_found"])
        self.assertLess(short["cut"]["length"], 0.6 * long["cut"]["length"])
        self.assertTrue(short["cut"]["shortening"]["settled"])
        self.assertNotIn("shortening", long["cut"])

    def test_ply_says_which_vertex_each_copies(self):
        document = self.cut(ELEPHANT, out="cut.ply")
        count = document["output"]["first_copy"]
        self.assertEqual(read_input_vertices(self.folder / "cut.ply"),
                         list(range(count)) + document["output"]["copied"])

    def test_several_components_with_boundaries_and_threads(self):
        documents = []
        for threads in (1, 3):
            document = self.cut(SAMPLES / "b9_mesh.off", "--threads", threads)
            del document["timings"]
            documents.append((document, (self.folder / "cut.off").read_bytes()))
        self.assertEqual(documents[0], documents[1])
        document = documents[0][0]
        self.assertEqual(sum(c["copies"] for c in document["cut"]["components"]),
                         len(document["output"]["copied"]))
        self.assertAlmostEqual(sum(c["length"] for c in document["cut"]["components"]),
                               document["cut"]["length"])
        info = json.loads(self.morsel("info", "cut.off", "--json").stdout)
        self.assertEqual(info["mesh"]["euler_characteristic"], document["mesh"]["components"])
        self.assertEqual(info["mesh"]["boundary_loops"], document["mesh"]["components"])

    def test_a_repaired_mesh_keeps_the_inputs_numbers_in_the_document(self):
        document = self.cut(self.file("d.off", DAMAGED), "--repair")
        self.assertEqual(document["output"]["input_vertices"], [0, 2, 3, 4])
        self.assertEqual(document["output"]["copied"], [])

    def test_a_field_that_was_simplified(self):
        document = self.cut(ELEPHANT, "--field", "mean-curvature", "--method", "salient:iterations=2",
                            "--target", 100)
        self.assertEqual(document["request"]["target"], 100)
        self.assertLessEqual(document["method"]["target"]["reached"], 100)

    def test_what_cannot_be_is_refused_before_work(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.assertIn(".off or .ply", self.morsel("cut", mesh, "-o", "x.stl", code=2).stderr)
        self.assertIn(".vtp", self.morsel("cut", mesh, "-o", "x.off", "--graph", "x.csv", code=2).stderr)
        self.morsel("cut", mesh, "-o", "o.off/x.off", code=4)
        self.morsel("cut", mesh, "-o", "x.off", "--json", "o.off/x.json", code=4)
        self.morsel("cut", mesh, "-o", "x.off", "--field", "no-such-field", code=2)
        self.morsel("cut", "missing.off", "-o", "x.off", code=3)
        self.assertFalse((self.folder / "x.off").exists())

    def test_the_document_can_go_to_standard_output(self):
        result = self.morsel("cut", self.file("o.off", OCTAHEDRON), "-o", "x.off", "--json", "-")
        self.assertEqual(json.loads(result.stdout)["schema"], "morsel.cut/1")


if __name__ == "__main__":
    unittest.main()
