"""morsel segment: labels in three formats, the table, merging, and errors."""

import collections
import json
import math
import struct
import unittest

import jsonschema
import vtk
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, data_lines
from vtk.util.numpy_support import vtk_to_numpy

SEGMENTS_SCHEMA = SCHEMA.parent / "segments.schema.json"
KINDS = ("descending", "ascending", "morse-smale")

# Two squares of a strip with a hill at each end would have no inner vertex; a ring of triangles around two
# hubs has: vertices 0 and 1 are the hubs, the field along x is highest at 2, 4 and 6 by turns.
STAR = """OFF
8 12 0
0 0 1
0 0 -1
2 0 0
0.5 0.8660254037844386 0
-1 1.7320508075688772 0
-1 0 0
-1 -1.7320508075688772 0
0.5 -0.8660254037844386 0
""" + "".join(f"3 0 {2 + i} {2 + (i + 1) % 6}\n3 1 {2 + (i + 1) % 6} {2 + i}\n" for i in range(6))


def read_ply(path):
    """Positions, segment of each vertex, triangles, segment of each face."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    assert "property int segment" in lines
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    points = [struct.unpack_from("<3di3B", body, 31 * i) for i in range(vertices)]
    start = 31 * vertices
    cells = [struct.unpack_from("<B3Ii3B", body, start + 20 * i) for i in range(faces)]
    assert len(body) == start + 20 * faces
    # a color for each label, others beside it
    colors = {}
    for row in points + [c[1:] for c in cells]:
        assert colors.setdefault(row[3], row[4:]) == row[4:]
    for cell in cells:
        for v in cell[1:4]:
            assert points[v][3] == cell[4] or points[v][4:] != cell[5:]
    return ([p[:3] for p in points], [p[3] for p in points], [c[1:4] for c in cells], [c[4] for c in cells])


def area(a, b, c):
    u, v = ([q[i] - a[i] for i in range(3)] for q in (b, c))
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return math.hypot(*cross) / 2


def pieces(triangles, labels, across_edges):
    """How many pieces each label is in."""
    parent = list(range(len(triangles)))

    def find(t):
        while parent[t] != t:
            parent[t] = parent[parent[t]]
            t = parent[t]
        return t

    seen = {}
    for t, corners in enumerate(triangles):
        parts = [tuple(sorted((corners[i], corners[i - 1]))) for i in range(3)] if across_edges else corners
        for part in parts:
            parent[find(t)] = find(seen.setdefault((part, labels[t]), t))
    return collections.Counter(labels[t] for t in range(len(triangles)) if find(t) == t)


class Segment(ProgramTest):
    def table(self, *arguments, output="out.ply"):
        result = self.morsel("segment", *arguments, "-o", output, "--json", "table.json")
        table = json.loads((self.folder / "table.json").read_text())
        jsonschema.validate(table, json.loads(SEGMENTS_SCHEMA.read_text()))
        self.assertEqual([s["segment"] for s in table["segments"]], list(range(table["count"])))
        return table, result.stderr

    def star(self):
        self.file("values.txt", "0\n-9\n1\n-1\n2\n-2\n3\n-3\n")
        return [self.file("star.off", STAR), "--field", "vertex-scalar:file=values.txt"]

    def test_a_drawn_surface_has_the_segments_drawn(self):
        table, said = self.table(*self.star())
        self.assertIn("segments: 3;", said)
        self.assertEqual([s["maximum"] for s in table["segments"]], [2, 4, 6])
        for s in table["segments"]:
            self.assertEqual((s["minimum"], s["cap"], s["triangles"]), (None, None, 4))
            self.assertEqual([p["type"] for p in s["critical_points"]], ["saddle", "maximum"])
            self.assertEqual(s["critical_points"][0]["vertex"], 0)
            self.assertEqual(s["critical_points"][1]["vertex"], s["maximum"])
            self.assertEqual(s["mesh_boundary_length"], 0)
            self.assertAlmostEqual(s["boundary_length"], sum(n["length"] for n in s["neighbours"]))
            for n in s["neighbours"]:  # one edge down from either hub
                self.assertEqual(n["edges"], 2)
                self.assertAlmostEqual(n["length"], 2 * math.sqrt(2), places=12)
        by_vertex = {p["vertex"]: p["persistence"] for s in table["segments"] for p in s["critical_points"]}
        self.assertEqual(by_vertex, {0: 2, 2: 1, 4: 2, 6: None})
        self.assertEqual(table["merging"], {"segments_before": 3, "cancelled_pairs": 0,
                                            "largest_persistence": 0,
                                            "note": ""})

    def test_merging_takes_the_least_persistent_first(self):
        star = self.star()
        two, said = self.table(*star, "--segments", 2)
        self.assertEqual([s["maximum"] for s in two["segments"]], [4, 6])
        self.assertEqual(two["merging"]["largest_persistence"], 1)
        self.assertIn("segments: 2 of 3 (1 pair cancelled", said)
        same, _ = self.table(*star, "--persistence", 1)
        for table in (two, same):
            del table["timings"], table["request"]
        self.assertEqual(two, same)
        one, _ = self.table(*star, "--persistence", "20%")
        self.assertEqual([s["maximum"] for s in one["segments"]], [6])
        many, _ = self.table(*star, "--segments", 50)
        self.assertEqual(many["count"], 3)
        morse_smale, _ = self.table(*star, "--by", "morse-smale")
        self.assertEqual([(s["minimum"], s["maximum"]) for s in morse_smale["segments"]],
                         [(1, 2), (1, 4), (1, 6)])

    def test_files_agree_and_segments_are_connected(self):
        lion = SAMPLES / "lion-head.off"
        for kind in KINDS:
            for more in ([], ["--segments", 25]):
                table, _ = self.table(lion, "--by", kind, *more)
                points, of_vertex, triangles, of_face = read_ply(self.folder / "out.ply")
                self.assertEqual(sorted(set(of_face)), list(range(table["count"])))
                self.assertLessEqual(set(of_vertex), set(of_face))
                beside = collections.defaultdict(set)
                for corners, label in zip(triangles, of_face):
                    for v in corners:
                        beside[v].add(label)
                self.assertTrue(all(of_vertex[v] in beside[v] for v in range(len(points))))
                self.assertEqual(set(pieces(triangles, of_face, kind == "descending").values()), {1})
                areas = collections.Counter()
                for corners, label in zip(triangles, of_face):
                    areas[label] += area(*(points[v] for v in corners))
                for s in table["segments"]:
                    self.assertAlmostEqual(s["area"], areas[s["segment"]])
                    self.assertEqual(s["triangles"], of_face.count(s["segment"]))
                    self.assertEqual(s["vertices"], of_vertex.count(s["segment"]))
                lengths = {(s["segment"], n["segment"]): n for s in table["segments"]
                           for n in s["neighbours"]}
                for (a, b), n in lengths.items():
                    self.assertEqual((n["length"], n["edges"]),
                                     (lengths[b, a]["length"], lengths[b, a]["edges"]))

                self.morsel("segment", lion, "--by", kind, *more, "-o", "out.txt")
                lines = {name: list(map(int, data_lines(self.folder / f"out.{name}.txt")))
                         for name in ("vertices", "faces")}
                self.assertEqual(lines, {"vertices": of_vertex, "faces": of_face})
                self.morsel("segment", lion, "--by", kind, *more, "-o", "out.vtp")
                reader = vtk.vtkXMLPolyDataReader()
                reader.SetFileName(str(self.folder / "out.vtp"))
                reader.Update()
                surface = reader.GetOutput()
                self.assertEqual(vtk_to_numpy(surface.GetPointData().GetArray("segment")).tolist(), of_vertex)
                self.assertEqual(vtk_to_numpy(surface.GetCellData().GetArray("segment")).tolist(), of_face)
                self.assertIsNotNone(surface.GetPointData().GetArray("mean-curvature"))

    def test_labels_can_be_a_field_again(self):
        lion = SAMPLES / "lion-head.off"
        self.morsel("segment", lion, "--segments", 25, "-o", "out.ply")
        self.morsel("segment", lion, "--segments", 25, "-o", "out.txt")
        self.morsel("field", "out.ply", "--field", "vertex-scalar:property=segment", "-o", "again.txt")
        self.assertEqual(data_lines(self.folder / "again.txt"), data_lines(self.folder / "out.vertices.txt"))

    def test_dropped_vertices_have_no_segment(self):
        mesh = self.file("damaged.off", DAMAGED)
        table, _ = self.table(mesh, "--repair", "--field", "height:axis=x", output="out.ply")
        points, of_vertex, triangles, of_face = read_ply(self.folder / "out.ply")
        self.assertEqual((of_vertex, of_face), ([0, -1, 0, 0, 0], [0, 0]))
        self.assertEqual(triangles, [(0, 2, 3), (0, 3, 4)])
        self.assertEqual(points[1], (9, 9, 9))
        segment, = table["segments"]
        self.assertEqual((segment["maximum"], segment["cap"], segment["vertices"]), (None, 0, 4))
        self.assertEqual((segment["area"], segment["boundary_length"], segment["mesh_boundary_length"]),
                         (1, 4, 4))
        ascending, _ = self.table(mesh, "--repair", "--field", "height:axis=x", "--by", "ascending")
        self.assertEqual(ascending["segments"][0]["minimum"], 0)

    def test_what_cannot_be_merged_is_reported(self):
        # Two components end with a segment each.
        two = self.file("two.off", OCTAHEDRON.replace("6 8 0", "12 16 0").replace("3 0 2 3", "".join(
            f"{x + 9} {y} {z}\n" for x, y, z in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (0, 1, 0), (-1, 0, 0),
                                                 (0, -1, 0)))
            + "".join(f"3 {a + 6} {b + 6} {c + 6}\n" for a, b, c in (
                (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 2), (1, 3, 2), (1, 4, 3), (1, 5, 4), (1, 2, 5)))
            + "3 0 2 3", 1))
        for kind in KINDS:
            table, said = self.table(two, "--field", "height", "--by", kind, "--segments", 1)
            self.assertEqual(table["count"], 2)
            self.assertIn("2 segments, more than the 1 asked for", said)
            self.assertIn("2 segments", table["merging"]["note"])

    def test_the_field_before_and_methods_are_reported(self):
        table, _ = self.table(SAMPLES / "lion-head.off", "--method", "salient:iterations=2", "--target", 100,
                              "--persistence", "1%")
        self.assertEqual(table["method"]["name"], "salient")
        self.assertLessEqual(table["method"]["target"]["reached"], 100)
        self.assertEqual(table["request"], {"field": "mean-curvature", "method": "salient:iterations=2",
                                            "by": "descending", "repair": False, "target": 100,
                                            "persistence": "1%"})

    def test_two_runs_differ_in_timings_only(self):
        tables = []
        for threads in (1, 2, 7):
            table, _ = self.table(SAMPLES / "lion-head.off", "--by", "morse-smale", "--persistence", "1%",
                                  "--threads", threads)
            del table["timings"]
            tables.append((table, (self.folder / "out.ply").read_bytes()))
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(tables[0], tables[2])

    def test_the_table_can_go_to_standard_output(self):
        result = self.morsel("segment", self.file("o.off", OCTAHEDRON), "--field", "height", "-o", "o.ply",
                             "--json", "-")
        self.assertEqual(json.loads(result.stdout)["count"], 1)

    def test_the_schema_refuses_what_it_should(self):
        schema = json.loads(SEGMENTS_SCHEMA.read_text())
        for spoil in (lambda t: t.pop("merging"), lambda t: t["segments"][0].pop("area"),
                      lambda t: t.update(segments=[]),
                      lambda t: t["request"].update(by="both"), lambda t: t.update(more=1),
                      lambda t: t["request"].update(segments=1, persistence="1%"),
                      lambda t: t["segments"][0]["critical_points"][0].update(type="cap")):
            table, _ = self.table(*self.star())
            spoil(table)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(table, schema)

    def test_wrong_usage_and_bad_input_are_refused_before_the_work(self):
        mesh = self.file("o.off", OCTAHEDRON)
        for arguments, code, words in ((["-o", "x.off"], 2, [".ply", ".vtp", ".txt", ".glb", "x.off"]),
                                       ([], 2, ["-o OUT"]),
                                       (["-o", "x.ply", "--by", "both"], 2, ["both", "morse-smale"]),
                                       (["-o", "x.ply", "--segments", "0"], 2, ["segments"]),
                                       (["-o", "x.ply", "--segments", "3", "--persistence", "1%"], 2,
                                        ["one of them"]),
                                       (["-o", "x.ply", "--persistence", "-1%"], 2, ["--persistence", "-1%"]),
                                       (["-o", "x.ply", "--persistence", "much"], 2,
                                        ["--persistence", "much"]),
                                       (["-o", "o.off/x.ply"], 4, ["o.off/x.ply"]),
                                       (["-o", "x.ply", "--json", "o.off/t.json"], 4, ["o.off/t.json"])):
            result = self.morsel("segment", mesh, *arguments, code=code)
            for word in words:
                self.assertIn(word, result.stderr)
        self.morsel("segment", "missing.off", "-o", "x.ply", code=3)
        self.morsel("segment", self.file("d.off", DAMAGED), "-o", "x.txt", "--json", "t.json", code=3)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["d.off", "o.off"])


if __name__ == "__main__":
    unittest.main()
