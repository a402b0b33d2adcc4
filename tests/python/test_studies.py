"""Comparisons, sweeps and stability in Python."""

import json
import math

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V, sample

import morsel as ms


def test_comparison(lion, curvature, smooth):
    r = ms.compare(lion)
    assert [row.specification for row in r] == ["conventional", "salient", "tps:count=salient"]
    assert r["conventional"].counts.total == 1895 and r["salient"].counts.total == 97
    assert r["tps"].counts.total == 97 and r["tps:count=salient"] is r[2] and len(r[1:]) == 2
    assert r["tps"].field.method == "tps:count=97"
    assert np.array_equal(r.field.values, curvature.values)
    assert np.array_equal(r["salient"].field.values, smooth.values)
    assert r["salient"].numbers["above_1_percent"] == 24 and r["salient"].numbers["kept"] == 35
    p = r["salient"].critical_points
    assert p.origin.shape == (97,)
    assert set(p.origin[p.origin >= 0].tolist()) <= set(r[0].critical_points.vertex.tolist())
    assert len(r["salient"].diagram) == 48 and r["salient"].complex.saddle_count == 48
    assert r["salient"].field.steps[0].iterations["iteration"].tolist() == list(range(11))
    for wrong in ("gaussian", "x"):
        with pytest.raises(KeyError):
            r[wrong]
    with pytest.raises(IndexError):
        r[3]


def test_what_may_be_compared(small, curvature):
    by_text = ms.compare(small, field="height:axis=x", methods=["salient:iterations=2"])
    by_function = ms.compare((small.vertices, small.faces), field=ms.height.spec(axis="x"),
                             methods=[ms.salient.spec(iterations=2)])
    by_field = ms.compare(ms.height(small, axis="x"), methods=["salient:iterations=2"])
    for r in (by_function, by_field):
        assert np.array_equal(r[0].field.values, by_text[0].field.values)
    assert by_field.field.function == "height:axis=x"
    assert ms.compare(small, field=ms.height(small), methods=[ms.conventional])[0].counts.total > 0
    with pytest.raises(ValueError, match="another mesh"):
        ms.compare(small, field=curvature)
    for wrong in ({"methods": "salient"}, {"methods": [3]}, {"field": 3},
                  {"preset": "noise", "methods": ["tps"]}):
        with pytest.raises(TypeError):
            ms.compare(small, **wrong)
    for wrong in ({"methods": ["none"]}, {"methods": ["tps:count=salient"]}, {"field": "none"}, {"target": 0},
                  {"preset": "none"}):
        with pytest.raises(ms.ArgumentError):
            ms.compare(small, **wrong)


def test_chosen_points_of_each_row(small, tmp_path):
    r = ms.compare(small, methods=["conventional", "salient:iterations=2"], points=8)
    assert [len(row.chosen) for row in r] == [8, 8]
    wanted = ms.points(r[1].field, 8, fill=None)
    assert np.array_equal(r[1].chosen.vertex, wanted.vertex) and r[1].chosen.spacing == wanted.spacing
    assert "chosen" in r.table() and r[1].chosen.field.method == "salient:iterations=2"
    keys = {"count": 5, "kind": "maxima", "rank": "salience", "spacing": "3%", "percentiles": True,
            "fill": ms.height, "scale": "6eps"}
    chosen = ms.compare(small, methods=["salient"], points=keys)[0].chosen
    assert np.array_equal(chosen.vertex, ms.points(ms.salient(ms.mean_curvature(small)), **keys).vertex)
    assert np.isfinite(chosen.percentile).all() and set(chosen.type[~chosen.is_fill]) <= {ms.MAXIMUM}
    assert ms.compare(small, methods=["conventional"])[0].chosen is None
    for wrong in (0, -1, {"count": 3, "kind": "other"}, {"count": 3, "scale": 1}):
        with pytest.raises(ms.ArgumentError):
            ms.compare(small, points=wrong)
    for wrong in (2.5, "many", {"number": 3}):
        with pytest.raises(TypeError):
            ms.compare(small, points=wrong)


def test_points_at_their_origins(lion, tmp_path):
    """In reports and their chosen points; the arrays of the field's critical points are the same."""
    made = {}
    for snap in (False, True):
        r = made[snap] = ms.compare(lion, methods=["salient"], snap=snap, points=20)
        r.save(tmp_path / f"{snap}.json")
    p = made[True][0].critical_points
    followed = p.origin >= 0
    assert (p.origin[followed] != p.vertex[followed]).any()
    assert np.array_equal(p.vertex, made[False][0].critical_points.vertex)
    positions = {}
    for snap in made:
        method = json.loads((tmp_path / f"{snap}.json").read_text())["methods"][0]
        assert [item["vertex"] for item in method["items"]] == p.vertex.tolist()
        positions[snap] = np.array([item["position"] for item in method["items"]])
    assert np.array_equal(positions[False], p.position)
    at = np.where(followed, p.origin, p.vertex)
    assert np.array_equal(positions[True], lion.vertices[at])
    made[False][0].chosen.save(tmp_path / "points.csv")
    with pytest.raises(ms.ArgumentError, match="origins"):
        made[True][0].chosen.save(tmp_path / "points.csv")


def test_presets(small):
    assert set(ms.presets()) == {"paper", "noise", "resampled", "landmarks", "molecule"}
    r = ms.compare(small, preset="paper")
    assert r.field.function == ms.presets()["paper"][1]
    assert [row.specification for row in r] == ms.presets()["paper"][2]


def test_frames(small):
    r = ms.compare(small)
    frame = r.to_pandas()
    assert frame.index.tolist() == ["conventional", "salient", "tps:count=salient"]
    assert frame["total"].tolist() == [row.counts.total for row in r] and "seconds" in frame
    points = r[1].critical_points.to_pandas()
    assert points.columns.tolist() == ["vertex", "type", "multiplicity", "value", "persistence", "x", "y",
                                       "z"]
    assert len(r[1].diagram.to_pandas()) == len(r[1].diagram)
    assert len(ms.segment(r[1].field).to_pandas()) == len(ms.segment(r[1].field))
    assert len(ms.points(small, 5).to_pandas()) == 5


def test_graph_and_vtk(smooth):
    c = ms.morse_smale(smooth)
    graph = c.to_networkx()
    assert graph.number_of_nodes() == len(c.nodes) and graph.number_of_edges() == len(c.arcs)
    assert graph.nodes[0]["kind"] == "minimum" and graph.nodes[0]["vertex"] == c.nodes["vertex"][0]
    assert all(graph.degree(i) == 4 for i in graph if graph.nodes[i]["kind"] == "saddle")
    data = c.to_vtk()
    points, offsets = c.polylines
    assert data.GetNumberOfVerts() == len(c.nodes) and data.GetNumberOfLines() == len(c.arcs)
    assert data.GetNumberOfPoints() == len(c.nodes) + len(points)
    last = data.GetCell(len(c.nodes) + len(c.arcs) - 1)
    assert last.GetNumberOfPoints() == offsets[-1] - offsets[-2]
    assert last.GetPoints().GetPoint(0) == tuple(points[offsets[-2]])
    kinds = data.GetCellData().GetArray("kind")
    assert [kinds.GetValue(i) for i in (0, len(c.nodes), len(c.nodes) + 1)] == [0, 4, 5]


def test_sweep(small):
    s = ms.sweep(small, {"iterations": "1..3", "sigma": ["4eps", "8eps"]})
    assert s.keys == ["iterations", "sigma"] and len(s) == 6
    assert s[0]["iterations"] == "1" and s[0]["total"] >= s[5]["total"] and s[0]["iterations_run"] == 1
    assert "iterations" in s.table()
    frame = s.to_pandas()
    assert frame["iterations"].tolist() == [1, 1, 2, 2, 3, 3] and frame["sigma"][0] == "4eps"
    f = ms.salient(ms.mean_curvature(small), iterations=3, sigma="8eps")
    assert s[5]["total"] == ms.critical_points(f).counts.total and (s[5]["min"], s[5]["max"]) == (f.min,
                                                                                                  f.max)
    given = ms.sweep(ms.field(small, small.vertices[:, 0]), {"threshold": ["1%", "10%"]}, method=ms.tps)
    assert given[0]["total"] >= given[1]["total"]
    for wrong in ({}, {"none": [1]}, {"iterations": []}, {"iterations": [1, 1]}, {"iterations": [-1]}):
        with pytest.raises(ms.ArgumentError):
            ms.sweep(small, wrong)


def test_stability(small):
    t = ms.stability(small, methods=["conventional", "salient"], noise=[0.05, 0.3], trials=3, seed=5)
    assert len(t) == 4 and t.seed == 5 and t[0]["method"] == "conventional" and t[0]["amount"] == 0.05
    estimate = t[0]["recall"]
    assert 0 < estimate.mean <= 1 and estimate.count == 3 and estimate.half_width >= 0
    assert t[0]["recall"].mean >= t[1]["recall"].mean and "noise" in t.table()
    frame = t.to_pandas()
    assert frame["recall"].tolist() == [row["recall"].mean for row in t] and "f_score_half_width" in frame
    again = ms.stability(small, methods=["conventional", "salient"], noise=[0.05, 0.3], trials=3, seed=5)
    assert list(again) == list(t)
    assert t.radius == small.length("0.02rootarea") and t.mean_edge_length == small.length("1edges")
    given = ms.stability(ms.field(small, small.vertices[:, 0]), methods=["conventional"], noise=[0.1],
                         trials=1)
    assert given[0]["recall"].mean > 0 and given[0]["recall"].half_width is None
    by_preset = ms.stability(small, preset="resampled", target=8, noise=[0.1], trials=1)
    assert by_preset[0]["field"].startswith("mean-curvature:estimator=diffused")
    assert {row["target"] for row in by_preset} == {None, 8}
    for wrong in ({"preset": "paper", "methods": ["tps"]}, {"trials": -1}, {"noise": ["much"]}):
        with pytest.raises((TypeError, ValueError)):
            ms.stability(small, **wrong)
    for wrong in ({"preset": "none"}, {"kind": "other"}, {"points": "some"}, {"trials": 0}, {"noise": [-1]},
                  {"decimate": [2]}, {"radius": "far"}, {"subdivide": [1.5]}):
        with pytest.raises(ms.ArgumentError):
            ms.stability(small, **wrong)


def test_landmarks_in_memory(small, lion):
    marks = ms.points(small, 12).vertex
    found = ms.landmarks([(small, marks), (lion, np.arange(0, 8000, 400))], fill="mean-curvature",
                         methods=["conventional", ms.salient], seed=3)
    assert [row["name"] for row in found] == ["conventional", "salient", "random", "farthest points"]
    assert found.mesh_count == 2 and found.seed == 3 and "farthest points" in found.table()
    first = found.on_mesh(0)[0]
    assert np.array_equal(first.points, marks) and first.f_score == 1 and first.note == ""
    assert len(found.on_mesh(0)[2].points) == 0 and len(found.on_mesh(1)[3].points) == 20
    assert found[0]["points"].mean == 16 and found[0]["recall"].low <= found[0]["recall"].mean
    assert found[0]["f_score_gain"].mean == 0 and found[2]["method"] is None
    frame = found.to_pandas()
    assert frame["f_score"].tolist() == [row["f_score"].mean for row in found] and "f_score_low" in frame
    assert ms.landmarks([(small, marks)])[0]["f_score"].low is None
    with pytest.raises(ms.ArgumentError, match="list of files"):
        found.save("landmarks.json")
    with pytest.raises(IndexError):
        found.on_mesh(2)
    for wrong in ([], [(small, [small.vertex_count])], [(small, [1, 1])]):
        with pytest.raises(ms.ArgumentError):
            ms.landmarks(wrong)
    for options in ({"points": 0}, {"radius": -1}, {"resamples": 5}, {"first": 2}, {"kind": "other"}):
        with pytest.raises(ms.ArgumentError):
            ms.landmarks([(small, marks)], **options)
    for wrong in ([(small, [])], [(small, [-1])], [(small, [0.5])]):
        with pytest.raises(ValueError):
            ms.landmarks(wrong)
    with pytest.raises(ms.ArgumentError):
        ms.landmarks([(small, marks)], points=-1)
    with pytest.raises(ms.InputError):
        ms.landmarks("missing.txt")


def test_landmarks_of_ones_own_method(small):
    @ms.method("halved")
    def halved(f):
        return f.values / 2

    marks = ms.points(small, 12).vertex
    with ms.threads(3):
        found = ms.landmarks([(small, marks)] * 3, methods=["conventional", "halved"])
    assert found[0]["f_score"] == found[1]["f_score"]

    @ms.method("failing")
    def failing(f):
        raise KeyError("of one's own")

    with pytest.raises(KeyError, match="of one's own"):
        ms.landmarks([(small, marks)], methods=["failing"])


def test_of_a_constant_field():
    flat = ms.field(ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F), np.zeros(6))
    with pytest.warns(ms.MorselWarning, match="constant"):
        r = ms.compare(flat, methods=["conventional"])
    assert r[0].counts == (2, 1, 1, 1, 4)  # by the vertices' numbers, of which 0 and 1 are opposite
    assert math.isinf(r[0].critical_points.persistence[0])


def test_of_paths():
    assert ms.compare(sample("sphere.off"), methods=["conventional"]).mesh.path == sample("sphere.off")
    assert len(ms.points(sample("eight.off"), 3)) == 3
