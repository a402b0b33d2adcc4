"""The examples of the docstrings, by doctest: all run, and those that show a result have it."""

import doctest
import pathlib
import types

import numpy as np
import pytest
from conftest import sample
from test_molecule import pdb

import morsel as ms


class Checker(doctest.OutputChecker):
    """What an example without a result gives is not looked at."""

    def check_output(self, want, got, optionflags):
        return want == "" or super().check_output(want, got, optionflags)


def examples():
    """All that can be imported; parts of classes come with these."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    tests = [doctest.DocTestParser().get_doctest(ms.__doc__, {}, "morsel", None, None)]
    for name in ms.__all__:
        if isinstance(getattr(ms, name), (type, types.FunctionType)):
            tests += finder.find(getattr(ms, name), name, module=False)
    return [test for test in tests if test.examples]


EXAMPLES = examples()


@pytest.fixture
def names(small, tmp_path, monkeypatch):
    """What examples find, as the text around them says."""
    monkeypatch.chdir(tmp_path)
    small.save("scan.ply")
    pdb(pathlib.Path("1bp2.pdb"))
    mesh, f = ms.Mesh(small.V, small.F), ms.mean_curvature(small)
    np.savetxt("values.txt", f.values)
    p = ms.critical_points(f)
    as_stl = types.SimpleNamespace(vertices=small.V, faces=small.F)
    return {
        "ms": ms, "np": np, "V": np.array(small.V), "F": np.array(small.F), "mesh": mesh, "f": f, "p": p,
        "other": ms.persistence(f), "marks": p.vertex[:9], "strength": 1.0,
        "surface": ms.molecule("1bp2.pdb"), "r": ms.compare(ms.read(sample("eight.off"))),
        "trimesh": types.SimpleNamespace(load=lambda path: as_stl),  # neither is in Debian's Python
        "gudhi": types.SimpleNamespace(bottleneck_distance=lambda a, b: 0.0)}


@pytest.mark.parametrize("example", EXAMPLES, ids=[test.name for test in EXAMPLES])
@pytest.mark.filterwarnings("ignore::morsel.MorselWarning")
def test_example(example, names):
    example.globs = names
    said = []
    runner = doctest.DocTestRunner(Checker(), verbose=False, optionflags=doctest.ELLIPSIS)
    failed = runner.run(example, out=said.append).failed
    assert failed == 0, "".join(said)


def test_everything_that_computes_has_an_example():
    functions = {name for name in ms.__all__ if isinstance(getattr(ms, name), types.FunctionType)}
    assert functions <= {test.name for test in EXAMPLES}
