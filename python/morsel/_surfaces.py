"""Surfaces made of surfaces: cut open into discs, and of quads."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable, whole
from ._complex import MorseSmaleComplex
from ._field import Field
from ._made import field_of, mesh_file, number_text
from ._mesh import Mesh, PathLike, path_bytes
from ._progress import Progress, reporting
from ._registry import registry


class Cut(Immutable):
    """A surface cut open; made by cut()."""

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Cut) -> None:
        self.field = field
        self._data = data

    def __repr__(self) -> str:
        return f"<morsel.Cut: {len(self.paths):,} paths of length {self.length:.6g}>"

    @property
    def mesh(self) -> Mesh:
        """The surface cut open: the same triangles in the same order. Vertices keep their numbers, copies
        come after all others."""
        return Mesh._of(self._data.opened())

    @property
    def original(self) -> NDArray[np.uint32]:
        """Per vertex of the opened mesh (o,): the one of the surface that it is, or copies."""
        return self._data.originals()

    @property
    def paths(self) -> list[NDArray[np.uint32]]:
        """The pieces of the cut, as vertices (k,), neighbours each; a loop has its first one last, too."""
        return self._data.paths()

    @property
    def edges(self) -> NDArray[np.uint32]:
        """The edges (e, 2) that were cut, as pairs of vertices."""
        return self.field.mesh.edges[self._data.edges]

    @property
    def components(self) -> NDArray[np.void]:
        """A structured array (c,) with a row for each component: vertices, genus, loops, paths, length_found,
        length (in the mesh's unit), copies."""
        return self._data.components

    @property
    def length(self) -> float:
        """Length of all paths, in the mesh's unit."""
        return self._data.length

    @property
    def length_found(self) -> float:
        """Length before it was shortened."""
        return self._data.length_found

    @property
    def is_settled(self) -> bool:
        """Whether no single path can be made shorter."""
        return self._data.is_settled

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes the opened mesh (.off, .ply), the cut as lines (.vtp) or what was cut (.json), as `morsel
        cut` does. `mesh` is a file that the surface is written to first where it has none."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_cut(self._data, path_bytes(path), mesh_file(mesh), registry(), report)


def cut(f: Any, *, shorten: bool = True, progress: Progress = None) -> Cut:
    """Cuts a surface of any genus open into one disc a component, along the arcs of a field's Morse-Smale
    complex (Ni, Garland, Hart 2004), shortened along the mesh.

    `f` is a Field, or a mesh for its height. The fewer critical points, the better the cut. The same as
    `morsel cut`. O(n log n) and what shortening takes.

    >>> disc = ms.cut(mesh).mesh
    """
    field = field_of(f, _library.cut_field, progress, 2)
    with reporting(progress) as report:
        return Cut(field, _library.cut(field._data, bool(shorten), report))


class Quads(Immutable):
    """An all-quad mesh; made by quads()."""

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Quads) -> None:
        self.field = field
        self._data = data

    def __repr__(self) -> str:
        return f"<morsel.Quads: {len(self.faces):,} quads in {self.patch_count:,} patches>"

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Positions (v, 3)."""
        return self._data.positions

    @property
    def faces(self) -> NDArray[np.uint32]:
        """Quads (q, 4), counter-clockwise seen from outside."""
        return self._data.faces

    @property
    def patch(self) -> NDArray[np.uint32]:
        """Per quad (q,): its patch, a quad of the complex."""
        return self._data.patch

    @property
    def patch_count(self) -> int:
        """Number of patches."""
        return self._data.patch_count

    @property
    def complex(self) -> MorseSmaleComplex:
        """The complex that was laid out, without dangling arcs."""
        return MorseSmaleComplex(self.field, self._data.complex())

    @property
    def repairs(self) -> NDArray[np.void]:
        """A structured array (kind, vertex, saddle_vertex, persistence): extrema with a single arc, which
        were cancelled with their saddles."""
        return self._data.repairs

    @property
    def cancelled(self) -> int:
        """Pairs that were cancelled by persistence before."""
        return self._data.cancelled

    @property
    def quality(self) -> dict[str, Any]:
        """By name: valence (how many vertices have 0, 1, … edges), extraordinary (vertices of a valence other
        than 4, on the boundary 3); angle_mean and angle_max (how far corners are from 90 degrees);
        scaled_jacobian_mean and scaled_jacobian_min (1 for a rectangle), concave (quads of a negative one);
        area_mean (in the mesh's unit squared), area_deviation, area_min and area_max (as shares of it);
        distance_max and distance_mean of the quads from the surface and distance_from_input, the largest the
        other way (in the mesh's unit)."""
        return self._data.quality()

    def describe(self) -> str:
        """All this as text."""
        return self._data.description()

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes the quads (.obj) or their counts and quality (.json), as `morsel quads` does. `mesh` is a
        file that the surface is written to first where it has none."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_quads(self._data, path_bytes(path), mesh_file(mesh), registry(), report)


def quads(f: Any, *, persistence: str | float | None = None, resolution: int = 10, relaxation: int = 2,
          progress: Progress = None) -> Quads:
    """Turns the Morse-Smale complex of a field into an all-quad mesh of the surface (after Dong, Bremer,
    Garland, Pascucci, Hart 2006).

    Parameters
    ----------
    f : Field, or a mesh for its 40th eigenfunction
        Smooth fields with evenly spread critical points give good layouts.
    persistence : float or str
        Cancel pairs of at most this persistence first, in the field's unit or, as in "1%", of its range.
    resolution : int
        Quads along each side of a patch, 2 or more; with boundary loops 4 or more and even.
    relaxation : int
        How often corners of patches are moved to the middle of these.

    The same as `morsel quads`. Raises InputError where the field gives no layout.

    >>> q = ms.quads(mesh);  q.vertices, q.faces
    """
    field = field_of(f, _library.quads_field, progress, 2)
    with reporting(progress) as report:
        threshold = "" if persistence is None else number_text(persistence)
        return Quads(field, _library.quads(field._data, threshold, whole(resolution, "the resolution"),
                                           whole(relaxation, "the relaxation"), report))
