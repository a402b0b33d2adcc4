"""A reader of PNG files written from the specification, so that what the program writes is read by other
code."""

import struct
import zlib

CHANNELS = {0: 1, 2: 3, 6: 4}


def without_texts(data):
    """The same picture without what its texts say, such as paths of the machine that drew it."""
    kept, at = data[:8], 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind not in (b"tEXt", b"zTXt", b"iTXt"):
            kept += data[at:at + 12 + size]
        at += 12 + size
    return kept


class Png:
    """8-bit pictures without interlacing: `width`, `height`, `channels`, and pixel(x, y)."""

    def __init__(self, data):
        assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG file"
        at, packed, ended = 8, b"", False
        while at < len(data):
            size, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + size]
            assert struct.unpack(">I",
                                 data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body), "checksum"
            if kind == b"IHDR":
                self.width, self.height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
                assert depth == 8 and not interlaced
                self.channels = CHANNELS[color]
            elif kind == b"IDAT":
                packed += body
            ended = kind == b"IEND"
            at += 12 + size
        assert ended, "cut off"
        self.rows = self._unfilter(zlib.decompress(packed))

    def _unfilter(self, raw):
        step, stride = self.channels, self.width * self.channels
        assert len(raw) == self.height * (stride + 1)
        above, rows = bytearray(stride), []
        for y in range(self.height):
            kind = raw[y * (stride + 1)]
            row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            for i in range(stride):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                if kind == 1:
                    row[i] = (row[i] + left) & 255
                elif kind == 2:
                    row[i] = (row[i] + above[i]) & 255
                elif kind == 3:
                    row[i] = (row[i] + (left + above[i]) // 2) & 255
                elif kind == 4:
                    p = left + above[i] - corner
                    near = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]),
                               (abs(p - corner), 2, corner))
                    row[i] = (row[i] + near[2]) & 255
            rows.append(row)
            above = row
        return rows

    def pixel(self, x, y):
        return tuple(self.rows[y][x * self.channels:(x + 1) * self.channels])

    def pixels(self):
        for row in self.rows:
            for x in range(0, len(row), self.channels):
                yield tuple(row[x:x + self.channels])
