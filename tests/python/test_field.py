"""Fields: of values, by methods, chains, targets and iterations."""

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V, program, sample

import morsel as ms


def test_values_and_order(octahedron):
    f = ms.field(octahedron, [9, -9, 1, 2, 2, 4])
    assert f.values.tolist() == [9, -9, 1, 2, 2, 4] and len(f) == 6
    assert f.order.tolist() == [1, 2, 3, 4, 5, 0] and f.ranks.tolist() == [5, 0, 1, 2, 3, 4]
    assert (f.min, f.max, f.extent) == (-9, 9, 18)
    assert np.array_equal(np.asarray(f), f.values) and np.asarray(f, np.float32).dtype == np.float32
    assert (f.function, f.method, f.steps, f.target) == ("", "", [], None)
    for made in (f.input, f.input.input, ms.height(octahedron).input, ms.salient(f, iterations=1).input):
        assert made.method == "" and made.steps == [] and len(made.values) == 6
    assert np.array_equal(ms.salient(f, iterations=1).input.values, f.values)
    assert np.array_equal((-f).values, -f.values) and (-f).order.tolist() == f.order[::-1].tolist()
    with pytest.raises(ValueError):
        f.values[0] = 1
    with pytest.raises(TypeError):
        ms.Field()


def test_an_order_of_ones_own(octahedron):
    f = ms.field(octahedron, np.zeros(6), ranks=[5, 4, 3, 2, 1, 0])
    assert f.order.tolist() == [5, 4, 3, 2, 1, 0]
    for ranks in ([0, 0, 1, 2, 3, 4], [0, 1], [0, 1, 2, 3, 4, 6]):
        with pytest.raises(ValueError):
            ms.field(octahedron, np.zeros(6), ranks=ranks)
    with pytest.raises(ValueError):
        ms.field(octahedron, np.arange(6), ranks=[5, 4, 3, 2, 1, 0])


@pytest.mark.parametrize("values, says", [
    (np.zeros(5), "5 values, but 6 vertices"),
    (np.zeros((6, 1)), "(n,)"),
    (np.zeros((2, 3)), "(n,)"),
    (np.float64(3), "(n,)"),
    (np.zeros(6, complex), "real"),
    (np.zeros(6, bool), "real"),
    (np.zeros(6).astype(str), "real"),
    (np.array([1, 2, 3, 4, 5, None]), "objects"),
    (np.array([1, 2, np.nan, 4, 5, 6]), "2"),
    (np.array([1, 2, 3, np.inf, 5, 6]), "3"),
    (np.ma.masked_array(np.zeros(6)), "masked"),
])
def test_odd_values_are_value_errors(octahedron, values, says):
    with pytest.raises(ValueError) as caught:
        ms.field(octahedron, values)
    assert says in str(caught.value)


def test_values_of_a_repaired_mesh():
    v = np.concatenate([[[9, 9, 9]], OCTAHEDRON_V])
    mesh = ms.Mesh(v, OCTAHEDRON_F + 1, repair=True)
    of_input = ms.field(mesh, v[:, 2])
    assert np.array_equal(of_input.values, ms.height(mesh).values)
    assert np.array_equal(ms.field(mesh, mesh.vertices[:, 2]).values, of_input.values)
    with pytest.raises(ms.ArgumentError):
        ms.field(mesh, v[:, 2], numbering="other")
    with pytest.raises(ValueError, match="7 vertices"):
        ms.field(mesh, mesh.vertices[:, 2], numbering="input")


def test_a_field_by_its_text(lion, curvature):
    assert np.array_equal(ms.field(lion, "mean-curvature").values, curvature.values)
    assert ms.field(lion, "height:axis=x").function == "height:axis=x"
    with pytest.raises(TypeError):
        ms.field(lion, "height", ranks=[0])


def test_methods_step_by_step_are_the_chain(curvature):
    chain = curvature.apply("salient:iterations=5+tps:count=100")
    steps = ms.tps(ms.salient(curvature, iterations=5), count=100)
    assert np.array_equal(chain.values, steps.values) and np.array_equal(chain.ranks, steps.ranks)
    assert chain.method == steps.method == "salient:iterations=5+tps:count=100"
    assert [step.name for step in steps.steps] == ["salient", "tps"]
    assert steps.steps[0].parameters["sigma"] == pytest.approx(curvature.mesh.length("8eps"))
    assert steps.steps[0].details["iterations_run"] == 5
    assert steps.steps[0].end == (5, "iterations") and steps.steps[1].end is None
    assert steps.steps[0].sigma == steps.steps[0].parameters["sigma"] and steps.steps[1].sigma is None
    assert np.array_equal(steps.input.values, curvature.values) and steps.input.method == ""
    assert steps.function == curvature.function == "mean-curvature"
    assert ms.critical_points(steps).counts.total == 100 - ms.critical_points(steps).counts.total % 2


def test_reference_figures(curvature, smooth):
    assert ms.critical_points(curvature).counts == (462, 934, 960, 499, 1895)
    assert ms.critical_points(smooth).counts.total == 97


def test_targets(curvature):
    f = curvature.apply("salient:iterations=5+tps:count=150", target=150)
    assert ms.critical_points(f).counts.total == f.target.reached
    g = ms.salient(curvature, target=100)
    assert (g.target.wanted, g.target.reached) == (100, ms.critical_points(g).counts.total)
    assert g.target.before_cancelling >= 100 and len(g.target.cancelled) > 0
    assert g.target.largest_cancelled == g.target.cancelled["death"][-1] - g.target.cancelled["birth"][-1]


def test_counts_of_iterations(curvature):
    f = ms.salient(curvature, iterations=3, count_iterations=True)
    records = f.steps[-1].iterations
    assert records["iteration"].tolist() == [0, 1, 2, 3] and records["minima"][0] == 462
    totals = records["minima"] + records["saddles"] + records["maxima"]
    assert totals[0] == 1895 and totals[-1] == ms.critical_points(f).counts.total
    assert len(ms.salient(curvature, iterations=3).steps[-1].iterations) == 0


def test_on_iteration(curvature):
    seen = []

    def each(number, f):
        seen.append((number, f.values[0]))
        assert f.mesh == curvature.mesh
        return number < 2

    f = ms.salient(curvature, iterations=9, on_iteration=each)
    assert [number for number, _ in seen] == [0, 1, 2]
    assert seen[0][1] == curvature.values[0] and seen[-1][1] == f.values[0]
    assert np.array_equal(f.values, ms.salient(curvature, iterations=2).values)


def test_on_iteration_ends_at_the_input(curvature, tmp_path):
    seen = []

    def end(number, f):
        seen.append(number)
        return False

    f = ms.salient(curvature, iterations=5, on_iteration=end)
    assert seen == [0] and f.steps[-1].end == (0, "caller")
    assert np.array_equal(f.values, curvature.values) and np.array_equal(f.ranks, curvature.ranks)
    g = ms.salient(curvature, iterations=5, target=100, on_iteration=lambda number, _: number > 9)
    assert g.target.iterations == 0 and g.target.before_cancelling == 1895
    assert g.target.reached == ms.critical_points(g).counts.total
    assert np.array_equal(g.values, ms.tps(curvature, count=100).values)
    f.save(tmp_path / "f.txt")
    with pytest.raises(ms.ArgumentError, match="on_iteration"):
        ms.segment(f).save(tmp_path / "f.json")


def test_a_field_for_values_is_taken_whole(curvature):
    simple = ms.tps(curvature, threshold="5%")
    whole = ms.field(curvature.mesh, simple)
    assert np.array_equal(whole.values, simple.values) and np.array_equal(whole.ranks, simple.ranks)
    assert ms.critical_points(whole).counts == ms.critical_points(simple).counts
    other = curvature.mesh.with_vertices(2 * curvature.mesh.vertices)
    with pytest.raises(ValueError, match="another mesh"):
        ms.field(other, simple)
    assert ms.field(other, simple.values).mesh == other
    for options in ({"name": "other"}, {"numbering": "mesh"}, {"ranks": simple.ranks}):
        with pytest.raises(TypeError):
            ms.field(curvature.mesh, simple, **options)


def test_methods_that_evaluate_the_function_again(octahedron):
    mesh = octahedron.subdivided(6)
    values = ms.field(mesh, mesh.vertices[:, 2])
    assert np.array_equal(ms.denoise(values, iterations=1).values, values.values)
    height = ms.height(mesh)
    assert not np.array_equal(ms.denoise(height, iterations=1, kind="laplacian").values, height.values)
    with pytest.raises(ms.ArgumentError, match="denoise evaluates the Morse function again"):
        ms.denoise(ms.gaussian(height, iterations=1))


def test_warnings_are_python_warnings():
    mesh = ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F)
    with pytest.warns(ms.MorselWarning, match="constant") as caught:
        f = ms.height(mesh.with_vertices(mesh.vertices * [1, 1, 0]))
    assert caught[0].filename == __file__ and "constant" in f.warnings[0]


def test_saving(tmp_path, lion, curvature):
    curvature.save(tmp_path / "f.txt")
    lines = [line for line in (tmp_path / "f.txt").read_text().splitlines() if not line.startswith("#")]
    assert np.array_equal(np.array(lines, float), curvature.values)
    curvature.save(tmp_path / "f.ply")
    again = ms.read(tmp_path / "f.ply")
    assert np.array_equal(ms.vertex_scalar(again, property="mean-curvature").values, curvature.values)
    with pytest.raises(ms.ArgumentError):
        curvature.save(tmp_path / "f.xyz")
    given = ms.field(ms.Mesh(lion.vertices, lion.faces), curvature.values)
    given.save(tmp_path / "g.ply")
    assert np.array_equal(ms.vertex_scalar(tmp_path / "g.ply", property="vertex-scalar").values,
                          curvature.values)


def test_fields_that_no_request_makes_are_saved(tmp_path, curvature):
    aimed = ms.salient(curvature, iterations=2, target=500)
    for name, f in {"negated": -curvature, "after": ms.gaussian(aimed, iterations=1),
                    "ordered": ms.field(curvature.mesh, curvature.values, ranks=curvature.ranks)}.items():
        f.save(tmp_path / f"{name}.ply")
        held = ms.read(tmp_path / f"{name}.ply")
        assert any(np.array_equal(values, f.values) for values in held.properties.values())
        assert "made by" in program("info", tmp_path / f"{name}.ply")
        ms.segment(f).save(tmp_path / "labels.ply")
        ms.points(f, 5).save(tmp_path / "points.csv")
        with pytest.raises(ms.ArgumentError, match="no one command line"):
            ms.segment(f).save(tmp_path / "segments.json")
        assert not (tmp_path / "segments.json").exists()


def test_a_file_of_values(lion, tmp_path):
    np.savetxt(tmp_path / "v.txt", lion.vertices[:, 0])
    assert np.array_equal(ms.vertex_scalar(lion, file=tmp_path / "v.txt").values, lion.vertices[:, 0])
    assert sample("lion-head.off") == lion.path
