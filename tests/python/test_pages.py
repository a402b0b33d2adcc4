"""The pages of documentation: each block of Python on them, run from the top of the page on."""

import os
import pathlib
import re
import shutil

import numpy as np
import pytest
from conftest import sample
from matplotlib import pyplot
from test_molecule import pdb

import morsel as ms

SOURCES = pathlib.Path(os.environ["MORSEL_SOURCES"])


@pytest.mark.parametrize("page", ["docs/python.md", "README.md"])
@pytest.mark.filterwarnings("ignore::morsel.MorselWarning")
def test_page(page, tmp_path, monkeypatch, small):
    monkeypatch.chdir(tmp_path)
    shutil.copy(sample("lion-head.off"), "scan.off")
    ms.read("scan.off").save("scan.ply")
    pdb(pathlib.Path("1bp2.pdb"))
    import webbrowser
    monkeypatch.setattr(webbrowser, "open", lambda url: pathlib.Path(url.removeprefix("file://")).unlink())
    blocks = re.findall(r"^```python\n(.*?)^```", (SOURCES / page).read_text(), re.MULTILINE | re.DOTALL)
    assert blocks, page
    names = {"V": np.array(small.vertices), "F": np.array(small.faces, dtype=np.int64),
             "values": small.vertices[:, 2] ** 2}
    for number, block in enumerate(blocks):
        exec(compile(block, f"{page}, block {number + 1}", "exec"), names)
    pyplot.close("all")
