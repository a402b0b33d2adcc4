"""Filters for ParaView over the package morsel: "Morsel Scalar Field", "Morsel Critical Points and Complex"
and "Morsel Segmentation". docs/python.md says how to load them.

Arrays have the names that users of TTK know: CriticalType (0 minimum, 1 saddle, 2 maximum), VertexId,
AscendingManifold, DescendingManifold, MorseSmaleManifold, and NAME_Order beside an array NAME, the place of
each vertex in the order that the field has: persistence simplification gives one that values do not tell.
"""

from xml.sax.saxutils import quoteattr

import numpy as np
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import morsel as ms

NO_METHOD = "conventional"
KINDS = ("descending", "ascending", "morse-smale")


def _element(kind, name, label, default, documentation, domain=""):
    return smproperty.xml(
        f'<{kind} name="{name}" label={quoteattr(label)} command="Set{name}" number_of_elements="1" '
        f'default_values={quoteattr(str(default))}>{domain}'
        f'<Documentation>{documentation}</Documentation></{kind}>')


def _text(name, label, default, documentation, domain=""):
    return _element("StringVectorProperty", name, label, default, documentation, domain)


def _flag(name, label, documentation):
    return _element("IntVectorProperty", name, label, 0, documentation, '<BooleanDomain name="bool"/>')


def _count(name, label, documentation):
    return _element("IntVectorProperty", name, label, 0, documentation,
                    '<IntRangeDomain name="range" min="0"/>')


def _names(names):
    strings = "".join(f'<String value="{name}"/>' for name in names)
    return f'<StringListDomain name="list">{strings}</StringListDomain>'


def _filter(name, label, outputs):
    """Decorators of a filter of a surface, with its named outputs."""
    def decorate(made):
        made = smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)(made)
        made = smproperty.input(name="Input", port_index=0)(made)
        for index, output in enumerate(outputs):
            made = smproperty.xml(f'<OutputPort index="{index}" name="{output}"/>')(made)
        return smproxy.filter(name=name, label=label)(made)

    return decorate


_ARRAY = _text("ScalarField", "Scalar Field", "", "The values: an array of the points.",
               '<ArrayListDomain name="array_list" attribute_type="Scalars"><RequiredProperties>'
               '<Property name="Input" function="Input"/></RequiredProperties></ArrayListDomain>')
_REPAIR = _flag("Repair", "Repair", "Mend what keeps the input from being a manifold surface.")


def _add(attributes, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def _cells(corners):
    """Cells of the same size (m, k)."""
    corners = np.ascontiguousarray(corners, np.int64)
    offsets = np.arange(len(corners) + 1, dtype=np.int64) * corners.shape[1]
    made = vtkCellArray()
    made.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                 numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    return made


def _put_points(output, positions):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(positions), deep=True))
    output.SetPoints(points)


def _put_surface(output, mesh, given):
    """The mesh, with the arrays that the given surface has at its points."""
    _put_points(output, mesh.vertices)
    output.SetPolys(_cells(mesh.faces))
    for i in range(given.GetPointData().GetNumberOfArrays()):
        array = given.GetPointData().GetArray(i)
        if array is not None:
            _add(output.GetPointData(), array.GetName(), vtk_to_numpy(array)[mesh.input_vertices])


def _field_of(mesh, given, name):
    """The field of an array of the given surface, in the order of NAME_Order if there is one."""
    attributes = given.GetPointData()
    array = attributes.GetArray(name) if name else None
    if array is None or array.GetNumberOfComponents() != 1:
        raise ValueError(f'Scalar Field: the surface has no array "{name}" of a value for each point; '
                         '"Morsel Scalar Field" makes one')
    order = attributes.GetArray(f"{name}_Order")
    ranks = None
    if order is not None:
        ranks = np.argsort(np.argsort(vtk_to_numpy(order)[mesh.input_vertices]))
    return ms.field(mesh, vtk_to_numpy(array)[mesh.input_vertices], ranks=ranks, name=name, numbering="mesh")


class _Filter(VTKPythonAlgorithmBase):
    """What the filters share: the input's mesh, and progress."""

    def __init__(self, outputs):
        VTKPythonAlgorithmBase.__init__(self, nInputPorts=1, nOutputPorts=outputs, inputType="vtkPolyData",
                                        outputType="vtkPolyData")
        self._repair = False
        self._scalar_field = ""

    def set(self, name, value):
        """Keeps a property."""
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def progress(self, _step, fraction):
        """Tells ParaView; False, which ends the work, if it is aborted."""
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def input(self, info):
        """The input, and its mesh."""
        given = vtkPolyData.GetData(info[0], 0)
        return given, ms.Mesh(given, repair=self._repair, progress=self.progress)


@_filter("MorselScalarField", "Morsel Scalar Field", ["field"])
class MorselScalarField(_Filter):
    """A Morse function of the surface, and methods applied to it."""

    def __init__(self):
        _Filter.__init__(self, 1)
        self._function = "mean-curvature"
        self._parameters = ""
        self._method = NO_METHOD
        self._target = 0

    @_text("MorseFunction", "Morse Function", "mean-curvature", "As `morsel fields` lists them.",
           _names(ms.functions()))
    def SetMorseFunction(self, value):
        self.set("_function", value)

    @_text("Parameters", "Parameters", "", "Of the Morse function: KEY=VALUE,KEY=VALUE.")
    def SetParameters(self, value):
        self.set("_parameters", value)

    @_text("Method", "Method", NO_METHOD, "A method or a chain: salient:iterations=10+tps:count=150.")
    def SetMethod(self, value):
        self.set("_method", value)

    @_count("Target", "Target", "End with so many critical points; 0 leaves as many as the method does.")
    def SetTarget(self, value):
        self.set("_target", int(value))

    @_REPAIR
    def SetRepair(self, value):
        self.set("_repair", bool(value))

    def RequestData(self, _request, in_info, out_info):
        given, mesh = self.input(in_info)
        parameters = ":" + self._parameters if self._parameters else ""
        f = ms.field(mesh, self._function + parameters, progress=self.progress)
        if self._method not in ("", NO_METHOD) or self._target:
            f = f.apply(self._method or NO_METHOD, target=self._target or None, progress=self.progress)
        output = vtkPolyData.GetData(out_info, 0)
        _put_surface(output, mesh, given)
        _add(output.GetPointData(), self._function, f.values)
        _add(output.GetPointData(), f"{self._function}_Order", f.ranks.astype(np.int64))
        output.GetPointData().SetActiveScalars(self._function)
        return 1


@_filter("MorselCriticalPointsAndComplex", "Morsel Critical Points and Complex",
         ["field", "points", "complex"])
class MorselCriticalPointsAndComplex(_Filter):
    """The critical points of an array, its Morse-Smale complex, and the segmentation that this gives."""

    def __init__(self):
        _Filter.__init__(self, 3)

    @_ARRAY
    def SetScalarField(self, value):
        self.set("_scalar_field", value)

    @_REPAIR
    def SetRepair(self, value):
        self.set("_repair", bool(value))

    def RequestData(self, _request, in_info, out_info):
        given, mesh = self.input(in_info)
        f = _field_of(mesh, given, self._scalar_field)
        p = ms.critical_points(f, progress=self.progress)
        c = ms.morse_smale(f, progress=self.progress)
        surface, points, complex_ = (vtkPolyData.GetData(out_info, port) for port in range(3))
        _put_surface(surface, mesh, given)
        cells = c.segmentation
        for name, labels in (("Ascending", cells.ascending), ("Descending", cells.descending),
                             ("MorseSmale", cells.morse_smale)):
            _add(surface.GetPointData(), f"{name}Manifold", labels.vertex.astype(np.int64))
            _add(surface.GetCellData(), f"{name}Manifold", labels.face.astype(np.int64))
        self._put_critical_points(points, p)
        complex_.ShallowCopy(c.to_vtk())
        return 1

    def _put_critical_points(self, output, p):
        _put_points(output, p.position)
        output.SetVerts(_cells(np.arange(len(p))[:, None]))
        arrays = {"CriticalType": p.type.astype(np.int32) - ms.MINIMUM, "Multiplicity": p.multiplicity,
                  "VertexId": p.vertex.astype(np.int64), self._scalar_field: p.value,
                  "Persistence": p.persistence}
        for name, values in arrays.items():
            _add(output.GetPointData(), name, values)


@_filter("MorselSegmentation", "Morsel Segmentation", ["field"])
class MorselSegmentation(_Filter):
    """The surface in segments of an array, small ones merged by persistence."""

    def __init__(self):
        _Filter.__init__(self, 1)
        self._by = 0
        self._segments = 0
        self._persistence = ""

    @_ARRAY
    def SetScalarField(self, value):
        self.set("_scalar_field", value)

    @_element("IntVectorProperty", "By", "By", 0, "A segment for each maximum, minimum or cell between them.",
              '<EnumerationDomain name="enum">'
              + "".join(f'<Entry text="{kind}" value="{i}"/>' for i, kind in enumerate(KINDS))
              + "</EnumerationDomain>")
    def SetBy(self, value):
        self.set("_by", int(value))

    @_count("Segments", "Segments", "Merge until at most so many are left; 0 merges none for their number.")
    def SetSegments(self, value):
        self.set("_segments", int(value))

    @_text("Persistence", "Persistence", "", "Or merge all of at most this, as 1% of the values' range.")
    def SetPersistence(self, value):
        self.set("_persistence", value)

    @_REPAIR
    def SetRepair(self, value):
        self.set("_repair", bool(value))

    def RequestData(self, _request, in_info, out_info):
        given, mesh = self.input(in_info)
        s = ms.segment(_field_of(mesh, given, self._scalar_field), by=KINDS[self._by],
                       segments=self._segments or None, persistence=self._persistence or None,
                       progress=self.progress)
        output = vtkPolyData.GetData(out_info, 0)
        _put_surface(output, mesh, given)
        _add(output.GetPointData(), "Segment", s.vertex.astype(np.int64))
        _add(output.GetCellData(), "Segment", s.face.astype(np.int64))
        _add(output.GetCellData(), "SegmentArea", s.table["area"][s.face])
        return 1
