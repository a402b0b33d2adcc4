#!/usr/bin/env python3
"""bench.py [--subdivide N] [--repeats N]: what the Python package adds to the library's own time, how much
memory arrays take, and the time of the same work by gudhi and scipy, where they are installed. On the lion's
head, its edges cut into N pieces (4: 133,000 vertices).

    PYTHONPATH=build/release/python MORSEL_SAMPLES=build/samples /usr/bin/python3 tests/python/bench.py

"library" is the time between begin and end of the work within the library, "Python" that of the whole call;
the smallest of the repeats' differences counts, since other programs only add to them.
"""

import argparse
import os
import resource
import time

import numpy as np

import morsel as ms
from morsel import _library


def measured(name, call, repeats):
    """A row: seconds of the library, seconds of the call, and what the call adds."""
    added, library, whole = [], [], []
    for _ in range(repeats):
        start = time.perf_counter()
        result = call()
        whole.append(time.perf_counter() - start)
        library.append(_library.seconds_of_last_job())
        added.append(whole[-1] - library[-1])
        del result
    best = min(range(repeats), key=lambda i: added[i])
    share = 100 * added[best] / library[best]
    print(f"{name:<28} {1e3 * library[best]:10.2f} {1e3 * whole[best]:10.2f} {1e3 * added[best]:8.3f} "
          f"{share:7.2f} %")


def overheads(mesh, repeats):
    print(f"{'':<28} {'library':>10} {'Python':>10} {'added':>8} {'share':>9}   (milliseconds)")
    v, f = np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int64)
    curvature = ms.mean_curvature(mesh)
    smooth = ms.salient(curvature, iterations=10, sigma="2eps")
    values = np.array(curvature.values)
    for name, call in {
            "Mesh(V, F)": lambda: ms.Mesh(v, f),
            "field(mesh, values)": lambda: ms.field(mesh, values),
            "mean_curvature": lambda: ms.mean_curvature(mesh),
            "salient, 1 iteration": lambda: ms.salient(curvature, iterations=1, sigma="2eps"),
            "tps": lambda: ms.tps(curvature),
            "critical_points": lambda: ms.critical_points(curvature),
            "persistence": lambda: ms.persistence(curvature),
            "morse_smale": lambda: ms.morse_smale(curvature),
            "segment": lambda: ms.segment(curvature, segments=50),
            "hierarchy": lambda: ms.hierarchy(smooth),
            "compare, 2 methods": lambda: ms.compare(mesh, methods=["conventional", "tps"])}.items():
        measured(name, call, repeats)


def memory(mesh):
    """Bytes a vertex that arrays take."""
    def peak():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024

    v = np.repeat(mesh.vertices, 1, axis=0)
    before = peak()
    kept = ms.Mesh(v, mesh.faces)
    after = peak()
    print(f"\nMesh(V, F): the largest use of memory grew by {(after - before) / len(v):.0f} bytes a vertex; "
          f"positions are {v.nbytes / len(v):.0f}, triangles {mesh.faces.nbytes / len(v):.0f}")
    f = ms.field(kept, np.arange(len(v), dtype=float))
    arrays = [kept.vertices, kept.faces, f.values, f.ranks, ms.persistence(f).birth_death]
    print("views, not copies:", all(not array.flags.owndata for array in arrays))


def seconds(call, repeats=3):
    best = np.inf
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        best = min(best, time.perf_counter() - start)
    return best


def beside_gudhi(mesh):
    try:
        import gudhi
    except ImportError:
        print("gudhi is not installed")
        return
    f = ms.mean_curvature(mesh)
    values, faces = f.values, mesh.faces

    def lower_star():
        tree = gudhi.SimplexTree()
        for i, value in enumerate(values.tolist()):
            tree.insert([i], value)
        for triangle in faces.tolist():
            tree.insert(triangle, -np.inf)
        for simplex, _ in tree.get_filtration():
            tree.assign_filtration(simplex, max(values[vertex] for vertex in simplex))
        tree.compute_persistence(persistence_dim_max=True)
        return tree

    tree = lower_star()
    pairs = np.concatenate([tree.persistence_intervals_in_dimension(d) for d in (0, 1)])
    theirs = np.sort((pairs[:, 1] - pairs[:, 0])[np.isfinite(pairs[:, 1])])
    print(f"persistence: morsel {seconds(lambda: ms.persistence(f)):.4f} s, gudhi {gudhi.__version__} "
          f"{seconds(lower_star, 1):.2f} s ({len(ms.persistence(f))} pairs, of gudhi "
          f"{np.count_nonzero(theirs > 0)})")


def beside_scipy(mesh):
    try:
        import scipy
        from scipy.sparse import coo_matrix, diags
        from scipy.sparse.linalg import eigsh
        from scipy.spatial import cKDTree
    except ImportError:
        print("scipy is not installed")
        return
    f = ms.mean_curvature(mesh)
    sigma = mesh.length("2eps")
    v = mesh.vertices

    def gaussian():
        distances = cKDTree(v).sparse_distance_matrix(cKDTree(v), 2 * sigma, output_type="coo_matrix")
        weights = coo_matrix((np.exp(-distances.data**2 / (2 * sigma**2)), (distances.row, distances.col)),
                             distances.shape).tocsr()
        weights = weights + diags(1.0 - weights.diagonal())
        return weights @ f.values / np.asarray(weights.sum(axis=1)).ravel()

    ours = ms.gaussian(f, sigma="2eps").values
    print(f"gaussian: morsel {seconds(lambda: ms.gaussian(f, sigma='2eps')):.3f} s, "
          f"scipy {scipy.__version__} {seconds(gaussian, 1):.3f} s (largest difference "
          f"{np.abs(ours - gaussian()).max():.1e})")

    a, b, c = (v[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    rows, columns, entries = [], [], []
    for i, (p, q, r) in enumerate(((a, b, c), (b, c, a), (c, a, b))):
        cotangent = ((q - p) * (r - p)).sum(axis=1) / (2 * area) / 2
        j, k = mesh.faces[:, (i + 1) % 3], mesh.faces[:, (i + 2) % 3]
        for x, y, sign in ((j, k, -1), (k, j, -1), (j, j, 1), (k, k, 1)):
            rows.append(x)
            columns.append(y)
            entries.append(sign * cotangent)
    n = len(v)
    places = (np.concatenate(rows), np.concatenate(columns))
    laplacian = coo_matrix((np.concatenate(entries), places), (n, n)).tocsc()
    mass = diags(np.bincount(mesh.faces.ravel(), np.repeat(area / 3, 3), n)).tocsc()

    def eigenfunctions():
        return eigsh(laplacian, 8, mass, sigma=-1e-2, which="LM")

    print(f"eigenfunction 7: morsel {seconds(lambda: ms.eigenfunction(mesh, index=7), 1):.2f} s, scipy "
          f"{seconds(eigenfunctions, 1):.2f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--subdivide", type=int, default=4)
    parser.add_argument("--repeats", type=int, default=7)
    options = parser.parse_args()
    lion = ms.read(os.path.join(os.environ["MORSEL_SAMPLES"], "lion-head.off"))
    mesh = lion.subdivided(options.subdivide) if options.subdivide > 1 else lion
    print(f"{mesh.vertex_count:,} vertices, {ms.thread_count()} threads\n")
    memory(mesh)
    print()
    overheads(mesh, options.repeats)
    print(f"\nbeside others, on {lion.vertex_count:,} vertices")
    beside_gudhi(lion)
    beside_scipy(lion)


if __name__ == "__main__":
    main()
