"""The notebooks of examples/: each is run from top to bottom, and draws what it is to draw."""

import json
import os
import pathlib

import pytest

import morsel as ms  # noqa: F401

pyplot = pytest.importorskip("matplotlib.pyplot")
pytest.importorskip("pandas")

FOLDER = pathlib.Path(os.environ["MORSEL_SOURCES"]) / "examples" / "notebooks"
PICTURES = {"molecule": 1, "noise": 3, "own-method": 1, "paper": 3, "start": 3}
"""How many figures each leaves."""


def notebooks():
    return sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def test_all_are_known():
    assert notebooks() == sorted(PICTURES)


@pytest.mark.parametrize("name", notebooks())
@pytest.mark.filterwarnings("ignore::morsel.MorselWarning")
def test_cells(name, tmp_path, monkeypatch):
    import webbrowser
    monkeypatch.setattr(webbrowser, "open", lambda url: pathlib.Path(url.removeprefix("file://")).unlink())
    monkeypatch.chdir(tmp_path)
    names = {"__name__": name}
    for number, cell in enumerate(json.loads((FOLDER / f"{name}.ipynb").read_text())["cells"]):
        assert not cell.get("outputs"), "notebooks are kept without outputs"
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{name}.ipynb, cell {number + 1}", "exec"), names)
    assert len(pyplot.get_fignums()) == PICTURES[name]
    for figure in map(pyplot.figure, pyplot.get_fignums()):
        figure.savefig(tmp_path / f"{figure.number}.png")
    pyplot.close("all")


@pytest.mark.filterwarnings("default")
def test_in_a_kernel(tmp_path, monkeypatch):
    """By nbconvert, as in a browser: cells that show a page or a picture have these as outputs."""
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel's own shows pictures
    nbformat = pytest.importorskip("nbformat")
    execute = pytest.importorskip("nbconvert.preprocessors").ExecutePreprocessor
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(FOLDER / "start.ipynb", as_version=4)
    execute(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(tmp_path)}})
    shown = [set(output["data"]) for cell in notebook.cells for output in cell.get("outputs", ())
             if "data" in output]
    assert sum("image/png" in data for data in shown) == 3
    assert "<iframe" in notebook.cells[-1].outputs[-1]["data"]["text/html"]
