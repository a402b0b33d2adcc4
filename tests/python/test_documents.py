"""Reports and pages of meshes in memory and of given values, and checks of them."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V, PROGRAM, program, sample

import morsel as ms


@pytest.fixture
def in_memory(small):
    return ms.Mesh(small.vertices, small.faces)


def test_a_report_is_checked_by_the_program(tmp_path):
    r = ms.compare(ms.read(sample("eight.off")), methods=["conventional", "salient", "tps:count=salient"])
    r.save(tmp_path / "report.json")
    assert "unchanged" in program("check", tmp_path / "report.json")
    assert ms.check(tmp_path / "report.json") == []
    r.save(tmp_path / "short.json", items=False)
    assert "items" not in json.loads((tmp_path / "short.json").read_text())["methods"][0]
    assert "unchanged" in program("check", tmp_path / "short.json")


def test_a_mesh_in_memory_is_written_first(in_memory, tmp_path):
    r = ms.compare(in_memory)
    with pytest.raises(ms.ArgumentError, match="mesh="):
        r.save(tmp_path / "report.json")
    assert not (tmp_path / "report.json").exists()
    for name in ("mesh.off", "mesh.ply"):
        r.save(tmp_path / "report.json", mesh=tmp_path / name)
        assert "unchanged" in program("check", tmp_path / "report.json")
        assert np.array_equal(ms.read(tmp_path / name).vertices, in_memory.vertices)


def test_given_values_are_written_with_the_mesh(in_memory, tmp_path):
    f = ms.field(in_memory, in_memory.vertices @ [1, 2, 3], name="slope")
    r = ms.compare(f, methods=["conventional", "denoise:iterations=1", "salient:iterations=2"])
    with pytest.raises(ms.ArgumentError, match="ply"):
        r.save(tmp_path / "report.json", mesh=tmp_path / "mesh.off")
    r.save(tmp_path / "report.json", mesh=tmp_path / "mesh.ply")
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["request"]["field"] == "vertex-scalar:property=slope"
    assert "unchanged" in program("check", tmp_path / "report.json")
    from_file = ms.field(ms.read(sample("eight.off")), np.arange(in_memory.vertex_count))
    with pytest.raises(ms.ArgumentError, match="mesh="):
        ms.compare(from_file).save(tmp_path / "other.json")


def test_a_repaired_mesh_in_memory(tmp_path):
    fine = ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F).subdivided(3)
    v = np.concatenate([[[9, 9, 9]], fine.vertices])
    mesh = ms.Mesh(v, np.concatenate([fine.faces + 1, fine.faces[:1] + 1]), repair=True)
    r = ms.compare(ms.field(mesh, v[:, 2]), methods=["conventional"])
    r.save(tmp_path / "report.json", mesh=tmp_path / "mesh.ply")
    assert "unchanged" in program("check", tmp_path / "report.json")
    assert json.loads((tmp_path / "report.json").read_text())["methods"][0]["items"][0]["vertex"] < 38


def test_a_smoothed_field_is_taken_by_its_values(small, tmp_path):
    f = ms.salient(ms.mean_curvature(small), iterations=2)
    r = ms.compare(f, methods=["conventional"])
    assert np.array_equal(r.field.values, f.values)
    r.save(tmp_path / "report.json", mesh=tmp_path / "mesh.ply")
    assert "unchanged" in program("check", tmp_path / "report.json")
    flat = ms.tps(ms.mean_curvature(small), threshold="10%")
    with pytest.raises(ms.ArgumentError, match="order of its own"):
        ms.compare(flat)


def test_a_file_that_has_changed(tmp_path, small):
    path = tmp_path / "mesh.off"
    small.save(path)
    mesh = ms.read(path)
    r = ms.compare(mesh, methods=["conventional"])
    r.save(tmp_path / "report.json")
    small.with_vertices(small.vertices * 2).save(path)
    with pytest.raises(ms.InputError, match="changed"):
        r.save(tmp_path / "report.json")
    assert ms.check(tmp_path / "report.json")
    path.unlink()
    with pytest.raises(ms.InputError, match="missing"):
        ms.check(tmp_path / "report.json")


def test_another_working_folder(tmp_path, small, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sub").mkdir()
    small.save("mesh.off")
    r = ms.compare("mesh.off", methods=["conventional"])
    s = ms.segment(ms.mean_curvature("mesh.off"), segments=5)
    monkeypatch.chdir(tmp_path / "sub")
    r.save(tmp_path / "report.json")
    s.save("segments.json")
    assert json.loads((tmp_path / "report.json").read_text())["mesh"]["path"] == "mesh.off"
    assert "unchanged" in program("check", "report.json", cwd=tmp_path)
    with pytest.raises(ms.ArgumentError):
        r.save(tmp_path / "report.json", mesh=tmp_path / "mesh.off")
    (tmp_path / "mesh.off").unlink()
    with pytest.raises(ms.InputError, match="missing"):
        r.save(tmp_path / "report.json")


def test_pages(in_memory, tmp_path, monkeypatch):
    r = ms.compare(in_memory, methods=["conventional", "salient"])
    page = r.html()
    assert page.startswith("<!") and "morsel compare" in page
    assert "--html" not in page
    r.save(tmp_path / "page.html")
    kept = (tmp_path / "page.html").read_text()
    assert "morsel.provenance/1" in kept and f"--html {tmp_path}/page.html" in kept
    for ending in ("csv", "png", "htm", ""):
        with pytest.raises(ms.ArgumentError, match="json or .html"):
            r.save(tmp_path / f"page.{ending}")
    import webbrowser
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    path = r.show()
    shown = pathlib.Path(path).read_text()
    assert opened == ["file://" + path] and shown[:2] == "<!" and "--html" not in shown
    pathlib.Path(path).unlink()
    assert r._repr_html_().startswith("<pre>")


def test_show_in_a_notebook(in_memory, monkeypatch):
    class Shell:
        kernel = object()

    module = type(sys)("IPython")
    module.get_ipython = lambda: Shell()
    monkeypatch.setitem(sys.modules, "IPython", module)
    shown = ms.compare(in_memory, methods=["conventional"]).show(height=500)
    frame = shown._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and 'height="500"' in frame and "<!" not in frame[20:]


def test_exports(small, tmp_path):
    r = ms.compare(sample("eight.off"), methods=["salient:iterations=1", "salient"])
    r.export(tmp_path / "out", glb=True)
    names = sorted(path.name for path in (tmp_path / "out").iterdir() if path.name != ".morsel-results")
    assert names == sorted(f"{name}.{kind}" for name in ("salient", "salient-2")
                           for kind in ("surface.vtp", "complex.vtp", "nodes.vtp", "complex.graphml",
                                        "points.csv", "glb"))
    with pytest.raises(ms.Error):
        r.export(pathlib.Path(sample("eight.off")).parent)


def test_files_of_everything_else(in_memory, tmp_path):
    f = ms.salient(ms.mean_curvature(in_memory), iterations=3)
    made = {"segments": (ms.segment(f, segments=5), "json ply vtp txt glb"),
            "cut": (ms.cut(f), "json off ply vtp"),
            "points": (ms.points(f, 5), "json csv ply vtp glb"),
            "quads": (ms.quads(ms.eigenfunction(in_memory, index=8), resolution=4), "json obj")}
    for name, (result, endings) in made.items():
        for ending in endings.split():
            result.save(tmp_path / f"{name}.{ending}")
        with pytest.raises(ms.ArgumentError):
            result.save(tmp_path / f"{name}.xyz")
    document = json.loads((tmp_path / "segments.json").read_text())
    assert document["mesh"]["path"] == "(in memory)" and len(document["mesh"]["sha256"]) == 64
    made["segments"][0].save(tmp_path / "named.json", mesh=tmp_path / "mesh.off")
    assert json.loads((tmp_path / "named.json").read_text())["mesh"]["path"].endswith("mesh.off")
    info = subprocess.run([PROGRAM, "info", str(tmp_path / "segments.ply")], capture_output=True, text=True,
                          check=True).stdout
    assert "morsel segment" in info and "salient:iterations=3" in info


def test_fields_of_no_single_request(small, tmp_path):
    f = ms.mean_curvature(small)
    for made in (-f, ms.tps(ms.salient(f, iterations=1, target=20)), ms.field(small, np.zeros(len(f)),
                                                                             ranks=f.ranks)):
        with pytest.raises(ms.ArgumentError, match="no one command line"):
            ms.segment(made).save(tmp_path / "s.json")


@pytest.mark.parametrize("path", ["/proc/none/report.json", "/dev/null/report.json"])
def test_places_that_cannot_be_written(path):
    with pytest.raises(ms.WriteError):
        ms.compare(sample("eight.off"), methods=["conventional"]).save(path)


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"schema": "morsel.comparison/1"}', "{" * 5000])
def test_what_is_no_report(tmp_path, text):
    (tmp_path / "report.json").write_text(text)
    with pytest.raises(ms.InputError):
        ms.check(tmp_path / "report.json")


def test_what_was_read_is_not_replaced(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    original = pathlib.Path(sample("eight.off")).read_bytes()
    pathlib.Path("e.off").write_bytes(original)
    pathlib.Path("link.json").symlink_to("e.off")
    pathlib.Path("sub").mkdir()
    mesh = ms.read("e.off")
    f = ms.mean_curvature(mesh)
    r = ms.compare(mesh, methods=["conventional"])
    given = ms.field(mesh, np.array(f.values))
    for write in (lambda: r.save("e.off"), lambda: r.save("link.json"), lambda: r.save("other.off"),
                  lambda: r.save("r.json", mesh="e.off"), lambda: r.save("same.off", mesh="same.off"),
                  lambda: ms.cut(f).save("e.off"), lambda: ms.cut(f).save("sub/../e.off"),
                  lambda: mesh.save("e.off"), lambda: mesh.save(tmp_path / "e.off"),
                  lambda: ms.compare(given, methods=["conventional"]).save("r.json", mesh="r.json")):
        with pytest.raises(ms.ArgumentError):
            write()
        assert pathlib.Path("e.off").read_bytes() == original
    assert sorted(path.name for path in tmp_path.iterdir()) == ["e.off", "link.json", "sub"]
    np.savetxt("values.txt", f.values)
    read = ms.vertex_scalar(mesh, file="values.txt")
    before = pathlib.Path("values.txt").read_bytes()
    with pytest.raises(ms.ArgumentError):
        read.save("values.txt")
    assert pathlib.Path("values.txt").read_bytes() == before
