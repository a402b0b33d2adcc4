"""Scenes as GLB files, read by what the specification says: colours, points, arcs, segments."""

import json
import unittest

import numpy as np
from glb import balls_of, read_glb, to_srgb
from support import OCTAHEDRON, SAMPLES, ProgramTest
from test_points import read_ply

LION = SAMPLES / "lion-head.off"
VALUES = "9\n8\n-2\n0\n-1\n1\n"  # on the octahedron: two minima, two saddles, two maxima


def off(path):
    """Vertices and triangles of an OFF file."""
    lines = [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]
    vertices, faces = int(lines[1][0]), int(lines[1][1])
    return (np.array([[float(x) for x in line[:3]] for line in lines[2:2 + vertices]]),
            np.array([[int(v) for v in line[1:4]] for line in lines[2 + vertices:2 + vertices + faces]]))


class Glb(ProgramTest):
    def scene(self, *arguments, name="s.glb"):
        self.morsel(*arguments, "-o", name)
        return read_glb(self.folder / name)[0]

    def test_a_drawn_field(self):
        self.file("values.txt", VALUES)
        mesh = self.file("o.off", OCTAHEDRON)
        parts = self.scene("field", mesh, "--field", "vertex-scalar:file=values.txt")
        self.assertEqual(list(parts), ["surface", "minima", "saddles", "maxima"])
        vertices, faces = off(self.folder / "o.off")
        surface = parts["surface"]
        self.assertEqual(surface["triangles"].tolist(), faces.tolist())
        self.assertEqual(surface["positions"].tolist(), vertices.tolist())
        self.assertEqual(np.round(surface["normals"], 5).tolist(), vertices.tolist())
        self.assertEqual(len(np.unique(surface["colors"], axis=0)), 6)
        diagonal = 2 * 3 ** 0.5
        for name, at, color in (("minima", (2, 4), 0x1f4fd0), ("saddles", (3, 5), 0x1fa040),
                                ("maxima", (0, 1), 0xd01c1f)):
            part = parts[name]
            self.assertEqual(to_srgb(part["colors"]).tolist(), [color >> 16, color >> 8 & 255, color & 255])
            centers, radii = balls_of(part, 2)
            self.assertTrue(np.allclose(radii, 0.0085 * diagonal, rtol=1e-3))
            # as in pictures, more than half of it above the surface
            self.assertTrue(np.allclose(centers, vertices[list(at)] * (1 + 0.3 * radii[0]), atol=1e-6))

    def test_the_surface_has_the_colours_of_ply_files(self):
        for method in ("conventional", "salient"):
            words = ("field", LION, "--method", method)
            parts = self.scene(*words)
            self.morsel(*words, "-o", "s.ply")
            held = read_ply(self.folder / "s.ply")
            colors = [[vertex[channel] for channel in ("red", "green", "blue")] for vertex in held]
            self.assertLessEqual(np.abs(to_srgb(parts["surface"]["colors"]) - colors).max(), 1)
            self.assertLess(np.abs(parts["surface"]["positions"]
                                   - [[vertex[axis] for axis in "xyz"] for vertex in held]).max(), 1e-7)

    def test_chosen_points_take_the_place_of_critical_points(self):
        words = (LION, "--field", "mean-curvature", "--method", "salient", "--points", 7, "--fill", "none")
        self.morsel("points", *words, "-o", "p.ply")
        kinds = [point["type"] for point in read_ply(self.folder / "p.ply")]
        scenes = [self.scene("points", *words), self.scene("field", *words)]
        for parts in scenes:
            for code, name in ((1, "minima"), (3, "maxima")):
                count = kinds.count(code)
                self.assertEqual(name in parts, count > 0)
                if count:
                    balls_of(parts[name], count)
        self.assertTrue(np.array_equal(scenes[0]["maxima"]["positions"], scenes[1]["maxima"]["positions"]))

    def test_segments_have_colours_of_their_own_sharp_at_their_borders(self):
        words = ("segment", LION, "--method", "salient", "--segments", 12)
        surface = self.scene(*words)["surface"]
        self.morsel(*words, "-o", "s.faces.txt")
        self.morsel(*words, "-o", "s.txt")
        labels = np.array([int(line) for line in (self.folder / "s.faces.txt").read_text().splitlines()
                           if not line.startswith("#")])
        vertices, faces = off(LION)
        self.assertTrue(np.allclose(surface["positions"][surface["triangles"]], vertices[faces], atol=1e-7))
        corners = surface["colors"][surface["triangles"]]
        self.assertTrue(np.array_equal(corners.min(axis=1), corners.max(axis=1)))
        of_label = {}
        for label, color in zip(labels.tolist(), corners[:, 0].tolist()):
            self.assertEqual(of_label.setdefault(label, color), color)
        edges = {}
        for face, label in zip(faces.tolist(), labels.tolist()):
            for a, b in zip(face, face[1:] + face[:1]):
                edges.setdefault((min(a, b), max(a, b)), set()).add(label)
        for meeting in edges.values():
            self.assertEqual(len({tuple(of_label[label]) for label in meeting}), len(meeting))

    def test_a_comparison_has_the_arcs_too_if_it_is_asked_for(self):
        self.morsel("compare", LION, "--method", "salient", "--export", "out")
        self.assertFalse((self.folder / "out" / "salient.glb").exists())
        report = self.report(LION, "--method", "salient", "--export", "out", "--glb")
        counts = report["methods"][0]["critical_points"]
        parts, _ = read_glb(self.folder / "out" / "salient.glb")
        self.assertEqual(list(parts), ["surface", "minima", "saddles", "maxima", "descending arcs",
                                       "ascending arcs"])
        vertices, _ = off(LION)
        diagonal = np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0))
        for name in ("minima", "saddles", "maxima"):
            balls_of(parts[name], counts[name])
        for name in ("descending arcs", "ascending arcs"):
            tube = parts[name]["positions"].reshape(-1, 6, 3)
            centers = tube.mean(axis=1)
            radii = np.linalg.norm(tube - centers[:, None], axis=2)
            self.assertLess(radii.max() - radii.min(), 1e-5)
            self.assertLess(radii.max(), 0.003 * diagonal)
            if name == "descending arcs":  # they run along edges
                nearest = [np.abs(vertices - center).sum(axis=1).min() for center in centers]
                self.assertLess(max(nearest), 1e-6)
        self.assertIn("--export", self.morsel("compare", LION, "--glb", code=2).stderr)

    def test_a_scene_is_read_back_as_its_surface(self):
        """`info` of an own scene once counted the spheres of its points, too."""
        self.morsel("compare", LION, "--method", "salient", "--export", "out", "--glb")
        self.morsel("field", LION, "--field", "height:axis=z", "-o", "x.glb")
        expected = json.loads(self.morsel("info", "--json", LION).stdout)
        left_out = ["the points and arcs of the scene are left out"]
        for name in ("x.glb", "out/salient.glb"):
            info = json.loads(self.morsel("info", "--json", name).stdout)
            for key in ("vertices", "edges", "faces", "components", "boundary_loops", "genus"):
                self.assertEqual(info["mesh"][key], expected["mesh"][key], (name, key))
            self.assertEqual(info["mesh"]["warnings"], left_out)
            self.assertIn("provenance", info)
        # Another program's scene is read as it is.
        data = (self.folder / "x.glb").read_bytes().replace(b'"morsel 0', b'"Morsel 0', 1)
        (self.folder / "y.glb").write_bytes(data)
        info = json.loads(self.morsel("info", "--json", "y.glb").stdout)
        self.assertGreater(info["mesh"]["vertices"], expected["mesh"]["vertices"])

    def test_far_and_tiny_and_huge_surfaces(self):
        """Single precision holds neither the places nor the sizes."""
        for scale, shift in ((1, 1e7), (1e-30, 0), (1e100, 0)):
            rows = OCTAHEDRON.splitlines()
            for i in range(2, 8):
                rows[i] = " ".join(repr(float(x) * scale + shift) for x in rows[i].split())
            mesh = self.file("o.off", "\n".join(rows) + "\n")
            surface = self.scene("field", mesh, "--field", "height:axis=z")["surface"]
            expected = off(mesh)[0]
            self.assertTrue(np.allclose(surface["positions"], expected, rtol=1e-6 if scale != 1 else 1e-15,
                                        atol=0))

    def test_what_repair_drops_is_not_there(self):
        mesh = self.file("d.off", "OFF\n4 1 0\n0 0 0\n9 9 9\n1 0 0\n0 1 0\n3 0 2 3\n")
        parts = self.scene("field", mesh, "--repair", "--field", "height:axis=x")
        self.assertEqual(parts["surface"]["positions"].tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])


if __name__ == "__main__":
    unittest.main()
