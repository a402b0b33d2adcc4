"""Meshes of other packages, by what they have rather than by what they are.

Nothing here imports those packages: an object is taken for a mesh by its attributes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


class Polygons:
    """Faces of several sizes: face i has corners[offsets[i]:offsets[i + 1]]."""

    def __init__(self, corners: NDArray[Any], offsets: NDArray[Any]) -> None:
        self.corners = corners
        self.offsets = offsets


def array(given: Any, what: str) -> NDArray[Any]:
    """`given` as an array; a ValueError where it is none, or has masked or ragged elements."""
    if isinstance(given, np.ma.MaskedArray):
        raise ValueError(f"{what} are a masked array; fill or drop the masked elements first")
    try:
        with np.errstate(all="ignore"):
            made = np.asarray(given)
    except ValueError as error:  # ragged
        raise ValueError(f"{what} are no array of numbers: {error}") from None
    if made.dtype == object:
        raise ValueError(f"{what} are no array of numbers, but one of Python objects")
    return made


def faces_of(given: Any) -> NDArray[Any] | Polygons:
    """Faces as an array (m, k), or as polygons where a list has faces of several sizes."""
    if isinstance(given, Polygons):
        return given
    if isinstance(given, (list, tuple)) and given and all(hasattr(face, "__len__") for face in given):
        if len({len(face) for face in given}) > 1:
            sizes = [len(face) for face in given]
            corners = [array(face, "the corners of a face") for face in given]
            return Polygons(np.concatenate(corners), np.concatenate([[0], np.cumsum(sizes)]))
    made = array(given, "the faces")
    if made.size == 0 and made.dtype.kind == "f":  # what numpy makes of an empty list
        made = made.astype(np.int64)
    return made.reshape(0, 3) if made.shape == (0,) else made


def _counted(cells: NDArray[Any]) -> Polygons | NDArray[Any]:
    """VTK's list of cells: [k, corners of a face, k, …]."""
    cells = np.asarray(cells).ravel()
    if len(cells) % 4 == 0 and len(cells) and (cells[::4] == 3).all():
        return cells.reshape(-1, 4)[:, 1:]
    starts, at = [], 0
    while at < len(cells):
        starts.append(at)
        if not cells[at] >= 1:
            raise ValueError(f"a cell of {cells[at]} corners is no face")
        at += int(cells[at]) + 1
    if at != len(cells):
        raise ValueError("the list of cells ends within a cell")
    offsets = np.concatenate([[0], np.cumsum(cells[starts])]) if starts else np.zeros(1, int)
    corners = np.delete(cells, starts)
    return Polygons(corners, offsets)


def _of_vtk(mesh: Any) -> tuple[Any, Any]:
    """A vtkPolyData: VTK's own conversions are needed."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if mesh.GetPoints() is None:
        return np.empty((0, 3)), np.empty((0, 3), int)
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    cells = mesh.GetPolys()
    corners = vtk_to_numpy(cells.GetConnectivityArray())
    return points, Polygons(corners, vtk_to_numpy(cells.GetOffsetsArray()))


def _of_meshio(mesh: Any) -> tuple[Any, Any]:
    """The triangles, quads and polygons of a meshio.Mesh; lines and vertices are passed over."""
    faces, others = [], set()
    for block in mesh.cells:
        kind, data = (block.type, block.data) if hasattr(block, "type") else block
        if kind in ("triangle", "quad", "polygon"):
            faces.append(np.asarray(data))
        elif kind not in ("line", "vertex"):
            others.add(kind)
    if others or not faces:
        raise ValueError("the mesh is no surface of polygons; it has cells of the types "
                         + ", ".join(sorted(others)) if others else "the mesh has no faces")
    if len(faces) == 1:
        return mesh.points, faces[0]
    offsets = np.concatenate([[0], np.cumsum(np.concatenate([[f.shape[1]] * len(f) for f in faces]))])
    return mesh.points, Polygons(np.concatenate([f.ravel() for f in faces]), offsets)


def arrays_of(mesh: Any) -> tuple[Any, Any]:
    """Vertices and faces of a trimesh, pyvista, VTK, meshio or Open3D mesh, or of a pair of arrays; a
    TypeError for anything else."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh.Trimesh
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # open3d.geometry.TriangleMesh
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):  # pyvista.PolyData
        return np.asarray(mesh.points), _counted(mesh.faces)
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):  # meshio.Mesh
        return _of_meshio(mesh)
    if hasattr(mesh, "GetPolys"):  # vtkPolyData
        return _of_vtk(mesh)
    raise TypeError(f"{type(mesh).__name__} is not a mesh: give vertices and faces, a path, or a mesh of "
                    "trimesh, pyvista, VTK, meshio or Open3D")
