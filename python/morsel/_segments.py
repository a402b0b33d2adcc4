"""Segments of a surface."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable, whole
from ._field import Field
from ._made import mesh_file, number_text, or_minus_one
from ._mesh import PathLike, path_bytes
from ._points import _field
from ._progress import Progress, reporting
from ._registry import registry


class Segments(Immutable):
    """A surface in connected segments; made by segment(). Arrays are read-only, in its memory."""

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Segments) -> None:
        self.field = field
        self._data = data

    def __len__(self) -> int:
        return len(self.table)

    def __repr__(self) -> str:
        return f"<morsel.Segments: {len(self):,} {self.by} segments>"

    @property
    def by(self) -> str:
        """"descending", "ascending" or "morse-smale"."""
        return self._data.by

    @property
    def vertex(self) -> NDArray[np.uint32]:
        """Per vertex (n,): its segment."""
        return self._data.vertex

    @property
    def face(self) -> NDArray[np.uint32]:
        """Per triangle (m,): its segment."""
        return self._data.face

    @property
    def table(self) -> NDArray[np.void]:
        """A structured array (s,) with a row for each of the s segments: minimum and top (nodes of the
        complex, 2³² - 1 where it has none), triangles, vertices, area (the mesh's unit squared),
        boundary_length, mesh_boundary_length. """
        return self._data.table

    @property
    def minima(self) -> NDArray[np.int64]:
        """Per segment (s,): the vertex of its minimum, -1 if it is of a maximum."""
        return or_minus_one(self._data.minima())

    @property
    def maxima(self) -> NDArray[np.int64]:
        """Per segment (s,): the vertex of its maximum or, of a boundary loop, its smallest; -1 if it is of a
        minimum."""
        return or_minus_one(self._data.tops())

    @property
    def neighbours(self) -> tuple[NDArray[np.void], NDArray[np.uint32]]:
        """(rows, offsets): segment i has the neighbours rows[offsets[i]:offsets[i + 1]], a structured array
        (segment, edges, length) of those it shares a border with."""
        return self._data.neighbours, self._data.neighbour_offsets

    @property
    def saddles(self) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """(vertices, offsets): the saddles of segment i are vertices[offsets[i]:offsets[i + 1]]."""
        return self._data.saddles, self._data.saddle_offsets

    @property
    def unmerged(self) -> int:
        """How many segments there were before merging."""
        return self._data.unmerged

    @property
    def cancelled_pairs(self) -> int:
        """How many pairs were cancelled to merge them."""
        return self._data.cancelled_pairs

    @property
    def largest_persistence(self) -> float:
        """The largest persistence among those, in the field's unit."""
        return self._data.largest_persistence

    @property
    def note(self) -> str:
        """Why there are more than were wanted; empty if there are not."""
        return self._data.note

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each segment."""
        import pandas

        frame = pandas.DataFrame(self.table[["triangles", "vertices", "area", "boundary_length",
                                             "mesh_boundary_length"]])
        frame.insert(0, "minimum", self.minima)
        frame.insert(1, "maximum", self.maxima)
        return frame

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes the labels (.ply, .vtp, .txt, .glb) or the table (.json) as `morsel segment` does.

        `mesh` is a file, .ply or .off, that the mesh is written to first where it has none; the document then
        names it.
        """
        from . import _documents

        with reporting(progress) as report:
            _documents.write_segments(self._data, path_bytes(path), mesh_file(mesh), registry(), report)


def segment(f: Field, *, by: str = "descending", segments: int | None = None,
            persistence: str | float | None = None, progress: Progress = None) -> Segments:
    """Cuts a surface into the segments of a field (Natarajan, Wang, Bremer, Pascucci, Hamann 2006), small
    ones merged by persistence.

    Parameters
    ----------
    f : Field
    by : "descending", "ascending" or "morse-smale"
        A segment for each maximum, for each minimum, or for each cell between the two.
    segments : int
        Merge until at most so many are left, those of least persistence first.
    persistence : float or str
        Or: merge all of at most this persistence, in the field's unit or, as in "1%", of its range.

    The same as `morsel segment`. Raises ArgumentError for bad values. O(n) but for sorting borders.

    >>> s = ms.segment(f, by="ascending", segments=30)
    >>> s.face, s.table["area"]
    """
    with reporting(progress) as report:
        threshold = None if persistence is None else number_text(persistence)
        segments = None if segments is None else whole(segments, "the number of segments", 0)
        return Segments(f, _library.segment(_field(f)._data, by, segments, threshold, report))
