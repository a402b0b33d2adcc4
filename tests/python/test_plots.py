"""Plots by matplotlib: what is in them."""

import numpy as np
import pytest
from matplotlib import pyplot

import morsel as ms
from morsel import _sweep


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


@pytest.fixture(scope="module")
def comparison(lion):
    return ms.compare(lion, methods=["conventional", "salient"])


def drawn(ax):
    """The numbers of points of what is scattered."""
    return [len(collection.get_offsets()) for collection in ax.collections]


def test_diagram(smooth, tmp_path):
    d = ms.persistence(smooth)
    ax = d.plot()
    kinds = [int((d.pairs["kind"] == kind).sum()) for kind in range(3)]
    assert kinds[2] == 0 and drawn(ax) == kinds[:2]
    ax.figure.savefig(tmp_path / "diagram.png")
    other = pyplot.figure().add_subplot()
    assert d.plot(other) is other


def test_points(smooth):
    p = ms.critical_points(smooth)
    ax = p.plot()
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert texts == [f"{p.counts.minima} minima", f"{p.counts.saddles} saddles", f"{p.counts.maxima} maxima"]
    assert p.maxima.plot(smooth.mesh) is not None
    ax.figure.canvas.draw()
    with pytest.raises(ValueError):
        p.plot(ms.Mesh(smooth.mesh).subdivided(2))


def test_counts(comparison):
    ax = comparison.plot_counts()
    heights = np.array([bar.get_height() for bar in ax.patches]).reshape(3, 2)
    assert heights.sum(axis=0).tolist() == [1895, 97]
    twice = ms.compare(comparison.field.mesh, methods=["conventional", "conventional"]).plot_counts()
    assert sorted({round(bar.get_x() + bar.get_width() / 2) for bar in twice.patches}) == [0, 1]
    axes = comparison.plot_diagrams()
    assert [ax.get_title() for ax in axes] == ["conventional", "salient"]


def test_sweep(small):
    s = ms.sweep(small, {"iterations": [1, 2, 4], "weights": ["none", "area"]}, method="gaussian")
    ax = s.plot()
    assert len(ax.lines) == 2 and ax.lines[0].get_xdata().tolist() == [1, 2, 4]
    assert ax.lines[0].get_ydata().tolist() == [row["total"] for row in s if row["weights"] == "none"]
    assert len(s.plot("weights").lines) == 3


def test_stability(small):
    t = ms.stability(small, methods=["conventional", "tps"], noise=[0.1, 0.3], trials=2)
    ax = t.plot("recall")
    assert len(ax.get_legend().get_texts()) == 2
    assert ax.lines[0].get_ydata().tolist() == [row["recall"].mean
                                                for row in t if row["method"] == "conventional"]


def test_stability_of_several_fields_and_perturbations(small):
    t = ms.stability(small, fields=["mean-curvature", "height"], methods=["conventional"], noise=[0.1, 0.2],
                     decimate=[0.5, 0.8], trials=2)
    ax = t.plot()
    assert ax.get_xlabel().startswith("noise")
    assert [line.lines[0].get_xdata().tolist() for line in ax.containers] == 2 * [[0.1, 0.2]]
    ax = t.plot("f_score", "decimation")
    assert [sorted(line.lines[0].get_xdata()) for line in ax.containers] == 2 * [[0.5, 0.8]]
    with pytest.raises(ValueError):
        t.plot("f_score", "subdivision")


def test_an_estimate_of_nothing_is_no_number():
    assert np.isnan(_sweep._estimate(0.0, None, 0).mean) and _sweep._estimate(0.5, None, 1).mean == 0.5
