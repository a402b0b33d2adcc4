"""Morse-Smale complexes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable, place
from ._field import Field
from ._points import _field
from ._progress import Progress, reporting

NODE_KINDS = ("minimum", "saddle", "maximum", "cap")
ARC_KINDS = ("descending", "ascending")


@dataclass(frozen=True)
class Labels:
    """A label for each vertex and each triangle, from 0 on."""

    vertex: NDArray[np.uint32]
    face: NDArray[np.uint32]
    count: int
    """Of labels that some triangle carries."""


class Segmentation(NamedTuple):
    """Which extrema the vertices and triangles of a surface flow to."""

    ascending: Labels
    """Label i is node i of the complex, a minimum."""
    descending: Labels
    """Label i is a maximum or, after those, a boundary loop's cap."""
    morse_smale: Labels
    """Label i is the pair cells[i]."""
    cells: NDArray[np.uint32]
    """(k, 2): ascending and descending label of each Morse-Smale label."""


class MorseSmaleComplex(Immutable):
    """A Morse-Smale complex; made by morse_smale().

    Nodes are minima, then saddles (one for each multiplicity), then maxima, then the caps of boundary
    loops. Arcs 4i … 4i + 3 are those of saddle i, counter-clockwise around it, descending and ascending in
    turn. Arrays are made when they are first asked for, and are read-only. """

    __slots__ = ("field", "_data", "_nodes", "_arcs", "_quads", "_polylines", "_segmentation")

    def __init__(self, field: Field, data: _library.Complex) -> None:
        self.field = field
        self._data = data
        self._nodes: NDArray[np.void] | None = None
        self._arcs: NDArray[np.void] | None = None
        self._quads: NDArray[np.void] | None = None
        self._polylines: tuple[NDArray[np.float64], NDArray[np.uint64]] | None = None
        self._segmentation: Segmentation | None = None

    def __repr__(self) -> str:
        d = self._data
        return (f"<morsel.MorseSmaleComplex: {d.minimum_count:,} minima, {d.saddle_count:,} saddles, "
                f"{d.maximum_count:,} maxima, {d.cap_count:,} caps, {4 * d.saddle_count:,} arcs>")

    @property
    def minimum_count(self) -> int:
        """Number of minima."""
        return self._data.minimum_count

    @property
    def saddle_count(self) -> int:
        """Number of saddles with their multiplicities."""
        return self._data.saddle_count

    @property
    def maximum_count(self) -> int:
        """Number of maxima, without caps."""
        return self._data.maximum_count

    @property
    def cap_count(self) -> int:
        """Number of boundary loops."""
        return self._data.cap_count

    @property
    def cell_count(self) -> int:
        """Number of cells: quads that have area, that is a triangle."""
        return _library.cell_count(self.field._data, self._data)

    @property
    def nodes(self) -> NDArray[np.void]:
        """A structured array (kind, cell, vertex, value): `kind` is 0 for minima, 1 for saddles, 2 for
        maxima, 3 for caps; `cell` the critical vertex, edge, triangle or boundary loop; `vertex` its
        highest vertex, of a cap the smallest of its loop; `value` the field there, infinite for a cap."""
        if self._nodes is None:
            self._nodes = self._data.nodes()
        return self._nodes

    @property
    def arcs(self) -> NDArray[np.void]:
        """A structured array (saddle, end, kind): nodes, and 0 for descending or 1 for ascending arcs."""
        if self._arcs is None:
            self._arcs = self._data.arcs()
        return self._arcs

    @property
    def quads(self) -> NDArray[np.void]:
        """A structured array (nodes, arcs) of four each: minimum, saddle, maximum or cap, saddle,
        counter-clockwise; arc i joins nodes i and i + 1."""
        if self._quads is None:
            self._quads = self._data.quads()
        return self._quads

    @property
    def polylines(self) -> tuple[NDArray[np.float64], NDArray[np.uint64]]:
        """(points, offsets): arc i is points[offsets[i]:offsets[i + 1]], from the saddle on, along mesh
        edges if it descends, through triangles if it ascends. points are (p, 3)."""
        if self._polylines is None:
            self._polylines = self._data.polylines(None)
        return self._polylines

    @property
    def segmentation(self) -> Segmentation:
        """Which minimum and maximum each vertex and triangle flows to."""
        if self._segmentation is None:
            made = _library.segmentation(self.field._data, self._data, None)
            self._segmentation = segmentation_of(made)
        return self._segmentation

    def arcs_around(self, node: int) -> NDArray[np.uint32]:
        """The arcs at a node, counter-clockwise seen from outside."""
        return self._data.arcs_around(place(node, "the node", len(self.nodes) - 1))

    def to_networkx(self) -> Any:
        """A networkx.MultiGraph: nodes 0 … with kind, vertex, value and position, an edge for each arc with
        arc (its number, which is its key, too) and kind."""
        from . import _exports

        return _exports.graph(self)

    def to_vtk(self) -> Any:
        """A vtkPolyData: nodes as vertices, arcs as lines; of cells kind (0 minimum, 1 saddle, 2 maximum, 3
        cap, 4 descending, 5 ascending arc), vertex and end_vertex."""
        from . import _exports

        return _exports.complex_polydata(self)


def segmentation_of(made: dict[str, Any]) -> Segmentation:
    """A Segmentation of what the library gives."""
    return Segmentation(Labels(*made["ascending"]), Labels(*made["descending"]), Labels(*made["morse_smale"]),
                        made["cells"])


def morse_smale(f: Field, *, progress: Progress = None) -> MorseSmaleComplex:
    """The Morse-Smale complex of a field (Edelsbrunner, Harer, Zomorodian 2003), from its discrete gradient
    (Robins, Wood, Sheppard 2011), on the surface with its boundary loops capped.

    Component by component: four arcs a saddle, quads = arcs / 2, nodes - arcs + quads = Euler
    characteristic of the capped surface. O(n).

    >>> c = ms.morse_smale(f)
    >>> points, offsets = c.polylines
    """
    with reporting(progress) as report:
        return MorseSmaleComplex(f, _library.complex(_field(f)._data, report))
