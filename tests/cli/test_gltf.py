"""glTF files of an independent writer, as meshes of the program."""

import hashlib
import json
import math
import random
import shutil
import struct
import unittest

from support import ProgramTest


def glb(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A) + text \
        + struct.pack("<II", len(binary), 0x004E4942) + binary


class Writer:
    """A glTF document, accessor by accessor."""

    def __init__(self):
        self.binary = b""
        self.document = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "meshes": [],
                         "nodes": []}

    def accessor(self, code, component, kind, rows, **more):
        width = len(rows[0])
        self.binary += b"\0" * (-len(self.binary) % 4)
        data = struct.pack(f"<{width * len(rows)}{code}", *(value for row in rows for value in row))
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        self.document["accessors"].append({"bufferView": len(self.document["bufferViews"]) - 1, "type": kind,
                                           "componentType": component, "count": len(rows), **more})
        return len(self.document["accessors"]) - 1

    def bytes(self):
        self.document["buffers"] = [{"byteLength": len(self.binary)}]
        return glb(self.document, self.binary)


def wavy_sphere(steps):
    """Positions in single precision, triangles and a value for each vertex."""
    single = lambda value: struct.unpack("<f", struct.pack("<f", value))[0]
    positions = [(0.0, 0.0, 1.0)]
    for i in range(1, steps):
        for j in range(2 * steps):
            theta, phi = math.pi * i / steps, math.pi * j / steps
            r = 1 + 0.1 * math.sin(3 * theta) * math.cos(4 * phi)
            positions.append(tuple(map(single, (r * math.sin(theta) * math.cos(phi),
                                                r * math.sin(theta) * math.sin(phi), r * math.cos(theta)))))
    positions.append((0.0, 0.0, -1.0))
    ring = lambda i, j: 1 + (i - 1) * 2 * steps + j % (2 * steps)
    triangles = []
    for j in range(2 * steps):
        triangles.append((0, ring(1, j), ring(1, j + 1)))
        triangles.append((len(positions) - 1, ring(steps - 1, j + 1), ring(steps - 1, j)))
        for i in range(1, steps - 1):
            triangles += [(ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)),
                          (ring(i, j), ring(i + 1, j + 1), ring(i, j + 1))]
    generator = random.Random(7)
    return positions, triangles, [single(generator.random()) for _ in positions]


class Gltf(ProgramTest):
    def in_two_files(self, mesh, buffer):
        """A tetrahedron: the paths of its .gltf file and of the file of its buffer."""
        writer = Writer()
        position = writer.accessor("f", 5126, "VEC3", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
        corners = writer.accessor("I", 5125, "SCALAR", [(v,) for v in (0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3)])
        writer.document["meshes"].append(
            {"primitives": [{"attributes": {"POSITION": position}, "indices": corners}]})
        writer.document["nodes"].append({"mesh": 0})
        paths = self.folder / mesh, self.folder / buffer
        writer.document["buffers"] = [{"byteLength": len(writer.binary), "uri": paths[1].name}]
        paths[0].parent.mkdir(exist_ok=True)
        paths[0].write_text(json.dumps(writer.document))
        paths[1].write_bytes(writer.binary)
        return paths

    def test_a_mesh_and_its_values_are_those_of_the_off_file(self):
        positions, triangles, values = wavy_sphere(9)
        writer = Writer()
        position = writer.accessor("f", 5126, "VEC3", positions)
        corners = writer.accessor("H", 5123, "SCALAR", [(v,) for t in triangles for v in t])
        attribute = writer.accessor("f", 5126, "SCALAR", [(value,) for value in values])
        writer.document["meshes"].append({"primitives": [
            {"attributes": {"POSITION": position, "_LOAD": attribute}, "indices": corners}]})
        writer.document["nodes"].append({"mesh": 0})
        (self.folder / "m.glb").write_bytes(writer.bytes())
        self.file("m.off", f"OFF\n{len(positions)} {len(triangles)} 0\n"
                  + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in positions)
                  + "".join("3 {} {} {}\n".format(*t) for t in triangles))
        for field in ("mean-curvature", "height:direction=1/2/3"):
            self.morsel("field", "m.glb", "--field", field, "-o", "glb.txt")
            self.morsel("field", "m.off", "--field", field, "-o", "off.txt")
            lines = [[line for line in (self.folder / name).read_text().splitlines() if line[:1] != "#"]
                     for name in ("glb.txt", "off.txt")]
            self.assertEqual(lines[0], lines[1])
        self.morsel("field", "m.glb", "--field", "vertex-scalar:property=_LOAD", "-o", "load.txt")
        read = [float(line) for line in (self.folder / "load.txt").read_text().splitlines()
                if not line.startswith("#")]
        self.assertEqual(read, values)

    def test_nodes_and_primitives(self):
        writer = Writer()
        position = writer.accessor("f", 5126, "VEC3", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
        corners = writer.accessor("I", 5125, "SCALAR",
                                  [(v,) for v in (0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3)])
        writer.document["meshes"].append(
            {"primitives": [{"attributes": {"POSITION": position}, "indices": corners},
                            {"attributes": {"POSITION": position}, "mode": 1}]})
        half = math.sqrt(0.5)
        writer.document["nodes"] = [{"children": [1, 2], "scale": [2, 2, 2]}, {"mesh": 0},
                                    {"mesh": 0, "translation": [5, 0, 0], "rotation": [0, 0, half, half]},
                                    {"mesh": 0}]
        writer.document.update(scene=0, scenes=[{"nodes": [0]}])
        (self.folder / "m.glb").write_bytes(writer.bytes())
        info = json.loads(self.morsel("info", "--json", "m.glb").stdout)
        self.assertEqual([info["mesh"][key] for key in ("vertices", "faces", "components")], [8, 8, 2])
        self.morsel("field", "m.glb", "--field", "height:axis=x", "-o", "x.txt")
        read = [float(line) for line in (self.folder / "x.txt").read_text().splitlines()
                if not line.startswith("#")]
        for value, expected in zip(read, [0, 2, 0, 0, 10, 10, 8, 10], strict=True):
            self.assertAlmostEqual(value, expected)

    def test_an_input_that_a_mesh_names_is_not_overwritten(self):
        """`field own.gltf -o own.txt` once replaced the buffer own.txt of the mesh."""
        for name, *arguments in (
                ("own.txt", "field"), ("link.txt", "field"), ("own.csv", "points"), ("own.txt", "compare"),
                ("own.csv", "sweep", "--vary", "iterations=1..2"), ("own.csv", "stability"),
                ("own.txt", "hierarchy")):
            _, buffer = self.in_two_files("own.gltf", name.replace("link", "own"))
            shutil.copy(self.folder / "own.gltf", self.folder / "own.scene")
            if name != buffer.name:
                (self.folder / name).symlink_to(buffer)
            before = buffer.read_bytes()
            for mesh in (("own.gltf",), ("own.scene", "--format", "gltf")):
                with self.subTest(arguments=arguments, name=name, mesh=mesh):
                    error = self.morsel(*arguments, *mesh, "--field", "height", "-o", name, code=2).stderr
                    self.assertIn(f"is the file that is read as a buffer of MESH {buffer.name}", error)
                    self.assertEqual(buffer.read_bytes(), before)
        self.morsel("field", "own.gltf", "--field", "height", "-o", "other.txt")

    def test_a_changed_buffer_is_a_changed_mesh(self):
        """A second `batch` once took a mesh whose buffer had changed for one of earlier runs."""
        mesh, buffer = self.in_two_files("meshes/m.gltf", "meshes/m.bin")

        def batch():
            return self.morsel("batch", "meshes", "--out", "out", "--field", "height", "--method",
                               "conventional", "--no-thumbnails").stdout

        def hashes():
            one = lambda data: hashlib.sha256(data).hexdigest()
            expected = one(f"{one(mesh.read_bytes())}\n{one(buffer.read_bytes())}\n".encode())
            info = json.loads(self.morsel("info", "--json", mesh).stdout)
            report = self.report(mesh, "--field", "height", "--method", "conventional")
            self.assertEqual([info["mesh"]["sha256"], report["mesh"]["sha256"]], [expected, expected])
            return expected

        self.assertNotIn("earlier runs", batch())
        self.assertIn("1 by earlier runs", batch())
        first = hashes()
        self.morsel("check", "report.json")
        data = bytearray(buffer.read_bytes())
        data[44:48] = struct.pack("<f", 5)
        buffer.write_bytes(data)
        self.morsel("check", "report.json", code=1)
        self.assertNotIn("earlier runs", batch())
        self.assertIn("1 by earlier runs", batch())
        self.assertNotEqual(hashes(), first)

    def test_a_missing_buffer_that_the_triangles_do_not_need(self):
        mesh, _ = self.in_two_files("m.gltf", "m.bin")
        document = json.loads(mesh.read_text())
        document["buffers"].append({"byteLength": 4, "uri": "animation.bin"})
        mesh.write_text(json.dumps(document))
        self.assertTrue(json.loads(self.morsel("info", "--json", mesh).stdout)["valid"])

    def test_refusals_are_one_sentence(self):
        for name, text, sentence in (
                ("a.gltf", "{", "its JSON cannot be read"),
                ("b.gltf", '{"asset":{"version":"2.0"}}', "it has no triangles"),
                ("c.gltf", "[1]", "its JSON is no object"),
                ("d.gltf", '{"meshes":[]}', "its JSON is no glTF 2.0")):
            self.file(name, text)
            self.assertIn(sentence, self.morsel("info", name, code=3).stderr)


if __name__ == "__main__":
    unittest.main()
