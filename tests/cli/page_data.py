"""Reads back what a page of compare --html holds, as tools/html/ describes it."""

import base64
import html.parser
import json
import math
import struct
import zlib


class Elements(html.parser.HTMLParser):
    """The elements of a document, and the text of those with an id, as a browser parses it."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.tags = []
        self.links = []
        self.texts = {}
        self.open_id = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.tags.append(tag)
        names = ("src", "href", "action", "data", "poster", "srcset")
        self.links += [attributes[name] for name in names if name in attributes]
        self.open_id = attributes.get("id") if tag == "script" else None

    def handle_data(self, data):
        if self.open_id:
            self.texts[self.open_id] = self.texts.get(self.open_id, "") + data

    def handle_endtag(self, tag):
        if tag == "script":
            self.open_id = None


def unpack(text):
    return zlib.decompress(base64.b64decode(text, validate=True))


def numbers(buffers, reference):
    data = buffers[reference["offset"]:reference["offset"] + reference["bytes"]]
    assert len(data) == reference["bytes"]
    if reference["type"] != "delta":
        letter = {"u8": "B", "u16": "H", "f64": "d"}[reference["type"]]
        return list(struct.unpack(f"<{reference['count']}{letter}", data))
    values, value, at = [], 0, 0
    for _ in range(reference["count"]):
        code, shift = 0, 0
        while True:
            byte = data[at]
            at += 1
            code |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        value += code // 2 if code % 2 == 0 else -(code + 1) // 2
        values.append(value)
    assert at == len(data)
    return values


def resolved(buffers, node):
    if isinstance(node, dict):
        if "offset" in node:
            return numbers(buffers, node)
        return {key: resolved(buffers, value) for key, value in node.items()}
    return [resolved(buffers, value) for value in node] if isinstance(node, list) else node


class PageData:
    def __init__(self, path):
        self.text = path.read_text(encoding="utf-8")
        self.elements = Elements(self.text)
        self.meta = json.loads(self.elements.texts["page"])
        buffers = unpack(self.elements.texts["buffers"])
        assert len(buffers) == self.meta["buffers_bytes"]
        self.three = unpack(self.elements.texts["three"]).decode()
        self.mesh = resolved(buffers, self.meta["mesh"])
        self.methods = resolved(buffers, self.meta["methods"])

    def position(self, v):
        n = self.mesh["vertices"]
        return [self.mesh["origin"][c] + self.mesh["step"] * self.mesh["positions"][c * n + v]
                for c in range(3)]

    def persistence(self, method):
        """Of each point: an extremum's is its pair's, a saddle's the largest of its pairs', infinite if one
        is left."""
        points = method["points"]
        count = len(points["vertex"])
        result, left = [0.0] * count, list(points["multiplicity"])
        for extremum, saddle in zip(method["pairs"]["extremum"], method["pairs"]["saddle"]):
            is_cap = extremum >= count
            value = math.inf if is_cap else abs(points["value"][extremum] - points["value"][saddle])
            for i in [saddle] if is_cap else [saddle, extremum]:
                result[i] = max(result[i], value)
                left[i] -= 1
        return [math.inf if left[i] > 0 else result[i] for i in range(count)]

    def pieces(self, method, kind):
        """The straight pieces of the arcs of one kind, as pairs of positions."""
        paths, points = method["arcs"][kind], method["points"]
        corners = [self.mesh["corners"][3 * t:3 * t + 3] for t in range(self.mesh["triangles"])]

        def mean(*vertices):
            places = [self.position(v) for v in vertices]
            return [sum(p[c] for p in places) / len(places) for c in range(3)]

        def side(t, i):
            return mean(corners[t][i], corners[t][(i + 1) % 3])

        first = 0
        for saddle, length, end in zip(paths["saddle"], paths["length"], paths["end"]):
            cells = paths["cells"][first:first + length]
            first += length
            if kind == "descending":
                line = [self.position(v) for v in cells]
            else:
                line = [self.position(points["vertex"][saddle])]
                if end >= 7:
                    line.append(side(cells[0], end - 7))
                else:
                    for before, t in zip([None, *cells], cells):
                        if before is not None:
                            shared = [v for v in corners[t] if v in corners[before]]
                            assert len(shared) == 2
                            line.append(mean(*shared))
                        line.append(mean(*corners[t]))
                    if end >= 4:
                        line.append(side(cells[-1], end - 4))
                    elif end >= 1:
                        line.append(self.position(corners[cells[-1]][end - 1]))
            yield from zip(line, line[1:])
        assert first == len(paths["cells"])
