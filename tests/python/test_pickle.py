"""Copies and pickles: for joblib, processes and dask."""

import concurrent.futures
import copy
import multiprocessing
import pickle

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V

import morsel as ms


def test_what_never_changes_is_its_own_copy(small):
    f = ms.mean_curvature(small)
    h = ms.hierarchy(f)
    r = ms.compare(f, methods=["conventional"])
    for one in (small, f, ms.critical_points(f), ms.persistence(f), ms.morse_smale(f), ms.segment(f), h,
                h.levels(), h.levels()[0], ms.points(f, 5), ms.cut(f), r, r[0]):
        assert copy.copy(one) is one and copy.deepcopy([one])[0] is one


def test_meshes(lion, tmp_path):
    damaged = ms.Mesh(np.concatenate([[[9, 9, 9]], OCTAHEDRON_V]), OCTAHEDRON_F + 1, repair=True)
    f = ms.field(damaged, np.arange(6))
    damaged.save(tmp_path / "m.ply", properties={"q": f.values})
    for mesh in (lion, damaged, ms.read(tmp_path / "m.ply")):
        again = pickle.loads(pickle.dumps(mesh))
        assert np.array_equal(again.vertices, mesh.vertices) and np.array_equal(again.faces, mesh.faces)
        assert again.vertices.dtype == np.float64 and not again.vertices.flags.writeable
        assert np.array_equal(again.input_vertices, mesh.input_vertices)
        assert (again.path, again.repairs, again._data.input_count) == (
            mesh.path, mesh.repairs, mesh._data.input_count)
        assert all(np.array_equal(again.properties[name], of) for name, of in mesh.properties.items())
        assert list(again.properties) == list(mesh.properties) and again != mesh
    ms.compare(pickle.loads(pickle.dumps(lion)), methods=["conventional"]).save(tmp_path / "r.json")
    assert ms.check(tmp_path / "r.json") == []


def test_fields(smooth, tmp_path):
    again = pickle.loads(pickle.dumps(smooth))
    assert np.array_equal(again.values, smooth.values) and np.array_equal(again.ranks, smooth.ranks)
    assert (again.function, again.method, again.parameters) == (
        smooth.function, smooth.method, smooth.parameters)
    for one, other in zip(again.steps, smooth.steps):
        assert one[:3] == other[:3] and one[4:] == other[4:]
    assert np.array_equal(again.input.values, smooth.input.values)
    assert np.array_equal(ms.tps(again, count=50).ranks, ms.tps(smooth, count=50).ranks)
    for f, name in ((again, "again"), (smooth, "first")):
        f.save(tmp_path / f"{name}.txt")
    assert (tmp_path / "again.txt").read_bytes() == (tmp_path / "first.txt").read_bytes()
    counted = ms.salient(smooth, iterations=2, count_iterations=True)
    assert np.array_equal(pickle.loads(pickle.dumps(counted)).steps[-1].iterations,
                          counted.steps[-1].iterations)


@pytest.mark.parametrize("change", [lambda f: -f, lambda f: ms.salient(f, target=50),
                                    lambda f: ms.tps(f, threshold="5%"), lambda f: f.input,
                                    lambda f: ms.field(f.mesh, f.values, name="mine")])
def test_order_of_fields(smooth, change):
    f = change(smooth)
    again = pickle.loads(pickle.dumps(f))
    assert np.array_equal(again.values, f.values) and np.array_equal(again.ranks, f.ranks)


def test_one_mesh_of_several_fields(smooth):
    f, p, mesh = pickle.loads(pickle.dumps((smooth, ms.critical_points(smooth), smooth.mesh)))
    assert f.mesh == p.field.mesh == mesh and p.field is f
    assert np.array_equal(p.array, ms.critical_points(smooth).array) and not p.array.flags.writeable
    assert np.array_equal(p.persistence, ms.critical_points(smooth).persistence)
    with pytest.raises(AttributeError):
        p.origin
    row = ms.compare(smooth, methods=["tps:count=50"])[0]
    assert np.array_equal(pickle.loads(pickle.dumps(row.critical_points)).origin, row.critical_points.origin)


def test_processes(smooth):
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        p = pool.submit(ms.critical_points, smooth).result(300)
    assert p.counts == ms.critical_points(smooth).counts
