"""Critical points, diagrams, complexes, segments, hierarchies, chosen points, cuts and quads as arrays."""

import gc

import numpy as np
import pytest
from conftest import sample

import morsel as ms

NONE = 2**32 - 1


def test_critical_points_of_a_height(octahedron):
    p = ms.critical_points(ms.height(octahedron))
    assert p.vertex.tolist() == [0, 1] and p.type.tolist() == [ms.MAXIMUM, ms.MINIMUM]
    assert p.type_name.tolist() == ["maximum", "minimum"] and p.multiplicity.tolist() == [1, 1]
    assert p.value.tolist() == [1, -1] and p.position.tolist() == [[0, 0, 1], [0, 0, -1]]
    assert np.isinf(p.persistence).all() and len(p) == 2
    assert p.counts == (1, 0, 0, 1, 2) and p.counts.total == 2
    assert p.array.dtype.names == ("vertex", "type", "multiplicity")


def test_indexing(smooth):
    p = ms.critical_points(smooth)
    assert len(p) == 97 and len(p.minima) + len(p.saddles) + len(p.maxima) == 97
    assert p[p.type == ms.MAXIMUM].counts == (0, 0, 0, p.counts.maxima, p.counts.maxima)
    large = p[p.persistence > 0.1 * smooth.extent]
    assert 0 < len(large) < 97 and (large.persistence > 0.1 * smooth.extent).all()
    assert np.array_equal(p[3:5].vertex, p.vertex[3:5]) and p[-1].vertex.tolist() == [p.vertex[-1]]
    assert np.array_equal(p[[4, 2]].vertex, p.vertex[[4, 2]]) and len(p[[]]) == 0
    with pytest.raises(IndexError):
        p[97]
    with pytest.raises(IndexError):
        p[np.ones(3, bool)]
    with pytest.raises(AttributeError):
        p.origin
    assert p[np.array(3)].vertex.tolist() == [p.vertex[3]] and len(p[...]) == 97
    for wrong in (None, True, np.array(True), (slice(None), None), [[0, 1], [2, 3]], ["vertex", "type"], 1.5):
        with pytest.raises(IndexError):
            p[wrong]
    with pytest.raises(ValueError):
        p.vertex[0] = 0


def test_euler(curvature, small):
    for f in (curvature, ms.height(small), ms.mean_curvature(small)):
        c = ms.critical_points(f).counts
        assert c.minima - c.saddle_multiplicity + c.maxima == f.mesh.euler_characteristic


def test_diagram(curvature):
    d = ms.persistence(curvature)
    assert len(d) == 960 and d.pairs.dtype.names == ("extremum", "saddle", "kind", "birth", "death")
    assert d.birth_death.shape == (960, 2) and np.shares_memory(d.birth_death, d.pairs)
    assert np.array_equal(d.birth_death[:, 0], d.pairs["birth"])
    assert (np.diff(d.persistence[:len(d.finite)]) >= 0).all()
    assert [d.count_above(t) for t in ("0.1%", "1%", "5%")] == [734, 295, 98]
    assert d.count_above(0.01 * curvature.extent) == 295
    values = curvature.values
    of_minima = d.pairs[d.pairs["kind"] == ms.MINIMUM_SADDLE]
    assert np.array_equal(values[of_minima["extremum"]], of_minima["birth"])
    assert np.array_equal(values[of_minima["saddle"]], of_minima["death"])
    assert d.dimension.tolist() == [0 if kind == 0 else 1 for kind in d.pairs["kind"].tolist()]
    assert d.essential_extrema["minimum"].tolist() == [int(np.argmin(values))]
    assert bool(d.essential_extrema["top_is_cap"][0])
    p = ms.critical_points(curvature)
    finite = np.sort(p.persistence[(p.type != ms.SADDLE) & np.isfinite(p.persistence)])
    assert np.array_equal(finite, d.persistence[:len(d.finite)])


def test_diagram_of_a_torus():
    d = ms.persistence(ms.height(sample("torus_quad.off")))
    assert d.essential_saddles["count"].sum() == 2
    assert (d.birth_death[:, 0] <= d.birth_death[:, 1]).all()


def test_complex(smooth):
    c = ms.morse_smale(smooth)
    counts = ms.critical_points(smooth).counts
    assert (c.minimum_count, c.saddle_count, c.maximum_count, c.cap_count) == (
        counts.minima, counts.saddle_multiplicity, counts.maxima, 1)
    assert len(c.nodes) == counts.total + 1 and len(c.arcs) == 4 * c.saddle_count == 192
    assert len(c.quads) == 96 and c.quads["nodes"].shape == (96, 4)
    assert np.bincount(c.nodes["kind"]).tolist() == [c.minimum_count, c.saddle_count, c.maximum_count, 1]
    finite = c.nodes["kind"] != 3
    assert np.array_equal(c.nodes["value"][finite], smooth.values[c.nodes["vertex"][finite]])
    assert np.isinf(c.nodes["value"][~finite]).all()
    arcs = c.arcs
    assert (c.nodes["kind"][arcs["saddle"]] == 1).all()
    assert (c.nodes["kind"][arcs["end"][arcs["kind"] == 0]] == 0).all()
    assert set(c.nodes["kind"][arcs["end"][arcs["kind"] == 1]].tolist()) == {2, 3}
    assert (arcs["kind"] == np.arange(192) % 2).all()
    assert sorted(c.arcs_around(int(arcs["saddle"][8])).tolist()) == [8, 9, 10, 11]
    for node in (-1, len(c.nodes)):
        with pytest.raises(IndexError):
            c.arcs_around(node)
    assert 0 < c.cell_count <= 96


def test_polylines(smooth):
    c = ms.morse_smale(smooth)
    points, offsets = c.polylines
    assert len(offsets) == 193 and offsets[-1] == len(points) and points.shape[1] == 3
    assert (np.diff(offsets.astype(np.int64)) >= 2).all()
    positions = smooth.mesh.vertices
    for arc in range(0, 192, 17):
        line = points[offsets[arc]:offsets[arc + 1]]
        ends = c.nodes["vertex"][[c.arcs["saddle"][arc], c.arcs["end"][arc]]]
        assert np.array_equal(line[0], positions[ends[0]])
        if c.nodes["kind"][c.arcs["end"][arc]] != 3:
            assert np.array_equal(line[-1], positions[ends[1]])
    assert c.polylines[0] is points


def test_segmentation(smooth):
    c = ms.morse_smale(smooth)
    s = c.segmentation
    assert s.ascending.count == c.minimum_count and len(s.ascending.vertex) == len(smooth)
    assert s.ascending.vertex.max() < c.minimum_count
    assert len(s.morse_smale.face) == smooth.mesh.face_count
    pairs = s.cells[s.morse_smale.face]
    assert np.array_equal(pairs[:, 0], s.ascending.face) and np.array_equal(pairs[:, 1], s.descending.face)


@pytest.mark.parametrize("by", ["descending", "ascending", "morse-smale"])
def test_segments(smooth, by):
    s = ms.segment(smooth, by=by, segments=12)
    assert s.by == by and len(s) <= 12 < s.unmerged and s.cancelled_pairs > 0 and s.note == ""
    assert s.face.max() + 1 == len(s) and (np.bincount(s.face) == s.table["triangles"]).all()
    assert s.table["area"].sum() == pytest.approx(smooth.mesh.length("1rootarea")**2)
    rows, offsets = s.neighbours
    assert len(offsets) == len(s) + 1 and offsets[-1] == len(rows)
    saddles, places = s.saddles
    assert len(places) == len(s) + 1 and places[-1] == len(saddles)
    has_minimum, has_maximum = s.minima >= 0, s.maxima >= 0
    assert has_minimum.all() == (by != "descending") and has_maximum.all() == (by != "ascending")


def test_segments_refused(smooth):
    for options in ({"by": "other"}, {"segments": 0}, {"segments": 3, "persistence": 1}, {"persistence": -1},
                    {"persistence": "much"}):
        with pytest.raises(ms.ArgumentError):
            ms.segment(smooth, **options)
    with pytest.raises(TypeError):
        ms.segment(smooth.mesh)
    assert len(ms.segment(smooth, persistence="5%")) < len(ms.segment(smooth))


def test_hierarchy_by_persistence(curvature):
    h = ms.hierarchy(curvature)
    assert len(h.cancellations) > 900 and (np.diff(h.cancellations["persistence"]) >= 0).all()
    c = h[150]
    assert c.minimum_count + c.saddle_count + c.maximum_count in (149, 150)
    assert len(h[150].arcs) == 4 * c.saddle_count and h.counts(0) == (462, 960, 499)
    assert ms.persistence(curvature).count_above("1%") == 295
    assert h.at("1%").saddle_count == h.counts(960 - 295)[1] == 295
    assert h.after(0).saddle_count == 960
    assert len(h[10**9].arcs) == 4 * 960
    for wrong in (lambda: h[0], lambda: h.after(-1), lambda: h.after(10**6), lambda: h.counts(10**6)):
        with pytest.raises(IndexError):
            wrong()
    levels = h.levels(counts=[500, 100])
    assert [level.name for level in levels] == ["500", "100"] and len(levels) == 2
    assert levels.at(100).counts.total <= 100 and levels[0].status.tolist()[0] == "first"
    assert set(levels[1].status.tolist()) == {"kept"}
    links = levels[1].links("descending")
    assert links.areas.sum() == pytest.approx(curvature.mesh.length("1rootarea")**2)
    assert (links.parents["segment"] != NONE).any()
    with pytest.raises(KeyError):
        levels.at(7)


def test_hierarchy_by_iteration(curvature, smooth):
    levels = ms.hierarchy(curvature, by="iteration", levels=[10, 1, 5])
    assert [level.iteration for level in levels] == [1, 5, 10]
    assert np.array_equal(levels.at(10).field.values, smooth.values)
    assert levels.at(10).counts.total == 97 and levels.at(5).arcs is not None
    assert set(levels.at(10).status.tolist()) <= {"kept", "moved", "new"}
    with pytest.raises(KeyError):
        levels.at(2)
    for options in ({"method": "tps"}, {"levels": []}, {"levels": [-1]}, {"levels": [1, 1]}):
        with pytest.raises(ms.ArgumentError):
            ms.hierarchy(curvature, by="iteration", **options)
    with pytest.raises(ms.ArgumentError):
        ms.hierarchy(curvature, by="area")


def test_levels_are_a_sequence(curvature):
    by_iteration = ms.hierarchy(curvature, by="iteration", levels=[0, 1, 2])
    by_count = ms.hierarchy(curvature).levels(counts=[500, 100])
    for levels in (by_iteration, by_count):
        assert levels[-1] is levels[len(levels) - 1] and levels[1:] == list(levels)[1:]
        assert list(reversed(levels)) == list(levels)[::-1] and levels.index(levels[1]) == 1
        with pytest.raises(IndexError):
            levels[len(levels)]
    assert by_iteration.at(2) is by_iteration.at("2") is by_iteration[2]
    assert by_count.at(500) is by_count[0]
    by_threshold = ms.hierarchy(curvature).levels(persistence=["1%", 0.5])
    assert {by_threshold.at("1%"), by_threshold.at(0.5)} == set(by_threshold)


def test_levels_by_persistence_share_their_field(curvature):
    h = ms.hierarchy(curvature)
    levels = h.levels(counts=[500, 100])
    assert levels[0].field is levels[1].field is h.field is curvature


def test_levels_by_iteration_know_how_they_were_made(curvature, tmp_path):
    start = ms.gaussian(curvature, iterations=1)
    levels = ms.hierarchy(start, by="iteration", method="laplacian:iterations=4", levels=[0, 2, 4])
    for level in levels:
        alone = ms.laplacian(start, iterations=level.iteration)
        assert np.array_equal(level.field.values, alone.values)
        assert level.field.method == alone.method and level.field.steps[-1].end == alone.steps[-1].end
        assert level.field.steps[-1].parameters == alone.steps[-1].parameters
        assert level.field.steps[-1].details == alone.steps[-1].details
        level.field.save(tmp_path / "level.txt")
        alone.save(tmp_path / "alone.txt")
        assert (tmp_path / "level.txt").read_bytes() == (tmp_path / "alone.txt").read_bytes()


def test_points(lion):
    p = ms.points(lion, 30, spacing="4%")
    assert len(p) == 30 and p.note == "" and (p.distance >= p.spacing).all()
    assert p.candidates[0] >= 30 - p.is_fill.sum()
    assert p.position.shape == (30, 3) and (np.diff(p.rank[~p.is_fill]) <= 0).all()
    assert set(p.type.tolist()) <= {ms.MINIMUM, ms.MAXIMUM} and np.isnan(p.percentile).all()
    measured = ms.points(lion, 30, spacing="4%", percentiles=True)
    assert np.array_equal(measured.vertex, p.vertex)
    assert ((measured.percentile > 0) & (measured.percentile < 1)).all() and measured.percentile.mean() > 0.5
    few = ms.points(ms.height(lion), 500, spacing=0, kind="maxima", fill=None)
    assert len(few) < 500 and few.note != ""
    filled = ms.points(ms.height(lion), len(few) + 5, spacing=0, kind="maxima", fill=ms.mean_curvature)
    assert np.array_equal(filled.vertex[~filled.is_fill], few.vertex) and filled.is_fill.sum() == 5
    assert p.counts.total == 30 and p.counts.minima == (p.type_name == "minimum").sum()
    assert ms.points(ms.mean_curvature(lion), 5, rank="salience").vertex.shape == (5,)
    for options in ({"kind": "other"}, {"rank": "other"}, {"spacing": -1}, {"fill": "none-such"},
                    {"count": 0}, {"count": -1},
                    {"scale": 1}):
        with pytest.raises(ms.ArgumentError):
            ms.points(lion, **options)
    for options in ({"count": 2.5}, {"fill": 3}):
        with pytest.raises(TypeError):
            ms.points(lion, **options)


def test_cut(small):
    c = ms.cut(small)
    assert c.mesh.genus == 0 and c.mesh.boundary_loop_count == 1 and c.mesh.face_count == small.face_count
    assert np.array_equal(c.mesh.vertices, small.vertices[c.original])
    assert c.length <= c.length_found == ms.cut(small, shorten=False).length
    assert c.components["genus"].tolist() == [small.genus]
    assert len(c.edges) == sum(len(path) - 1 for path in c.paths)


def test_quads(small):
    q = ms.quads(ms.eigenfunction(small, index=10), resolution=4)
    assert len(q.faces) == 16 * q.patch_count and q.faces.max() < len(q.vertices)
    assert q.patch.max() + 1 == q.patch_count and q.quality["concave"] >= 0 and "quads" in q.describe()
    edges = np.sort(np.stack([q.faces, np.roll(q.faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    with pytest.raises(ms.ArgumentError):
        ms.quads(small, resolution=1)


def test_views_outlive_what_they_are_of(lion):
    def arrays():
        mesh = ms.read(sample("lion-head.off"))
        f = ms.salient(ms.mean_curvature(mesh), iterations=2)
        c, d = ms.morse_smale(f), ms.persistence(f)
        return [mesh.vertices, mesh.faces, f.values, f.ranks, ms.critical_points(f).array, d.birth_death,
                d.pairs,
                c.nodes, c.arcs, c.polylines[0], c.segmentation.ascending.vertex,
                ms.segment(f, segments=5).table, ms.compare(mesh)[1].critical_points.array]

    kept = arrays()
    copies = [array.copy() for array in kept]
    for _ in range(3):
        gc.collect()
        arrays()
    for array, copy in zip(kept, copies):
        assert np.array_equal(array, copy) and not array.flags.writeable and not array.flags.owndata
    assert np.array_equal(kept[0], lion.vertices)
