"""Triangle meshes."""

from __future__ import annotations

import os
import warnings as _warnings
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _interop, _library
from ._arguments import Immutable, whole
from ._errors import Defect, MorselWarning
from ._progress import Progress, reporting

PathLike = Union[str, "os.PathLike[str]"]
Weld = Union[bool, str, float, None]


def path_bytes(path: PathLike) -> bytes:
    """A path as the library takes it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError("a path has no null character")
    return name


def weld_text(weld: Weld) -> str | None:
    """A length within which vertices are joined, as the library takes it."""
    if weld is None or weld is False:
        return None
    if weld is True:
        return "0"
    return weld if isinstance(weld, str) else repr(float(weld))


def mask_text(mask: Any) -> str | None:
    """The mask of a mesh that is read, as the library takes it."""
    if mask is None:
        return None
    if isinstance(mask, (str, os.PathLike)):
        return os.fspath(mask)
    raise TypeError("the mask of a file is a path, \"file=PATH,column=NAME\" or \"property=NAME\", not "
                    f"{type(mask).__name__}; for values, give Mesh() the arrays of the mesh")


def _mask_array(mask: Any) -> NDArray[Any] | None:
    if mask is None:
        return None
    values = _interop.array(mask, "the mask")
    return values.astype(np.uint8) if values.dtype == np.bool_ else values


def _warn(mesh: _library.Mesh, level: int) -> None:
    for text in mesh.warnings:
        _warnings.warn(text, MorselWarning, stacklevel=level + 1)


class Mesh(Immutable):
    """A triangle surface: manifold, oriented, every vertex used. Immutable.

    Parameters
    ----------
    vertices : array_like (n, 3), or a mesh of another package
        Positions; any real numbers, which become float64. A trimesh, pyvista, VTK, meshio or Open3D mesh, a
        pair (vertices, faces) or a path may be given in place of both.
    faces : array_like (m, 3) or (m, k), or a list of faces of several sizes
        Numbers of vertices, from 0 on, counter-clockwise seen from outside. Polygons are cut into triangles.
    repair : bool
        Mend what breaks the rules instead of refusing it; `repairs` then tells what was done.
    weld : bool, str or float
        First join vertices at the same position (True) or within a length ("0.1eps", or a number).
    mask : array_like (n,), or str
        Leave out the vertices where it is False, 0 or nan, the faces at them, and vertices that no face is
        left at; `input_vertices` has the numbers of the others. Of a path, a mask as read() takes it.
    progress : bool or callable
        True shows a bar; a function is called with the step's name and the fraction done.

    Raises MeshError, with all defects, where a rule is broken; ValueError for arrays of other shapes or
    types, negative or fractional numbers of vertices. Time O(n). Positions are copied once.

    >>> mesh = ms.Mesh(V, F)
    >>> mesh = ms.Mesh(trimesh.load("scan.stl"), repair=True)
    >>> mesh = ms.Mesh(V, F, mask=np.isfinite(V[:, 2]))
    """

    __slots__ = ("_data", "__weakref__")
    _data: _library.Mesh

    def __init__(self, vertices: Any, faces: Any = None, *, repair: bool = False, weld: Weld = None,
                 mask: Any = None, progress: Progress = None) -> None:
        if faces is None:
            if isinstance(vertices, Mesh):
                self._data = vertices._data
                return
            if isinstance(vertices, (str, os.PathLike)):
                self._data = _read(vertices, repair, weld, mask, progress, 2)._data
                return
            vertices, faces = _interop.arrays_of(vertices)
        positions = _interop.array(vertices, "the vertices")
        corners = _interop.faces_of(faces)
        with reporting(progress) as report:
            if isinstance(corners, _interop.Polygons):
                self._data = _library.mesh_from_polygons(positions, corners.corners, corners.offsets,
                                                         bool(repair), weld_text(weld), _mask_array(mask),
                                                         report)
            else:
                self._data = _library.mesh_from_arrays(positions, corners, bool(repair), weld_text(weld),
                                                       _mask_array(mask), report)
        _warn(self._data, 2)

    @classmethod
    def _of(cls, data: _library.Mesh) -> Mesh:
        mesh = object.__new__(cls)
        mesh._data = data
        return mesh

    def __reduce__(self) -> Any:
        return _restored, (_library.mesh_state(self._data),)

    def __repr__(self) -> str:
        where = f" of {self.path}" if self.path else ""
        return (f"<morsel.Mesh{where}: {self.vertex_count:,} vertices, {self.face_count:,} faces, genus "
                f"{self.genus}, {self.boundary_loop_count} boundary loops>")

    def __eq__(self, other: object) -> bool:
        """Whether both are the same mesh, not another one that looks the same."""
        return isinstance(other, Mesh) and self._data.is_same(other._data)

    def __hash__(self) -> int:
        return hash((self.vertex_count, self.face_count))

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Positions (n, 3), read-only, in the mesh's memory."""
        return self._data.positions

    @property
    def faces(self) -> NDArray[np.uint32]:
        """Triangles (m, 3), read-only, in the mesh's memory."""
        return self._data.faces

    V = vertices
    F = faces

    @property
    def edges(self) -> NDArray[np.uint32]:
        """Edges (e, 2) as pairs of vertices, the smaller first, in lexicographic order."""
        return self._data.edges()

    @property
    def vertex_count(self) -> int:
        """Number of vertices n."""
        return self._data.vertex_count

    @property
    def edge_count(self) -> int:
        """Number of edges."""
        return self._data.edge_count

    @property
    def face_count(self) -> int:
        """Number of triangles m."""
        return self._data.face_count

    @property
    def component_count(self) -> int:
        """Number of connected components."""
        return self._data.component_count

    @property
    def boundary_loop_count(self) -> int:
        """Number of boundary loops; 0 for a closed surface."""
        return self._data.boundary_loop_count

    @property
    def is_closed(self) -> bool:
        """Whether there is no boundary."""
        return self.boundary_loop_count == 0

    @property
    def euler_characteristic(self) -> int:
        """Vertices - edges + faces."""
        return self._data.euler_characteristic

    @property
    def genus(self) -> int:
        """Genus, the sum over the components."""
        return self._data.genus

    @property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, in the mesh's unit."""
        return self._data.diagonal

    @property
    def bounding_box(self) -> NDArray[np.float64]:
        """The least and the greatest coordinates (2, 3), in the mesh's unit. Created."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @property
    def face_areas(self) -> NDArray[np.float64]:
        """Areas (m,) of the triangles, in the mesh's unit squared. Created."""
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        return np.asarray(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1))

    @property
    def vertex_normals(self) -> NDArray[np.float64]:
        """Unit normals (n, 3) at the vertices: the area vectors of their triangles summed, outwards on closed
        surfaces, whichever way their triangles are turned; (0, 0, 0) where the sum is 0. Created."""
        return self._data.vertex_normals()

    @property
    def epsilon(self) -> float:
        """The paper's unit of length: 0.3 % of the diagonal."""
        return self._data.epsilon

    @property
    def boundary_loops(self) -> list[NDArray[np.uint32]]:
        """The vertices of each boundary loop, in order, from its smallest on."""
        return self._data.boundary_loops()

    @property
    def components(self) -> NDArray[np.uint32]:
        """Per vertex (n,): the number of its component. Components are ordered by their smallest vertex."""
        return self._data.components()

    @property
    def properties(self) -> dict[str, NDArray[np.float64]]:
        """Scalars that the file has for its vertices, and means of those that it has for its faces, by name;
        in the file's numbers."""
        return self._data.properties()

    @property
    def repairs(self) -> dict[str, int]:
        """What repair did: how many elements of the input by the name of the repair."""
        return self._data.repairs

    @property
    def warnings(self) -> list[str]:
        """What was read tolerantly, guessed or left out, and whether vertices coincide; a sentence each."""
        return self._data.warnings

    @property
    def input_vertices(self) -> NDArray[np.uint32]:
        """Per vertex (n,): its number in the file or arrays that the mesh was made from."""
        return self._data.input_vertices()

    @property
    def path(self) -> str:
        """The file that it was read from; empty for a mesh made of arrays."""
        return os.fsdecode(self._data.path)

    def length(self, text: str | float) -> float:
        """A length in the mesh's unit: of "8eps", "5%", "3edges", "0.02rootarea", or of a number.

        >>> mesh.length("8eps") == 8 * mesh.epsilon
        True
        """
        return self._data.length(text if isinstance(text, str) else repr(float(text)))

    def with_vertices(self, vertices: ArrayLike) -> Mesh:
        """The same triangles with other positions (n, 3), which must be finite. O(n)."""
        return Mesh._of(self._data.with_positions(_interop.array(vertices, "the vertices")))

    def subdivided(self, pieces: int) -> Mesh:
        """The same surface, each edge cut into equal `pieces` and each triangle into their square; the
        vertices of this mesh come first."""
        return Mesh._of(self._data.subdivided(whole(pieces, "the number of pieces")))

    def save(self, path: PathLike, *, properties: dict[str, ArrayLike] | None = None,
             progress: Progress = None) -> None:
        """Writes .off or .ply, in full precision: read() gets the same mesh, bit for bit.

        `properties` are values for each vertex (n,), by name, which only .ply holds; where repair has changed
        the number of vertices, those of the file or arrays are taken, too, as of field(). The file is written
        whole or not at all. Raises WriteError, and ArgumentError for other endings and for the file that the
        mesh was read from."""
        from ._field import by_vertex

        named = [(str(name), by_vertex(self, _interop.array(values, f"the property {name}"), None))
                 for name, values in (properties or {}).items()]
        with reporting(progress) as report:
            self._data.save(path_bytes(path), named, report)


def _restored(state: tuple[Any, ...]) -> Mesh:
    """Of pickle."""
    return Mesh._of(_library.restored_mesh(state))


def read(path: PathLike, *, repair: bool = False, weld: Weld = None, mask: PathLike | None = None,
         progress: Progress = None) -> Mesh:
    """Reads a mesh: .off, .obj, .ply, .stl, .vtk, .vtp, .vtu, .gii or a surface of FreeSurfer.

    Raises MeshError, with all defects, for a mesh that breaks a rule (repair=True mends what can be mended),
    InputError for a file that is missing, damaged or of another kind. With `weld`, vertices at the same
    position (True) or within a length ("0.1eps", or a number) are joined first. With `mask` (a file of
    values, "file=PATH,column=NAME" or "property=NAME"), vertices where it is 0 or nan are left out. Issues a
    MorselWarning for each of `Mesh.warnings`.

    >>> mesh = ms.read("scan.ply")
    """
    return _read(path, repair, weld, mask, progress, 2)


def _read(path: PathLike, repair: bool, weld: Weld, mask: Any, progress: Progress, level: int) -> Mesh:
    with reporting(progress) as report:
        mesh = Mesh._of(_library.read_mesh(path_bytes(path), bool(repair), weld_text(weld), mask_text(mask),
                                           report))
    _warn(mesh._data, level + 1)
    return mesh


def as_mesh(mesh: Any) -> Mesh:
    """Converts what users may give for a mesh to a Mesh."""
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh)


def defects(vertices: ArrayLike, faces: ArrayLike) -> list[Defect]:
    """All that keeps these arrays, as Mesh takes them, from being a mesh; empty if nothing does.

    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]]
    >>> F = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> [defect.description for defect in ms.defects(V, F)]
    ['1 vertex that no face uses (4)']
    """
    corners = _interop.faces_of(faces)
    if isinstance(corners, _interop.Polygons):
        raise ValueError("defects() takes faces of one size; give Mesh polygons of several")
    return [Defect(*defect) for defect in _library.defects(_interop.array(vertices, "the vertices"), corners)]
