"""Arguments that are no numbers, texts or sequences: one clear sentence, of a documented kind."""

import pytest

import morsel as ms


def refused(kind, says, call):
    with pytest.raises(kind) as caught:
        call()
    assert says in str(caught.value) and "incompatible function arguments" not in str(caught.value)


def test_whole_numbers(small):
    f = ms.mean_curvature(small)
    h, c = ms.hierarchy(f), ms.morse_smale(f)
    for value in (5.0, "5", None, [5]):
        if value is not None:
            refused(TypeError, "target", lambda: ms.salient(f, target=value))
            refused(TypeError, "target", lambda: ms.compare(f, target=value))
            refused(TypeError, "segments", lambda: ms.segment(f, segments=value))
        refused(TypeError, "resolution", lambda: ms.quads(f, resolution=value))
        refused(TypeError, "relaxation", lambda: ms.quads(f, relaxation=value))
        refused(TypeError, "pieces", lambda: small.subdivided(value))
        refused(TypeError, "threads", lambda: ms.threads(value))
        refused(TypeError, "cancellations", lambda: h.after(value))
        refused(TypeError, "cancellations", lambda: h.counts(value))
        refused(TypeError, "node", lambda: c.arcs_around(value))
        refused(TypeError, "trials", lambda: ms.stability(f, trials=value))
        refused(TypeError, "seed", lambda: ms.landmarks([(small, [0])], seed=value))
    for value in (-3, 0, 2**70):
        refused(ms.ArgumentError, "target", lambda: ms.salient(f, target=value))
    for value in (-1, 2**70):
        refused(ms.ArgumentError, "segments", lambda: ms.segment(f, segments=value))
        refused(ms.ArgumentError, "seed", lambda: ms.stability(f, seed=value))
        refused(IndexError, "cancellations", lambda: h.after(value))
        refused(IndexError, "cancellations", lambda: h.counts(value))
        refused(IndexError, "node", lambda: c.arcs_around(value))
    refused(TypeError, "critical cells", lambda: h[20.0])
    refused(IndexError, "critical cell", lambda: h[-1])
    refused(ms.ArgumentError, "resolution", lambda: ms.quads(f, resolution=2**40))
    refused(ms.ArgumentError, "pieces", lambda: small.subdivided(2**40))
    marked = ms.landmarks([(small, [0, 100])])
    assert len(marked.on_mesh(0)) == len(marked)
    for value in (-1, 1):
        refused(IndexError, "mesh", lambda: marked.on_mesh(value))


def test_functions_for_names(small):
    f = ms.mean_curvature(small)
    assert (f.apply(ms.salient).values == ms.salient(f).values).all()
    levels = ms.hierarchy(f, by="iteration", method=ms.gaussian, levels=[1])
    assert (levels[0].field.values == ms.gaussian(f, iterations=1).values).all()
    refused(TypeError, "functions such as ms.salient", lambda: f.apply(3))
    refused(TypeError, "functions such as ms.salient", lambda: ms.hierarchy(f, by="iteration", method=3))


def test_arguments_of_hierarchies(small):
    f = ms.mean_curvature(small)
    h = ms.hierarchy(f)
    for options in ({"levels": [5]}, {"method": "salient"}, {"method": "nonsense", "levels": [150]}):
        refused(ms.ArgumentError, "iteration", lambda: ms.hierarchy(f, **options))
    assert h["1%"].saddle_count == h.at("1%").saddle_count < h["0%"].saddle_count
    refused(TypeError, "sequence", lambda: ms.hierarchy(f, by="iteration", levels=5))
    refused(TypeError, "whole number", lambda: ms.hierarchy(f, by="iteration", levels=[1.5]))
    refused(TypeError, "sequence", lambda: h.levels(counts=60))
    refused(TypeError, "sequence", lambda: h.levels(persistence="1%"))
    refused(TypeError, "whole number", lambda: h.levels(counts=["60"]))
