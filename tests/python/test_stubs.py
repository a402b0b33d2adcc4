"""What type checkers see."""

import os
import pathlib
import subprocess
import sys

import pytest

SOURCES = pathlib.Path(os.environ["MORSEL_SOURCES"])
PACKAGE = SOURCES / "python" / "morsel"

USE = """
import numpy as np
import morsel as ms

mesh = ms.Mesh(np.zeros((3, 3)), [[0, 1, 2]])
f = ms.mean_curvature(mesh, estimator="quadric")
g: ms.Field = ms.salient(f, iterations=10, sigma="8eps", target=5)
spec: str = ms.salient.spec(iterations=3)
k: int = ms.critical_points(g).counts.total
r = ms.compare(mesh, methods=["salient", ms.tps])
row: ms.Row = r["salient"]
with ms.threads(2):
    ms.segment(g, by="ascending", segments=3).save("a.json")

@ms.method("mine", strength=1.0)
def mine(f: ms.Field, strength: float) -> object:
    return f.values ** strength

mine(f, strength=2.0)
reveal_type(ms.persistence(g).birth_death)
"""

WRONG = {
    "ms.salient(f, iterations='many')": "arg-type",
    "ms.salient(mesh)": "arg-type",
    "ms.salient(f, sgima=1)": "call-arg",
    "ms.mean_curvature(mesh).valeus": "attr-defined",
    "x: str = ms.critical_points(f).vertex": "assignment"}


def mypy(*arguments, folder):
    run = subprocess.run([sys.executable, "-m", "mypy", "--no-error-summary", "--show-error-codes",
                          "--ignore-missing-imports",  # matplotlib and others that have no types
                          f"--cache-dir={folder}/cache", *arguments], capture_output=True, text=True,
                          check=False,
                         cwd=folder, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})
    return run.stdout + run.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("types")


def test_the_package_is_typed(folder):
    assert mypy("--strict", "-p", "morsel", folder=folder) == ""
    assert (PACKAGE / "py.typed").is_file()


def test_use_is_typed(folder):
    (folder / "use.py").write_text(USE)
    shown = mypy("use.py", folder=folder)
    assert shown.count("\n") == 1 and "floating" in shown, shown


@pytest.mark.parametrize("line", list(WRONG))
def test_wrong_use_is_seen(folder, line):
    (folder / "wrong.py").write_text(USE.replace("reveal_type(ms.persistence(g).birth_death)", line))
    shown = mypy("wrong.py", folder=folder)
    assert f"[{WRONG[line]}]" in shown, shown


def test_the_stub_is_that_of_the_library():
    run = subprocess.run([sys.executable, str(SOURCES / "python" / "make_stub")], capture_output=True,
                         text=True,
                         check=True)
    assert (PACKAGE / "_shipped.pyi").read_text() == run.stdout


def test_stubs_of_the_extensions_have_what_these_have():
    import ast

    import morsel._documents
    import morsel._library
    import morsel._molecule

    for module in (morsel._library, morsel._documents, morsel._molecule):
        tree = ast.parse((PACKAGE / (module.__name__.split(".")[1] + ".pyi")).read_text())
        stub = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        names = {name for name in dir(module) if not name.startswith("_")}
        values = {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
        assert names == set(stub) | values, names ^ (set(stub) | values)
        for name, node in stub.items():
            if isinstance(node, ast.ClassDef):
                members = {inner.name for inner in node.body if isinstance(inner, ast.FunctionDef)}
                own = {member for member, value in vars(getattr(module, name)).items()
                       if not member.startswith("_") or member == "__len__"}
                assert members - {"__init__"} == own, (name, members ^ own)


def test_everything_public_is_documented():
    import inspect

    import morsel as ms

    for name in ms.__all__:
        thing = getattr(ms, name)
        if inspect.isfunction(thing) or inspect.isclass(thing):
            assert thing.__doc__ and len(thing.__doc__) > 20, name
        if inspect.isclass(thing) and thing.__module__.startswith("morsel"):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    assert value.__doc__, f"{name}.{member}"
