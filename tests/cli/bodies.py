"""Bodies whose tips are known: balls with bumps, of which the vertices at the bumps are marked.

    bodies.py FOLDER

writes the 24 bodies that docs/landmarks.md measures, with their marks and their list, list.txt."""

import math
import pathlib
import random
import sys


def normalized(p):
    length = math.sqrt(sum(x * x for x in p))
    return tuple(x / length for x in p)


def ball(rounds):
    """A sphere of radius 1: an octahedron whose triangles are cut in four, `rounds` times."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(rounds):
        middle, finer = {}, []

        def between(a, b, middle=middle):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(normalized([x + y for x, y in zip(points[a], points[b])]))
            return middle[key]

        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return points, triangles


def turned(p, angle):
    """About the x axis, then about the z axis."""
    x, y, z = p
    y, z = y * math.cos(angle) - z * math.sin(angle), y * math.sin(angle) + z * math.cos(angle)
    return (x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle), z)


def nearest(points, places):
    return [min(range(len(points)), key=lambda v, place=place: math.dist(points[v], place))
            for place in places]


def off(points, triangles):
    return (f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join("%.17g %.17g %.17g\n" % p for p in points)
            + "".join("3 %d %d %d\n" % t for t in triangles))


class Shape:
    """A surface that is seen whole from its middle: bumps of several heights and widths at least `apart` from
    one another, and waves that are lower."""

    def __init__(self, seed, apart=0.6):
        draw = random.Random(seed)
        self.bumps = []
        wanted = draw.randint(5, 14)
        while len(self.bumps) < wanted:
            place = normalized([draw.gauss(0, 1) for _ in range(3)])
            if all(math.dist(place, other) > apart for other, _, _ in self.bumps):
                self.bumps.append((place, draw.uniform(0.25, 0.6), draw.uniform(0.02, 0.06)))
        self.waves = [([draw.gauss(0, 4) for _ in range(3)], draw.uniform(0, 2 * math.pi)) for _ in range(3)]

    def tips(self):
        return [place for place, _, _ in self.bumps]

    def at(self, direction):
        radius = 1 + sum(height * math.exp(-math.dist(direction, place) ** 2 / width)
                         for place, height, width in self.bumps)
        radius += sum(0.03 * math.sin(sum(a * b for a, b in zip(wave, direction)) + phase)
                      for wave, phase in self.waves)
        return tuple(radius * x for x in direction)


def noisy(points, triangles, amount, seed):
    """Each vertex moved by Gaussian noise, its deviation in mean edge lengths."""
    draw = random.Random(seed)
    edges = {(min(a, b), max(a, b)) for t in triangles for a, b in zip(t, t[1:] + t[:1])}
    mean = sum(math.dist(points[a], points[b]) for a, b in edges) / len(edges)
    return [tuple(x + draw.gauss(0, amount * mean) for x in p) for p in points]


def variants(seed):
    """One shape as it is, moved, with noise, and with a quarter of the vertices at other places."""
    shape = Shape(seed)
    directions, triangles = ball(5)
    marks = nearest(directions, shape.tips())
    points = [shape.at(p) for p in directions]
    yield "plain", points, triangles, marks
    yield "moved", [tuple(3 * x + 7 for x in turned(p, 0.7)) for p in points], triangles, marks
    yield "noisy", noisy(points, triangles, 0.15, seed), triangles, marks
    directions, triangles = ball(4)
    directions = [turned(p, 1.1) for p in directions]
    yield "other", [shape.at(p) for p in directions], triangles, nearest(directions, shape.tips())


def main(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    names = []
    for seed in range(6):
        for kind, points, triangles, marks in variants(seed):
            names.append(f"{seed}-{kind}")
            (folder / f"{names[-1]}.off").write_text(off(points, triangles))
            (folder / f"{names[-1]}.vts").write_text("".join(f"{v}\n" for v in marks))
    (folder / "list.txt").write_text("".join(f"{name}.off {name}.vts\n" for name in names))


if __name__ == "__main__":
    main(sys.argv[1])
