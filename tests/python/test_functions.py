"""Morse functions and methods as Python functions: their signatures follow from the library's tables."""

import inspect

import numpy as np
import pytest
from conftest import program

import morsel as ms
from morsel import _library
from morsel._functions import parameters_of, python_name

REGISTRY = _library.Registry()
ENTRIES = [(row, "function") for row in REGISTRY.functions()] + [(row, "method")
                                                                 for row in REGISTRY.methods()]


def test_every_name_of_the_program_is_a_function():
    for command in ("fields", "methods"):
        names = [line.split()[0] for line in program(command).splitlines()]
        assert len(names) >= 9
        for name in names:
            assert callable(getattr(ms, python_name(name))) and python_name(name) in ms.__all__
    assert set(ms.functions()) == {row[0] for row in REGISTRY.functions()}
    assert set(ms.methods()) == {row[0] for row in REGISTRY.methods()}


@pytest.mark.parametrize("entry, kind", ENTRIES, ids=[row[0] for row, _ in ENTRIES])
def test_signature_and_documentation(entry, kind):
    name, summary, rows = entry
    function = getattr(ms, python_name(name))
    signature = inspect.signature(function)
    first = list(signature.parameters)[0]
    assert first == ("mesh" if kind == "function" else "f")
    for argument, parameter in parameters_of(rows).items():
        shown = signature.parameters[argument]
        assert shown.kind is inspect.Parameter.KEYWORD_ONLY and shown.default == parameter.value
        assert f"{argument} : " in function.__doc__ and parameter.description in function.__doc__
    assert summary[1:] in function.__doc__ and function.__name__ == python_name(name)
    assert function.__module__ == "morsel" and function.name == name


def test_defaults_have_the_types_of_their_values():
    salient = inspect.signature(ms.salient).parameters
    assert salient["iterations"].default == 10 and salient["sigma"].default == "8eps"
    assert salient["until_count"].default is None and salient["support"].default == 2.0
    assert inspect.signature(ms.laplacian).parameters["lambda_"].default == 0.5
    assert inspect.signature(ms.geodesic).parameters["delaunay"].default is True
    assert inspect.signature(ms.gaussian).parameters["weights"].default == "none"


def test_defaults_given_or_not_are_the_same(curvature):
    plain = ms.gaussian(curvature)
    given = ms.gaussian(curvature, iterations=1, sigma="8eps", support=2, weights="none", ball="euclidean")
    assert np.array_equal(plain.values, given.values)
    assert given.method == "gaussian:iterations=1,sigma=8eps,support=2,weights=none,ball=euclidean"
    assert np.array_equal(ms.gaussian(curvature, sigma=None).values, plain.values)


def test_values_of_every_kind(octahedron, curvature):
    assert ms.height.spec(axis="x") == "height:axis=x"
    assert ms.height.spec(direction=[1, 2.5, -3]) == "height:direction=1/2.5/-3"
    assert ms.height.spec(direction="1/2/3") == "height:direction=1/2/3"
    assert ms.geodesic.spec(source=[0, 5], delaunay=False) == "geodesic:source=0/5,delaunay=no"
    assert ms.vertex_scalar.spec(property="a,b:c") == "vertex-scalar:property=a\\,b\\:c"
    assert ms.salient.spec(iterations=np.int64(5), sigma=np.float32(0.5), until_count=None) == (
        "salient:iterations=5,sigma=0.5")
    assert ms.laplacian.spec(lambda_=0.25) == "laplacian:lambda=0.25"
    assert ms.salient.spec(iterations=5.0) == "salient:iterations=5"
    assert ms.salient.spec() == "salient"
    x, y, z = octahedron.vertices.T
    assert np.array_equal(ms.height(octahedron).values, z)
    assert np.array_equal(ms.height(octahedron, axis="x").values, x)
    assert np.allclose(ms.height(octahedron, direction=[0, 2, 0]).values, y)
    assert ms.salient(curvature, sigma=1e-7, iterations=1).steps[0].parameters["sigma"] == 1e-7


@pytest.mark.parametrize("call, error, says", [
    (lambda f: ms.salient(f, sgima=1), TypeError, "sgima"),
    (lambda f: ms.salient(f, 10), TypeError, "positional"),
    (lambda f: ms.salient(), TypeError, "f"),
    (lambda f: ms.salient(f.mesh), TypeError, "takes a Field"),
    (lambda f: ms.salient(f, iterations=2.5), ms.ArgumentError, "whole number"),
    (lambda f: ms.salient(f, iterations=-1), ms.ArgumentError, "between"),
    (lambda f: ms.salient(f, iterations=True), TypeError, "iterations"),
    (lambda f: ms.salient(f, sigma="8miles"), ms.ArgumentError, "length"),
    (lambda f: ms.salient(f, sigma=0), ms.ArgumentError, "above 0"),
    (lambda f: ms.salient(f, sigma=np.nan), ms.ArgumentError, "nan"),
    (lambda f: ms.salient(f, sigma=object()), TypeError, "sigma"),
    (lambda f: ms.salient(f, classify="both"), ms.ArgumentError, "smoothed or saliency"),
    (lambda f: ms.salient(f, target=0), ms.ArgumentError, "target"),
    (lambda f: ms.height(f.mesh, axis="w"), ms.ArgumentError, "x, y or z"),
    (lambda f: ms.height(3), TypeError, "not a mesh"),
    (lambda f: ms.vertex_scalar(f.mesh), ms.ArgumentError, "file"),
    (lambda f: ms.vertex_scalar(f.mesh, file="missing.txt"), ms.InputError, "missing.txt"),
    (lambda f: ms.salient.spec(foo=1), TypeError, "foo"),
    (lambda f: f.apply("salient:foo=1"), ms.ArgumentError, "foo"),
    (lambda f: f.apply("saliant"), ms.ArgumentError, "salient"),
    (lambda f: f.apply(""), ms.ArgumentError, ""),
    (lambda f: f.apply("salient+denoise"), ms.ArgumentError, "first step"),
    (lambda f: ms.denoise(ms.salient(f, iterations=1)), ms.ArgumentError, "first step"),
])
def test_wrong_arguments(curvature, call, error, says):
    with pytest.raises(error) as caught:
        call(curvature)
    assert says in str(caught.value)
    assert not isinstance(caught.value, ms.Error) or isinstance(caught.value, ValueError)


def test_files_with_separators_in_their_names(octahedron, tmp_path):
    path = tmp_path / "a,b=c+d:e.txt"
    path.write_text("\n".join(str(v) for v in range(6)))
    assert ms.vertex_scalar(octahedron, file=path).values.tolist() == list(range(6))
