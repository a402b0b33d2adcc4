"""A reader of GLB files, written from the specification (Khronos, glTF 2.0), that checks what it asks for."""

import json
import math
import struct

import numpy as np

COMPONENTS = {5121: np.dtype("<u1"), 5123: np.dtype("<u2"), 5125: np.dtype("<u4"), 5126: np.dtype("<f4")}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def chunks(path):
    """The JSON document and the bytes of the buffer."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data)), path
    found, at = [], 12
    while at < len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        assert size % 4 == 0, "chunks end at multiples of 4 bytes"
        found.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    assert at == len(data) and [kind for kind, _ in found] == [b"JSON", b"BIN\0"]
    return json.loads(found[0][1].decode()), found[1][1]


def accessor(document, buffer, number):
    """The elements, one a row, after what the specification says of them."""
    a = document["accessors"][number]
    view = document["bufferViews"][a["bufferView"]]
    kind, width = COMPONENTS[a["componentType"]], WIDTHS[a["type"]]
    assert a["count"] >= 1 and "byteOffset" not in a and "byteStride" not in view
    assert view["buffer"] == 0 and view["byteOffset"] % 4 == 0
    assert view["byteLength"] == a["count"] * kind.itemsize * width
    assert view["byteOffset"] + view["byteLength"] <= len(buffer)
    assert view["target"] == (34963 if a["type"] == "SCALAR" else 34962)
    values = np.frombuffer(buffer, kind, a["count"] * width, view["byteOffset"]).reshape(-1, width)
    if "min" in a:
        assert a["min"] == values.min(axis=0).tolist() and a["max"] == values.max(axis=0).tolist()
    return values


def read_glb(path):
    """(parts by name, asset): of each part its positions where the scene has them, normals, colours in linear
    light (of vertices, or one for all) and triangles."""
    document, buffer = chunks(path)
    assert document["asset"]["version"] == "2.0" and len(document["buffers"]) == 1
    assert 0 <= len(buffer) - document["buffers"][0]["byteLength"] < 4 and "uri" not in document["buffers"][0]
    assert document["scene"] == 0 and document["scenes"] == [{"nodes": [0]}]
    root, *nodes = document["nodes"]
    assert root["children"] == list(range(1, len(nodes) + 1))
    parts = {}
    for node in nodes:
        mesh = document["meshes"][node["mesh"]]
        primitive, = mesh["primitives"]
        attributes = primitive["attributes"]
        material = document["materials"][primitive["material"]]
        assert material["doubleSided"] and primitive.get("mode", 4) == 4
        positions = accessor(document, buffer, attributes["POSITION"])
        assert "min" in document["accessors"][attributes["POSITION"]]
        normals = accessor(document, buffer, attributes["NORMAL"])
        assert np.all(np.abs(np.linalg.norm(normals, axis=1) - 1) < 1e-5)
        indices = accessor(document, buffer, primitive["indices"]).ravel()
        assert len(indices) % 3 == 0 and indices.max() < len(positions)
        assert len(positions) == len(normals) and np.all(np.isfinite(positions))
        factor = material["pbrMetallicRoughness"]["baseColorFactor"]
        colors = np.array(factor[:3])
        assert factor[3] == 1 and all(0 <= x <= 1 for x in factor)
        if "COLOR_0" in attributes:
            assert document["accessors"][attributes["COLOR_0"]]["normalized"] and factor == [1, 1, 1, 1]
            raw = accessor(document, buffer, attributes["COLOR_0"])
            assert len(raw) == len(positions) and np.all(raw[:, 3] == 65535)
            colors = raw[:, :3] / 65535
        moved = positions.astype(float) * root.get("scale", [1, 1, 1]) + root.get("translation", [0, 0, 0])
        assert node["name"] not in parts
        parts[node["name"]] = {"positions": moved, "normals": normals, "colors": colors,
                               "triangles": indices.reshape(-1, 3)}
    return parts, document["asset"]


def to_srgb(linear):
    """Bytes as files with colours of 8 bits have them."""
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
    return np.floor(255 * encoded + 0.5).astype(int)


def balls_of(part, count):
    """The centres and radii of so many spheres that a part is made of."""
    positions = part["positions"].reshape(count, -1, 3)
    centers = positions.mean(axis=1)
    radii = np.linalg.norm(positions - centers[:, None], axis=2)
    assert math.isclose(radii.min(), radii.max(), rel_tol=1e-3)
    return centers, radii.mean(axis=1)
