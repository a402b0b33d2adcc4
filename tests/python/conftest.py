"""What the tests of the Python package share: meshes, the program, and that warnings do not pass unseen."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import morsel as ms

SAMPLES = pathlib.Path(os.environ["MORSEL_SAMPLES"])
PROGRAM = os.environ["MORSEL_PROGRAM"]

OCTAHEDRON_V = np.array([[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], float)
OCTAHEDRON_F = np.array([[0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 2], [1, 3, 2], [1, 4, 3], [1, 5, 4],
                         [1, 2, 5]])


def pytest_configure(config):
    """What Python warns of is an error, but for what the library tells of meshes."""
    config.addinivalue_line("filterwarnings", "error")
    config.addinivalue_line("filterwarnings", "default::morsel.MorselWarning")


def sample(name):
    """The path of a sample mesh; a test does not pass by skipping."""
    path = SAMPLES / name
    assert path.is_file(), f"the sample {path} is missing"
    return str(path)


def program(*arguments, code=0, cwd=None):
    """Runs morsel; what it prints."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=cwd,
                         timeout=500,
                         check=False)
    assert run.returncode == code, run.stderr
    return run.stdout


def without_timings(path):
    """A document but for what may differ between two runs."""
    document = json.loads(pathlib.Path(path).read_text())
    document.pop("timings")
    return document


@pytest.fixture
def octahedron():
    """A closed mesh of 6 vertices."""
    return ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F)


@pytest.fixture(scope="session")
def lion():
    """8,356 vertices, one boundary loop."""
    return ms.read(sample("lion-head.off"))


@pytest.fixture(scope="session")
def curvature(lion):
    """Its mean curvature."""
    return ms.mean_curvature(lion)


@pytest.fixture(scope="session")
def small():
    """A closed mesh of a few hundred vertices and genus 1 or more."""
    return ms.read(sample("eight.off"))


@pytest.fixture(scope="session")
def smooth(curvature):
    """The lion's curvature after salient smoothing: 97 critical points."""
    return ms.salient(curvature, iterations=10)
