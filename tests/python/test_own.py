"""Morse functions and methods that users write in Python."""

import json

import numpy as np
import pytest
from conftest import sample

import morsel as ms


@ms.method("mine", strength=1.0)
def mine(f, strength):
    """Powers of the values."""
    return np.sign(f.values) * np.abs(f.values) ** strength


@ms.function("radius", descriptions={"scale": "what it is divided by"}, power=1.0, scale=ms.Length("10%"),
             times=1,
             negative=False, note="none")
def radius(mesh, power, scale, times, negative, note):
    """The distance from the middle."""
    assert isinstance(mesh, ms.Mesh) and isinstance(scale, float) and isinstance(times, int)
    assert isinstance(negative, bool) and isinstance(note, str)
    values = (np.linalg.norm(mesh.vertices - mesh.vertices.mean(axis=0), axis=1) / scale) ** power * times
    return -values if negative else values


@ms.method("cancelled")
def cancelled(f):
    """Persistence simplification, whose order is kept."""
    return ms.tps(f, threshold="1%")


def test_as_functions(small):
    f = radius(small, power=2, times=3)
    middle = small.vertices.mean(axis=0)
    expected = (np.linalg.norm(small.vertices - middle, axis=1) / small.length("10%")) ** 2 * 3
    assert np.array_equal(f.values, expected)
    assert f.function == "radius:power=2,times=3" and f.parameters["scale"] == small.length("10%")
    assert np.array_equal(radius(small, negative=True).values, -radius(small).values)
    g = mine(f, strength=0.5)
    assert np.array_equal(g.values, f.values ** 0.5) and g.method == "mine:strength=0.5"
    assert np.array_equal(f.apply("mine:strength=0.5+salient:iterations=2").values,
                          ms.salient(g, iterations=2).values)
    assert "Powers of the values" in mine.__doc__ and mine.__name__ == "mine"
    assert "what it is divided by" in radius.__doc__
    assert "mine" in ms.methods() and ms.functions()["radius"] == "The distance from the middle"


def test_the_order_of_a_field_is_kept(curvature):
    assert np.array_equal(cancelled(curvature).ranks, ms.tps(curvature, threshold="1%").ranks)


def test_in_comparisons_targets_and_reports(tmp_path):
    mesh = ms.read(sample("eight.off"))
    r = ms.compare(mesh, field="radius:power=2",
                   methods=["conventional", mine, "mine:strength=0.5+tps:count=20",
                                                         "tps:count=mine"])
    assert [row.name for row in r] == ["conventional", "mine", "mine+tps", "tps"]
    assert r["mine"].field.steps[0].parameters == {"strength": 1.0} and "mine" in r.table()
    r.save(tmp_path / "report.json")
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["field"]["name"] == "radius" and report["field"]["parameters"]["power"] == 2
    assert ms.check(tmp_path / "report.json") == []
    report["methods"][1]["critical_points"]["total"] += 1
    (tmp_path / "report.json").write_text(json.dumps(report))
    assert len(ms.check(tmp_path / "report.json")) == 1
    r.save(tmp_path / "page.html")
    assert "mine:strength=0.5" in (tmp_path / "page.html").read_text()
    t = mine(ms.mean_curvature(mesh), strength=1.0, target=30)
    assert t.target.reached == ms.critical_points(t).counts.total <= 30


def test_reports_of_other_functions_are_refused(tmp_path):
    @ms.method("for-a-moment")
    def moment(f):
        return f

    mesh = ms.read(sample("eight.off"))
    ms.compare(mesh, methods=[moment]).save(tmp_path / "report.json")
    text = (tmp_path / "report.json").read_text().replace("for-a-moment", "never-made")
    (tmp_path / "report.json").write_text(text)
    with pytest.raises(ms.InputError, match="never-made"):
        ms.check(tmp_path / "report.json")


def test_files_are_hashed(tmp_path):
    """A key that names a file: the report of another file's values does not pass."""
    @ms.function("from-file", path=ms.File(""))
    def from_file(mesh, path):
        return np.loadtxt(path)

    mesh = ms.read(sample("eight.off"))
    values = tmp_path / "values.txt"
    np.savetxt(values, mesh.vertices[:, 0])
    r = ms.compare(mesh, field=f"from-file:path={values}", methods=["conventional"])
    r.save(tmp_path / "report.json")
    given = json.loads((tmp_path / "report.json").read_text())["field"]["parameters"]
    assert given["path"] == str(values) and len(given["path_sha256"]) == 64
    assert ms.check(tmp_path / "report.json") == []
    np.savetxt(values, -mesh.vertices[:, 0])
    assert ms.check(tmp_path / "report.json")


def test_in_sweeps_and_stability(small):
    s = ms.sweep(small, {"strength": [0.5, 1.0, 2.0]}, method="mine")
    assert [row["method"] for row in s] == [f"mine:strength={value}" for value in ("0.5", "1.0", "2.0")]
    s = ms.sweep(small, {"field.power": [1, 2]}, field=radius, method=mine)
    assert len(s) == 2
    with ms.threads(3):
        t = ms.stability(small, fields=[radius], methods=[mine, "conventional"], noise=[0.1], trials=4)
    assert len(t) == 2 and t[0]["f_score"].mean == t[1]["f_score"].mean


def test_added_again_replaces(small):
    for value in (1.0, 2.0):
        @ms.function("again")
        def again(mesh, value=value):
            return np.full(mesh.vertex_count, value) + np.arange(mesh.vertex_count)

        assert again(small).values[0] == value
    with pytest.raises(ms.ArgumentError):
        ms.method("salient")(lambda f: f)
    with pytest.raises(ms.ArgumentError):
        ms.method("Two words")(lambda f: f)
    with pytest.raises(TypeError):
        ms.method("bad", strength=[1])(lambda f: f)
    with pytest.raises(TypeError):
        ms.method("bad", descriptions={"x": "?"})(lambda f: f)
    assert "bad" not in ms.methods()


def test_fields_made_before_go_on(small, tmp_path):
    """A name that stands for something else now does not concern fields that were made with it."""
    @ms.function("later", power=2.0)
    def later(mesh, power):
        return mesh.vertices[:, 0] ** power

    @ms.method("later", strength=1.0)
    def later_method(f, strength):
        return f.values * strength

    h = later_method(later(small, power=3.0), strength=3.0)
    ms.function("later", other=2.0)(lambda mesh, other: mesh.vertices[:, 1])
    ms.method("later", other=1.0)(lambda f, other: f.values)
    assert np.array_equal(ms.salient(h, iterations=1).values,
                          ms.salient(ms.field(small, h.values), iterations=1).values)
    levels = ms.hierarchy(h, by="iteration", method="gaussian", levels=[1])
    assert np.array_equal(levels[0].field.values, ms.gaussian(h, iterations=1).values)
    h.save(tmp_path / "h.txt")
    with pytest.raises(ms.ArgumentError):
        ms.segment(h).save(tmp_path / "h.json")


def test_wrong_declarations_add_nothing(small):
    for decorate, own, says in [
            (lambda: ms.method, lambda f: f, "has a name"),
            (lambda: ms.function, lambda mesh: mesh.V[:, 0], "has a name"),
            (lambda: ms.method("bad"), 3, "must be a function"),
            (lambda: ms.method("bad", target=1), lambda f, target: f, "cannot have a parameter target"),
            (lambda: ms.method("bad", progress=True), lambda f, progress: f, "parameter progress"),
            (lambda: ms.function("bad", mesh=1), lambda mesh: mesh, "parameter mesh"),
            (lambda: ms.method("bad", strength=1.0), lambda f: f, "strength"),
            (lambda: ms.method("bad"), lambda f, strength: f, "strength")]:
        with pytest.raises(TypeError, match=says):
            decorate()(own)
    assert "bad" not in ms.methods() and "bad" not in ms.functions()


def test_defaults_of_the_function_are_parameters(small):
    @ms.method("scaled", power=2.0)
    def scaled(f, power, factor=1.5, *, name="x", helper=None):
        assert name in ("x", "y") and helper is None
        return factor * f.values ** power

    f = ms.field(small, np.arange(small.vertex_count))
    assert np.array_equal(scaled(f).values, 1.5 * f.values ** 2)
    g = scaled(f, factor=3.0, name="y")
    assert np.array_equal(g.values, 3 * f.values ** 2) and g.method == "scaled:factor=3.0,name=y"
    assert g.steps[0].parameters == {"power": 2.0, "factor": 3.0, "name": "y"}


@pytest.mark.parametrize("returned, says", [
    (lambda f: np.ma.masked_less(f.values, 0), "masked array"),
    (lambda f: None, "must return"),
    (lambda f: "text", "must return"),
    (lambda f: f.values[:3], "3 values"),
    (lambda f: f.values[:, None], "(n,)"),
    (lambda f: f.values + 1j, "real"),
    (lambda f: f.values * np.nan, "nan"),
    (lambda f: ms.height(f.mesh.subdivided(2)), "another mesh"),
])
def test_what_is_returned_wrongly(small, returned, says):
    ms.method("wrong")(returned)
    with pytest.raises(ValueError) as caught:
        ms.height(small).apply("wrong")
    assert says in str(caught.value)


def test_what_it_raises(small):
    class Mine(Exception):
        """Of the test."""

    @ms.method("raises")
    def raises(f):
        raise Mine("of one's own")

    for work in (lambda: raises(ms.height(small)),
                 lambda: ms.compare(small, methods=["conventional", "raises"]),
                 lambda: ms.stability(small, methods=["raises"], noise=[0.1], trials=2),
                 lambda: ms.sweep(small, {"field.axis": ["x", "y"]}, field="height", method="raises")):
        with pytest.raises(Mine, match="of one's own"):
            work()


def test_library_within(small):
    @ms.method("nested", iterations=2)
    def nested(f, iterations):
        return ms.salient(f, iterations=iterations).values

    f = ms.mean_curvature(small)
    assert np.array_equal(nested(f).values, ms.salient(f, iterations=2).values)
    with ms.threads(3):
        ms.stability(small, methods=["nested"], noise=[0.1], trials=4)


def test_a_sweep_over_a_key_that_is_named_as_a_result(small):
    @ms.method("clamped", max=1.0)
    def clamped(f, max):
        return np.minimum(f.values, max)

    with pytest.raises(ms.ArgumentError, match="clamped|NAME.max"):
        ms.sweep(small, {"max": [0.5, 2.0]}, method="clamped")
    s = ms.sweep(small, {"clamped.max": [0.5, 2.0]}, method="clamped")
    assert [row["clamped.max"] for row in s] == ["0.5", "2.0"] and s[0]["max"] <= 0.5
