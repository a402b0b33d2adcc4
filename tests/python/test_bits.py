"""The same bits as the program's for the same request."""

import numpy as np
import pytest
from conftest import program, sample, without_timings

import morsel as ms

MESHES = ["lion-head.off", "eight.off", "sphere966.off", "cow.off", "knot1.off", "head.off", "nefertiti.off",
          "plane.off", "elephant-with-holes.off", "part.off"]
METHODS = ["conventional", "denoise:iterations=1", "fair", "gaussian", "laplacian",
           "laplacian:scheme=implicit,weights=cotangent,iterations=2", "saliency", "salient",
           "salient:preset=robust,iterations=2", "salient:precision=single,range=local", "spectral:modes=6",
           "tps",
           "salient:iterations=3+tps:count=20", "gaussian:iterations=2",
           "tps:count=gaussian\\:iterations\\=2"]
FUNCTIONS = {
    "curvedness": {}, "eigenfunction": {"index": 3}, "gaussian-curvature": {}, "geodesic": {"source": [0, 7]},
    "heat-kernel-signature": {}, "height": {"direction": "1/2/3"}, "mean-curvature": {"estimator": "quadric"},
    "principal-curvature": {"which": "min"}, "shape-index": {"scale": "1.5edges"},
    "vertex-scalar": {"file": "values.txt"}, "wave-kernel-signature": {}}

pytestmark = pytest.mark.filterwarnings("ignore::morsel.MorselWarning")


@pytest.mark.parametrize("name", MESHES)
def test_reports(name, tmp_path):
    words = [word for method in METHODS for word in ("--method", method)]
    path = sample(name)
    program("compare", path, *words, "-o", tmp_path / "program.json")
    ms.compare(ms.read(path), methods=METHODS).save(tmp_path / "python.json")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")


@pytest.mark.parametrize("name", list(FUNCTIONS))
def test_fields(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = sample("eight.off")
    mesh = ms.read(path)
    np.savetxt("values.txt", mesh.vertices[:, 1])
    function = getattr(ms, name.replace("-", "_"))
    keys = FUNCTIONS[name]
    program("field", path, "--field", function.spec(**keys), "--method", "conventional", "-o", "program.txt",
            cwd=tmp_path)
    function(mesh, **keys).save("python.txt")
    assert (tmp_path / "program.txt").read_bytes() == (tmp_path / "python.txt").read_bytes()


def test_every_function_and_method_is_compared():
    assert set(FUNCTIONS) | {"atomic-density"} == set(ms.functions())
    assert {method.split(":")[0].split("+")[0] for method in METHODS} == set(ms.methods())


def without_seconds(table):
    """The words of a comparison's table, but for its last column."""
    lines = [line.split() for line in table.splitlines()]
    heading = next(i for i, words in enumerate(lines) if words[-1:] == ["seconds"])
    return [words[:-1] if heading <= i < heading + 4 else words for i, words in enumerate(lines)]


def test_targets_and_snapping(tmp_path):
    path = sample("lion-head.off")
    program("compare", path, "--field", "height:axis=x", "--method", "salient", "--method", "saliency",
            "--target",
            "40", "--snap", "-o", tmp_path / "program.json")
    r = ms.compare(ms.read(path), field="height:axis=x", methods=["salient", ms.saliency], target=40,
                   snap=True)
    r.save(tmp_path / "python.json")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")
    assert without_seconds(r.table()) == without_seconds(program(
        "compare", path, "--field", "height:axis=x", "--method", "salient", "--method", "saliency",
        "--target", "40", "--snap"))


# With all options that Python writes into files, in its order: then their bytes are the same.
DOCUMENTS = {
    "segment": (lambda f: ms.segment(f, by="ascending", segments=9),
                ("--by", "ascending", "--segments", "9"), ".json", ("ply", "vtp")),
    "points": (lambda f: ms.points(f, 12, kind="all", fill="height"),
               ("--points", "12", "--kind", "all", "--rank", "persistence", "--spacing", "5%", "--fill",
                "height"), "", ("json", "csv", "ply", "vtp")),
    "cut": (lambda f: ms.cut(f), (), ".json", ("off", "ply")),
    "quads": (lambda f: ms.quads(f, persistence="2%", resolution=4),
              ("--resolution", "4", "--relaxation", "2", "--persistence", "2%"),
              ".json", ("obj",))}


@pytest.mark.parametrize("command", list(DOCUMENTS))
def test_documents(command, tmp_path):
    make, words, json, endings = DOCUMENTS[command]
    path = sample("eight.off")
    field = ("--field", "mean-curvature", "--method", "salient:iterations=4")
    made = make(ms.salient(ms.mean_curvature(ms.read(path)), iterations=4))
    for ending in endings:
        program(command, path, *field, *words, "-o", tmp_path / f"program.{ending}")
        made.save(tmp_path / f"python.{ending}")
        if ending == "json":
            assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")
        else:
            a, b = ((tmp_path / f"{who}.{ending}").read_bytes() for who in ("program", "python"))
            assert a == b
    if json:
        program(command, path, *field, *words, "-o", tmp_path / f"other.{endings[0]}", "--json",
                tmp_path / "program.json")
        made.save(tmp_path / "python.json")
        assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")


def test_exports_of_hierarchies(tmp_path):
    path = sample("eight.off")
    words = ["--by", "persistence", "--counts", "60,20"]
    program("hierarchy", path, "--field", "mean-curvature", "--method", "conventional", *words,
            "--export", tmp_path / "program")
    ms.hierarchy(ms.mean_curvature(ms.read(path))).levels(counts=[60, 20]).export(tmp_path / "python")
    names = sorted(made.name for made in (tmp_path / "program").glob("*.vtp"))
    assert names == ["complex.0.vtp", "complex.1.vtp", "surface.0.vtp", "surface.1.vtp"]
    for name in names:
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes()


def test_hierarchies(tmp_path):
    path = sample("eight.off")
    f = ms.mean_curvature(ms.read(path))
    program("hierarchy", path, "--levels", "1,3", "-o", tmp_path / "program.json")
    ms.hierarchy(f, by="iteration", levels=[1, 3]).save(tmp_path / "python.json")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")
    program("hierarchy", path, "--by", "persistence", "--counts", "60,20", "-o", tmp_path / "program.json")
    ms.hierarchy(f).levels(counts=[60, 20]).save(tmp_path / "python.json")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")


def test_sweeps_and_stability(tmp_path):
    path = sample("eight.off")
    mesh = ms.read(path)
    program("sweep", path, "--vary", "iterations=1..3", "--vary", "sigma=4eps,8eps", "-o",
            tmp_path / "a.json")
    s = ms.sweep(mesh, {"iterations": range(1, 4), "sigma": ["4eps", "8eps"]})
    s.save(tmp_path / "b.json")
    a, b = without_timings(tmp_path / "a.json"), without_timings(tmp_path / "b.json")
    a["request"].pop("vary"), b["request"].pop("vary")
    assert a == b and len(s) == 6
    words = ["--noise", "0.1,0.3", "--decimate", "0.5", "--trials", "2", "--seed", "7", "--target", "20"]
    program("stability", path, *words, "-o", tmp_path / "a.json")
    program("stability", path, *words, "-o", tmp_path / "a.csv")
    t = ms.stability(mesh, noise=[0.1, 0.3], decimate=[0.5], trials=2, seed=7, target=20)
    t.save(tmp_path / "b.json")
    t.save(tmp_path / "b.csv")
    assert without_timings(tmp_path / "a.json") == without_timings(tmp_path / "b.json")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_chosen_points_of_a_comparison(tmp_path):
    path = sample("eight.off")
    words = ["--method", "conventional", "--method", "salient", "--points", "9", "--rank", "salience",
             "--fill", "height", "--percentiles"]
    program("compare", path, *words, "-o", tmp_path / "program.json")
    r = ms.compare(ms.read(path), methods=["conventional", "salient"],
                   points={"count": 9, "rank": "salience", "fill": "height", "percentiles": True})
    r.save(tmp_path / "python.json")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")
    assert ms.check(tmp_path / "python.json") == []
    program("points", path, "--field", "mean-curvature", "--method", "salient", *words[4:],
            "-o", tmp_path / "program.csv")
    r["salient"].chosen.save(tmp_path / "python.csv")
    rows = [[line for line in (tmp_path / f"{who}.csv").read_text().splitlines() if not line.startswith("#")]
            for who in ("program", "python")]
    assert rows[0] == rows[1] and len(rows[0]) == 10


def test_landmarks(tmp_path):
    marked = tmp_path / "marked.txt"
    lines = []
    for name, step in (("eight.off", 40), ("sphere966.off", 90)):
        count = ms.read(sample(name)).vertex_count
        (tmp_path / f"{name}.txt").write_text(" ".join(map(str, range(1, count, step))))
        lines.append(f"{sample(name)},{name}.txt")
    marked.write_text("\n".join(lines))
    words = ["--method", "conventional", "--method", "salient", "--points", "15", "--fill", "mean-curvature",
             "--first", "1", "--seed", "4"]
    program("landmarks", marked, *words, "-o", tmp_path / "program.json")
    program("landmarks", marked, *words, "-o", tmp_path / "program.csv")
    found = ms.landmarks(marked, methods=["conventional", "salient"], points=15, fill="mean-curvature",
                         first=1, seed=4)
    found.save(tmp_path / "python.json")
    found.save(tmp_path / "python.csv")
    assert without_timings(tmp_path / "program.json") == without_timings(tmp_path / "python.json")
    assert (tmp_path / "program.csv").read_bytes() == (tmp_path / "python.csv").read_bytes()
    assert ms.check(tmp_path / "python.json") == []
    with pytest.raises(ms.ArgumentError):
        found.save(tmp_path / "python.txt")


def test_any_number_of_threads(lion):
    values = []
    for count in (1, 3):
        with ms.threads(count):
            r = ms.compare(lion, methods=["salient", "tps"])
            values.append([row.field.values.tobytes() + row.complex.polylines[0].tobytes() for row in r])
    assert values[0] == values[1]
