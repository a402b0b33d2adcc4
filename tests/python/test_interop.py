"""Meshes of other packages, of which only VTK is installed: the others by objects that look like theirs."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import OCTAHEDRON_F, OCTAHEDRON_V

import morsel as ms

COUNTED = np.column_stack([np.full(8, 3), OCTAHEDRON_F]).ravel()


def block(kind, data):
    return SimpleNamespace(type=kind, data=np.asarray(data))


@pytest.mark.parametrize("mesh", [
    SimpleNamespace(vertices=OCTAHEDRON_V, faces=OCTAHEDRON_F),  # trimesh
    SimpleNamespace(vertices=OCTAHEDRON_V.tolist(), triangles=OCTAHEDRON_F.tolist()),  # Open3D
    SimpleNamespace(points=OCTAHEDRON_V, faces=COUNTED),  # pyvista
    SimpleNamespace(points=OCTAHEDRON_V, cells=[block("triangle", OCTAHEDRON_F)]),  # meshio
    SimpleNamespace(points=OCTAHEDRON_V, cells=[("line", [[0, 1]]), ("triangle", OCTAHEDRON_F[:4]),
                                                ("triangle", OCTAHEDRON_F[4:])]),  # meshio 3
    (OCTAHEDRON_V, OCTAHEDRON_F),
])
def test_taken_as_it_is(mesh):
    made = ms.Mesh(mesh)
    assert np.array_equal(made.vertices, OCTAHEDRON_V) and np.array_equal(made.faces, OCTAHEDRON_F)
    assert len(ms.height(mesh)) == 6


def test_polygons_of_other_packages():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0]]
    vtk_like = SimpleNamespace(points=np.array(points), faces=np.array([4, 0, 1, 2, 3, 3, 1, 4, 2]))
    meshio_like = SimpleNamespace(points=np.array(points), cells=[block("quad", [[0, 1, 2, 3]]),
                                                                  block("triangle", [[1, 4, 2]])])
    for mesh in (vtk_like, meshio_like):
        made = ms.Mesh(mesh)
        assert made.face_count == 3 and made.boundary_loop_count == 1


def test_refused():
    cells = [block("tetra", [[0, 1, 2, 3]])]
    with pytest.raises(ValueError, match="tetra"):
        ms.Mesh(SimpleNamespace(points=OCTAHEDRON_V, cells=cells))
    with pytest.raises(ValueError, match="no faces"):
        ms.Mesh(SimpleNamespace(points=OCTAHEDRON_V, cells=[]))
    with pytest.raises(ValueError, match="no face"):
        ms.Mesh(SimpleNamespace(points=OCTAHEDRON_V, faces=np.array([-1, 0, 1, 2, 3])))
    with pytest.raises(ValueError, match="ends within"):
        ms.Mesh(SimpleNamespace(points=OCTAHEDRON_V, faces=np.array([3, 0, 1])))


def test_vtk():
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points = vtkPoints()
    points.SetData(numpy_to_vtk(OCTAHEDRON_V, deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 25, 3), deep=True),
                  numpy_to_vtkIdTypeArray(OCTAHEDRON_F.ravel(), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    made = ms.Mesh(data)
    assert np.array_equal(made.vertices, OCTAHEDRON_V) and np.array_equal(made.faces, OCTAHEDRON_F)
    with pytest.raises(ms.MeshError):
        ms.Mesh(vtkPolyData())
