"""A made cortex: a sphere of 50 mm with folds, which are a seeded sum of smooth waves."""

import numpy as np


def icosphere(levels):
    """Vertices and faces of an icosahedron, each face cut into four so many times, on the unit sphere."""
    g = (1 + 5 ** 0.5) / 2
    points = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
                       (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)], float)
    faces = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
                      (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
                      (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])
    for _ in range(levels):
        sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        edges, number = np.unique(sides, axis=0, return_inverse=True)
        middle = len(points) + number.reshape(3, -1)
        points = np.concatenate([points, points[edges].mean(axis=1)])
        a, b, c = faces.T
        ab, bc, ca = middle
        faces = np.concatenate([np.stack(corners, 1) for corners in
                                ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return points / np.linalg.norm(points, axis=1, keepdims=True), faces


def cortex(levels, seed=1, waves=60, noise=0):
    """Vertices in mm and faces of a folded sphere, and sulc: as FreeSurfer's positive in sulci;
    `noise` is the standard deviation of what is added to it at each vertex."""
    random = np.random.default_rng(seed)
    sphere, faces = icosphere(levels)
    depth = np.zeros(len(sphere))
    for _ in range(waves):
        direction = random.normal(size=3)
        direction *= random.uniform(10, 24) / np.linalg.norm(direction)
        depth += np.cos(sphere @ direction + random.uniform(0, 2 * np.pi))
    depth /= depth.std()
    sulc = (5 * depth + random.normal(scale=noise, size=len(depth))).astype(np.float32)
    return (sphere * (50 - 2.5 * depth)[:, None]).astype(np.float32), faces.astype(np.int32), sulc


def maxima(faces, values):
    """The vertices that are higher than all their neighbours, of equal ones the later."""
    rank = np.empty(len(values), int)
    rank[np.lexsort((np.arange(len(values)), values))] = np.arange(len(values))
    highest = np.full(len(values), -1)
    for i in range(3):
        for j in range(3):
            if i != j:
                np.maximum.at(highest, faces[:, i], rank[faces[:, j]])
    return np.flatnonzero(rank > highest)
