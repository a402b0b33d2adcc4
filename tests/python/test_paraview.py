"""The filters for ParaView in a pipeline of VTK. ParaView itself is not needed: a stand-in of the decorators
that describe a filter to it keeps what they are given. tests/python/prove_paraview.py runs them in pvbatch.
"""

import importlib.util
import os
import pathlib
import sys
import types
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import sample
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

import morsel as ms

PLUGIN = pathlib.Path(os.environ["MORSEL_SOURCES"]) / "python" / "paraview" / "MorselPlugin.py"


class Kept:
    """Decorators that keep what describes a filter; a class keeps being one."""

    def __init__(self):
        self.xml_texts = []
        self.filters = []
        self.outputs = []

    def xml(self, text):
        self.xml_texts.append(text)
        return lambda decorated: decorated

    def filter(self, name, label):
        self.filters.append((name, label))
        return lambda decorated: decorated

    def input(self, **_):
        return lambda decorated: decorated

    datatype = input


@pytest.fixture(scope="module")
def kept():
    return Kept()


@pytest.fixture(scope="module")
def plugin(kept):
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

    stand_in = types.ModuleType("paraview.util.vtkAlgorithm")
    stand_in.VTKPythonAlgorithmBase = VTKPythonAlgorithmBase
    stand_in.smproxy = stand_in.smproperty = stand_in.smdomain = kept
    names = {"paraview": types.ModuleType("paraview"), "paraview.util": types.ModuleType("paraview.util"),
             "paraview.util.vtkAlgorithm": stand_in}
    before = {name: sys.modules.get(name) for name in names}
    sys.modules.update(names)
    try:
        spec = importlib.util.spec_from_file_location("MorselPlugin", PLUGIN)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    finally:
        for name, value in before.items():
            if value is None:
                del sys.modules[name]
            else:
                sys.modules[name] = value
    return module


@pytest.fixture(scope="module")
def surface(plugin):
    """The lion's head as VTK has it."""
    lion = ms.read(sample("lion-head.off"))
    made = vtkPolyData()
    plugin._put_points(made, lion.vertices)
    made.SetPolys(plugin._cells(lion.faces))
    return made


def outputs(made, data, **properties):
    made.SetInputDataObject(0, data)
    for name, value in properties.items():
        getattr(made, f"Set{name}")(value)
    made.Update()
    return [made.GetOutputDataObject(port) for port in range(made.GetNumberOfOutputPorts())]


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


def test_described(plugin, kept):
    assert [label for _, label in kept.filters] == [
        "Morsel Scalar Field", "Morsel Critical Points and Complex", "Morsel Segmentation"]
    described = [ElementTree.fromstring(text) for text in kept.xml_texts]
    ports = [(e.get("index"), e.get("name")) for e in described if e.tag == "OutputPort"]
    assert sorted(ports) == [("0", "field")] * 3 + [("1", "points"), ("2", "complex")]
    for element in described:
        if element.tag != "OutputPort":
            assert any(hasattr(made, element.get("command")) for made in vars(plugin).values())
            assert element.find("Documentation").text
    functions = next(e for e in described if e.get("name") == "MorseFunction")
    assert {"height", "mean-curvature"} <= {string.get("value") for string in functions.iter("String")}


def test_field_points_complex(plugin, surface, curvature):
    [field] = outputs(plugin.MorselScalarField(), surface)
    assert np.array_equal(array(field.GetPointData(), "mean-curvature"), curvature.values)
    fields, points, lines = outputs(plugin.MorselCriticalPointsAndComplex(), field,
                                    ScalarField="mean-curvature")
    p, c = ms.critical_points(curvature), ms.morse_smale(curvature)
    assert points.GetNumberOfPoints() == points.GetNumberOfVerts() == len(p) == 1895
    assert np.array_equal(array(points.GetPointData(), "VertexId"), p.vertex)
    assert np.array_equal(array(points.GetPointData(), "CriticalType"), p.type - 1)
    assert np.array_equal(array(points.GetPointData(), "mean-curvature"), p.value)
    assert lines.GetNumberOfLines() == len(c.arcs)
    assert np.array_equal(array(fields.GetCellData(), "MorseSmaleManifold"), c.segmentation.morse_smale.face)
    assert np.array_equal(array(fields.GetPointData(), "AscendingManifold"), c.segmentation.ascending.vertex)


def test_methods_and_their_order(plugin, surface):
    """Persistence simplification leaves plateaus, whose order the array of the order keeps."""
    [field] = outputs(plugin.MorselScalarField(), surface, Method="tps:count=97")
    _, points, _ = outputs(plugin.MorselCriticalPointsAndComplex(), field, ScalarField="mean-curvature")
    assert points.GetNumberOfPoints() == 97
    [field] = outputs(plugin.MorselScalarField(), surface, MorseFunction="height", Parameters="axis=x",
                      Target=10)
    _, points, _ = outputs(plugin.MorselCriticalPointsAndComplex(), field, ScalarField="height")
    assert points.GetNumberOfPoints() <= 10


def test_segments(plugin, surface, curvature):
    [field] = outputs(plugin.MorselScalarField(), surface)
    [parts] = outputs(plugin.MorselSegmentation(), field, ScalarField="mean-curvature", By=1, Segments=12)
    s = ms.segment(curvature, by="ascending", segments=12)
    assert np.array_equal(array(parts.GetCellData(), "Segment"), s.face)
    areas = array(parts.GetCellData(), "SegmentArea")
    assert np.array_equal(areas, s.table["area"][s.face])


def test_no_such_array(plugin, surface):
    with pytest.raises(ValueError, match="absent"):
        plugin._field_of(ms.Mesh(surface), surface, "absent")
