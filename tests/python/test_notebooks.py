"""The notebooks of examples/: each is run in a kernel from top to bottom, and shows what it is to show."""

import os
import pathlib

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

FOLDER = pathlib.Path(os.environ["MORSEL_SOURCES"]) / "examples" / "notebooks"
PICTURES = {"molecule": 1, "noise": 3, "own-method": 1, "paper": 3, "start": 3}
"""How many pictures each shows."""


def test_all_are_known():
    assert sorted(path.stem for path in FOLDER.glob("*.ipynb")) == sorted(PICTURES)


@pytest.mark.parametrize("name", list(PICTURES))
@pytest.mark.filterwarnings("default")  # of nbconvert and its kernels
def test_in_a_kernel(name, tmp_path, monkeypatch):
    """As in a browser: cells that show a page or a picture have these as outputs."""
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel's own shows pictures
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "notebooks are kept without outputs"
    ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": str(tmp_path)}})
    shown = [set(output["data"]) for cell in notebook.cells for output in cell.get("outputs", ())
             if "data" in output]
    assert sum("image/png" in data for data in shown) == PICTURES[name]
    if name == "start":
        assert "<iframe" in notebook.cells[-1].outputs[-1]["data"]["text/html"]
