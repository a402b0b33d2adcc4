"""pvbatch tests/python/prove_paraview.py MESH: the filters in ParaView itself, which the tests do not
need. PYTHONPATH must lead to the package. Prints the outputs' arrays, and the numbers of critical points of
the mean curvature before and after salient smoothing: 1,895 and 97 on lion-head. The mesh is read by the
package: ParaView's own readers have positions in single precision.
"""

import inspect
import pathlib
import sys

if not hasattr(inspect, "getargspec"):  # ParaView 5.11 imports it, Python 3.11 has it no more
    inspect.getargspec = inspect.getfullargspec

from paraview import simple  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData  # noqa: E402

import morsel as ms  # noqa: E402


def surface_of(path):
    """A source of ParaView that has the mesh."""
    mesh = ms.read(path)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(mesh.vertices, deep=True))
    triangles = vtkCellArray()
    triangles.SetData(3, numpy_to_vtkIdTypeArray(mesh.faces.astype("int64").ravel(), deep=True))
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(triangles)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(surface)
    return source


def names(attributes):
    return ", ".join(attributes.keys()) or "none"


def main():
    plugin = pathlib.Path(__file__).resolve().parents[2] / "python" / "paraview" / "MorselPlugin.py"
    simple.LoadPlugin(str(plugin), remote=False, ns=vars(simple))
    surface = surface_of(sys.argv[1])
    for method in ("conventional", "salient:iterations=10"):
        field = simple.MorselScalarField(Input=surface, Method=method)
        made = simple.MorselCriticalPointsandComplex(Input=field, ScalarField="mean-curvature")
        made.UpdatePipeline()
        print(f"{method}: {made[1].GetDataInformation().GetNumberOfPoints():,} critical points")
        for port, output in enumerate(("field", "points", "complex")):
            print(f"  {output}: arrays of points {names(made[port].PointData)}; "
                  f"of cells {names(made[port].CellData)}")
    parts = simple.MorselSegmentation(Input=field, ScalarField="mean-curvature", Segments=12)
    parts.UpdatePipeline()
    print(f"segments: {int(parts.CellData['Segment'].GetRange()[1]) + 1}")


main()
