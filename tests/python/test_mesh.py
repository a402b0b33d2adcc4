"""Meshes from arrays and files, and what is refused."""

import json
import pickle

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V, sample

import morsel as ms


def test_counts_and_views(octahedron):
    assert (octahedron.vertex_count, octahedron.edge_count, octahedron.face_count) == (6, 12, 8)
    assert (octahedron.genus, octahedron.euler_characteristic, octahedron.component_count) == (0, 2, 1)
    assert octahedron.is_closed and octahedron.boundary_loops == []
    assert np.array_equal(octahedron.vertices, OCTAHEDRON_V) and octahedron.vertices.dtype == np.float64
    assert np.array_equal(octahedron.faces, OCTAHEDRON_F) and octahedron.faces.dtype == np.uint32
    assert octahedron.V is not None and np.shares_memory(octahedron.V, octahedron.vertices)
    assert np.array_equal(octahedron.F, octahedron.faces)
    assert octahedron.edges.shape == (12, 2) and octahedron.edges[0].tolist() == [0, 2]
    assert octahedron.diagonal == pytest.approx(np.sqrt(12))
    assert octahedron.epsilon == 0.003 * octahedron.diagonal
    assert octahedron.path == "" and octahedron.properties == {} and octahedron.repairs == {}
    with pytest.raises(ValueError):
        octahedron.vertices[0, 0] = 7


def test_areas_normals_and_the_box(octahedron, lion):
    assert octahedron.bounding_box.tolist() == [[-1, -1, -1], [1, 1, 1]]
    assert octahedron.face_areas == pytest.approx(np.full(8, np.sqrt(3) / 2))
    assert octahedron.vertex_normals == pytest.approx(OCTAHEDRON_V)
    inside_out = ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F[:, ::-1])
    assert inside_out.vertex_normals == pytest.approx(OCTAHEDRON_V)
    assert lion.face_areas.sum() == pytest.approx(lion.length("1rootarea")**2)
    assert np.linalg.norm(lion.vertex_normals, axis=1) == pytest.approx(np.ones(lion.vertex_count))
    assert not lion.vertex_normals.flags.writeable


def test_properties_of_the_input(tmp_path):
    v = np.concatenate([[[9, 9, 9]], OCTAHEDRON_V])
    mesh = ms.Mesh(v, OCTAHEDRON_F + 1, repair=True)
    mesh.save(tmp_path / "mesh.ply", properties={"own": np.arange(6), "input": np.arange(7)})
    read = ms.read(tmp_path / "mesh.ply").properties
    assert read["own"].tolist() == [0, 1, 2, 3, 4, 5] and read["input"].tolist() == [1, 2, 3, 4, 5, 6]
    with pytest.raises(ValueError, match="8 values"):
        mesh.save(tmp_path / "other.ply", properties={"wrong": np.arange(8)})


@pytest.mark.parametrize("of", [np.float32, np.float64, np.int32, np.uint8, np.int8, ">f8", np.float16])
def test_any_real_positions(of):
    given = (OCTAHEDRON_V + 1).astype(of)
    assert np.array_equal(ms.Mesh(given, OCTAHEDRON_F).vertices, OCTAHEDRON_V + 1)


@pytest.mark.parametrize("of",
                         [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64,
                                ">i4", ">u8"])
def test_any_whole_faces(of):
    assert np.array_equal(ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F.astype(of)).faces, OCTAHEDRON_F)


def test_edges_are_sorted(lion, small):
    for mesh in (lion, small):
        edges = mesh.edges
        assert (edges[:, 0] < edges[:, 1]).all()
        assert np.array_equal(np.lexsort(edges.T[::-1]), np.arange(mesh.edge_count))
        corners = np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        assert np.array_equal(np.unique(corners, axis=0), edges)


def test_progress_of_triangles(lion):
    seen = []
    ms.Mesh(lion.vertices, lion.faces, progress=lambda step, share: seen.append((step, share)))
    assert ("building the mesh", 1) in seen
    with pytest.raises(ms.Cancelled):
        ms.Mesh(lion.vertices, lion.faces, progress=lambda *_: False)


def test_any_layout():
    for v, f in ((np.asfortranarray(OCTAHEDRON_V), np.asfortranarray(OCTAHEDRON_F)),
                 (OCTAHEDRON_V.tolist(), OCTAHEDRON_F.tolist()),
                 (np.repeat(OCTAHEDRON_V, 2, axis=0)[::2], np.repeat(OCTAHEDRON_F, 3, axis=1)[:, ::3]),
                 (OCTAHEDRON_V[::-1][::-1], OCTAHEDRON_F.T.copy().T)):
        mesh = ms.Mesh(v, f)
        assert np.array_equal(mesh.vertices, OCTAHEDRON_V) and np.array_equal(mesh.faces, OCTAHEDRON_F)


def test_input_is_copied():
    v, f = OCTAHEDRON_V.copy(), OCTAHEDRON_F.copy()
    mesh = ms.Mesh(v, f)
    v[:] = 0
    f[:] = 0
    assert np.array_equal(mesh.vertices, OCTAHEDRON_V) and np.array_equal(mesh.faces, OCTAHEDRON_F)


V, F = OCTAHEDRON_V, OCTAHEDRON_F


@pytest.mark.parametrize("v, f, says", [
    (V, F.astype(float), "whole numbers"),
    (V, F == 1, "whole numbers"),
    (V, F.astype(complex), "whole numbers"),
    (V, F.astype(str), "whole numbers"),
    (V, F - 1, "not -1"),
    (V, np.where(F == 5, 2**32 - 1, F), "not 4294967295"),
    (V, np.where(F == 5, 2**63 - 1, F), "not 9223372036854775807"),
    (V, F[:2].T, "transpose"),
    (V, F.T, "degenerate"),
    (V, F[:, :2], "shape"),
    (V, F[0], "shape"),
    (V, 3, "shape"),
    (V, F[None], "shape"),
    (V.T[:, :5], F, "transpose"),
    (V[:, :2], F, "(n, 3)"),
    (V[0], F, "(n, 3)"),
    (V.astype(complex), F, "real numbers"),
    (V.astype(str), F, "real numbers"),
    (V > 0, F, "real numbers"),
    (V.astype(object), F, "Python objects"),
    (np.ma.masked_array(V), F, "masked"),
    (V, np.ma.masked_array(F), "masked"),
    (None, F, "Python objects"),
    ("abc", F, ""),
    ([[0, 0, 1], [0, 0]], F, ""),
    (V, [[0, 1, 2], [0, "x", 3]], ""),
])
def test_odd_arrays_are_value_errors(v, f, says):
    with pytest.raises(ValueError) as caught:
        ms.Mesh(v, f)
    assert says in str(caught.value)


@pytest.mark.parametrize("v, f, kinds", [
    (V, np.where(F == 5, 6, F), ["index_out_of_range", "unreferenced_vertex"]),
    (np.where(V == -1, np.nan, V), F, ["non_finite_position"]),
    (np.where(V == -1, np.inf, V), F, ["non_finite_position"]),
    (V, np.concatenate([F, F[:1]]), ["duplicate_face"]),
    (V, np.concatenate([F, [[0, 0, 1]]]), ["degenerate_face"]),
    (V, F[:, ::-1][:1].tolist() + F[1:].tolist(), ["inconsistent_orientation"]),
    (np.concatenate([V, V[:1]]), F, ["unreferenced_vertex"]),
    (V, F[:0], ["empty", "unreferenced_vertex"]),
    (V, [], ["empty", "unreferenced_vertex"]),
    (np.empty((0, 3)), np.empty((0, 3), int), ["empty"]),
])
def test_defects_are_listed(v, f, kinds):
    with pytest.raises(ms.MeshError) as caught:
        ms.Mesh(v, f)
    assert [defect.kind for defect in caught.value.defects] == kinds
    assert all(defect.count >= 1 or defect.kind == "empty" for defect in caught.value.defects)
    assert isinstance(caught.value, (ms.InputError, ms.Error)) and isinstance(caught.value, ValueError)
    assert [defect.kind for defect in ms.defects(v, f)] == kinds


def test_no_defects():
    assert ms.defects(V, F) == []


def test_repair():
    v = np.concatenate([V, [[9, 9, 9]]])
    mesh = ms.Mesh(v, np.concatenate([F, F[:1], [[0, 0, 1]]]), repair=True)
    assert mesh.repairs == {"removed_degenerate_faces": 1, "removed_duplicate_faces": 1,
                            "removed_unreferenced_vertices": 1}
    assert (mesh.vertex_count, mesh.face_count) == (6, 8)
    assert mesh.input_vertices.tolist() == list(range(6))
    moved = ms.Mesh(np.concatenate([[[9, 9, 9]], V]), F + 1, repair=True)
    assert moved.input_vertices.tolist() == list(range(1, 7))


def test_vertices_that_coincide():
    loose, faces = V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)
    with pytest.warns(ms.MorselWarning, match="18 of 24 vertices coincide"):
        apart = ms.Mesh(loose, faces)
    assert len(apart.components) > 1 or apart.boundary_loop_count == 8
    assert len(apart.warnings) == 1
    for weld in (True, 0, "0.1eps", 1e-6):
        mesh = ms.Mesh(loose, faces, weld=weld)
        assert (mesh.vertex_count, mesh.is_closed, mesh.warnings) == (6, True, [])
        assert mesh.repairs == {"welded_vertices": 18}
    assert np.array_equal(mesh.vertices, loose[mesh.input_vertices])
    for wrong in (-1, "-1eps", "far"):
        with pytest.raises(ms.ArgumentError):
            ms.Mesh(loose, faces, weld=wrong)


def test_a_welded_file(tmp_path):
    loose, faces = V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)
    with pytest.warns(ms.MorselWarning, match="coincide"):
        ms.Mesh(loose, faces).save(tmp_path / "loose.off")
    with pytest.warns(ms.MorselWarning, match="coincide") as caught:
        ms.read(tmp_path / "loose.off")
    assert caught[0].filename == __file__
    mesh = ms.read(tmp_path / "loose.off", weld=True)
    again = pickle.loads(pickle.dumps(mesh))
    for one in (mesh, again):
        report = tmp_path / "report.json"
        ms.compare(ms.height(one), methods=["conventional"]).save(report)
        assert json.loads(report.read_text())["request"]["weld"] == "0"
        assert ms.check(report) == []


def test_polygons():
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0]]
    mixed = ms.Mesh(square, [[0, 1, 2, 3], [1, 4, 2]])
    assert mixed.face_count == 3 and mixed.boundary_loop_count == 1
    assert mixed.boundary_loops[0].tolist() == [0, 1, 4, 2, 3]
    cube = ms.Mesh(np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).T.reshape(-1, 3),
                   np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                             [1, 3, 7, 5]]),
                   repair=True)
    assert cube.face_count == 12 and cube.is_closed and cube.genus == 0


def test_reading(tmp_path):
    mesh = ms.read(sample("lion-head.off"))
    assert (mesh.vertex_count, mesh.euler_characteristic, mesh.boundary_loop_count) == (8356, 1, 1)
    assert mesh.path == sample("lion-head.off") and "lion-head" in repr(mesh)
    assert ms.Mesh(sample("lion-head.off")).vertex_count == 8356
    for missing in ("none.off", tmp_path, tmp_path / "x.xyz"):
        with pytest.raises(ms.InputError):
            ms.read(missing)
    with pytest.raises(ValueError):
        ms.read("a\0b.off")
    (tmp_path / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n")
    with pytest.raises(ms.InputError, match="bad.off"):
        ms.read(tmp_path / "bad.off")
    (tmp_path / "twice.off").write_text("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n")
    with pytest.raises(ms.MeshError) as caught:
        ms.read(tmp_path / "twice.off")
    assert caught.value.defects[0].kind == "duplicate_face" and caught.value.defects[0].first == [1]
    assert "twice.off" in str(caught.value)


def test_saving(tmp_path, octahedron):
    shifted = octahedron.with_vertices(octahedron.vertices / 3 + 0.1)
    for name in ("a.off", "b.ply"):
        shifted.save(tmp_path / name)
        again = ms.read(tmp_path / name)
        assert np.array_equal(again.vertices, shifted.vertices) and np.array_equal(again.faces, shifted.faces)
    shifted.save(tmp_path / "c.ply", properties={"height": shifted.vertices[:, 2]})
    assert np.array_equal(ms.read(tmp_path / "c.ply").properties["height"], shifted.vertices[:, 2])
    with pytest.raises(ms.ArgumentError):
        shifted.save(tmp_path / "d.off", properties={"height": shifted.vertices[:, 2]})
    with pytest.raises(ms.ArgumentError):
        shifted.save(tmp_path / "d.xyz")
    with pytest.raises(ms.ArgumentError):
        shifted.save(tmp_path / "d.ply", properties={"x": shifted.vertices[:, 2]})
    with pytest.raises(ms.WriteError) as caught:
        shifted.save("/proc/none/e.off")
    assert isinstance(caught.value, OSError)
    assert not (tmp_path / "d.off").exists()


def test_lengths_and_parts(octahedron, small):
    assert octahedron.length("8eps") == 8 * octahedron.epsilon
    assert octahedron.length("5%") == pytest.approx(0.05 * octahedron.diagonal)
    assert octahedron.length("1edges") == pytest.approx(np.sqrt(2))
    assert octahedron.length(0.25) == 0.25
    with pytest.raises(ms.ArgumentError):
        octahedron.length("8 miles")
    fine = octahedron.subdivided(3)
    assert (fine.face_count, fine.genus) == (72, 0)
    assert np.array_equal(fine.vertices[:6], octahedron.vertices)
    assert small.components.max() + 1 == small.component_count
    with pytest.raises(ValueError):
        octahedron.with_vertices(octahedron.vertices[:5])
    with pytest.raises(ValueError):
        octahedron.with_vertices(np.full((6, 3), np.nan))


def test_identity(octahedron):
    assert octahedron == octahedron and octahedron == ms.Mesh(octahedron)
    assert octahedron != ms.Mesh(V, F) and octahedron != 3
    assert len({octahedron, ms.Mesh(octahedron)}) == 1


def test_what_is_no_mesh():
    for thing in (3, None, object(), [V, F, F], {"v": V}):
        with pytest.raises((TypeError, ValueError)):
            ms.Mesh(thing)


def test_bug_misaligned_positions_were_read_as_they_lie(octahedron):
    """Undefined, though processors of today bear it; tests/python/sanitized sees it."""
    def misaligned(array):
        raw = np.zeros(array.nbytes + 1, np.uint8)[1:].view(array.dtype).reshape(array.shape)
        raw[...] = array
        assert not raw.flags.aligned
        return raw

    v, f = np.array(octahedron.vertices), np.array(octahedron.faces, np.int64)
    mesh = ms.Mesh(misaligned(v), misaligned(f))
    assert np.array_equal(mesh.vertices, v) and np.array_equal(mesh.faces, f)
    values = np.arange(6.0)
    assert np.array_equal(ms.field(mesh, misaligned(values)).values, values)


def test_vertices_that_a_mask_leaves_out():
    mask = np.ones(6, bool)
    mask[0] = False
    with pytest.warns(ms.MorselWarning, match="1 of 6 vertices and 4 faces were left out"):
        mesh = ms.Mesh(V, F, mask=mask)
    assert (mesh.vertex_count, mesh.face_count, mesh.boundary_loop_count) == (5, 4, 1)
    assert mesh.input_vertices.tolist() == [1, 2, 3, 4, 5]
    assert mesh.repairs == {"left_out_vertices": 1, "left_out_faces": 4}
    for same in (mask.astype(float), [np.nan, 1, 1, 1, 1, 2], mask.tolist()):
        with pytest.warns(ms.MorselWarning):
            assert np.array_equal(ms.Mesh(V, F.tolist(), mask=same).faces, mesh.faces)
    assert ms.Mesh(V, F, mask=np.ones(6)).warnings == []
    with pytest.raises(ms.ArgumentError, match="each of 6 vertices, not for 5"):
        ms.Mesh(V, F, mask=np.ones(5))
    with pytest.raises(ms.InputError, match="no face is left"):
        ms.Mesh(V, F, mask=np.zeros(6))


def test_a_file_with_a_mask(tmp_path):
    ms.Mesh(V, F).save(tmp_path / "m.off")
    np.savetxt(tmp_path / "mask.txt", [0, 1, 1, 1, 1, 1])
    with pytest.warns(ms.MorselWarning, match="mask.txt is 0 or nan at 1 of 6 vertices"):
        mesh = ms.read(tmp_path / "m.off", mask=tmp_path / "mask.txt")
    for one in (mesh, pickle.loads(pickle.dumps(mesh))):
        report = tmp_path / "report.json"
        ms.compare(ms.height(one), methods=["conventional"]).save(report)
        assert json.loads(report.read_text())["request"]["mask"] == f"file={tmp_path / 'mask.txt'}"
        assert ms.check(report) == []
    with pytest.raises(TypeError, match="arrays of the mesh"):
        ms.read(tmp_path / "m.off", mask=np.ones(6))
