"""Critical points of a field."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable
from ._field import Field
from ._made import or_minus_one
from ._progress import Progress, reporting

MINIMUM = 1
SADDLE = 2
MAXIMUM = 3


class Counts(NamedTuple):
    """How many critical points there are."""

    minima: int
    saddles: int
    """Vertices."""
    saddle_multiplicity: int
    """The sum of their multiplicities."""
    maxima: int
    total: int
    """minima + saddles + maxima."""


def type_names(types: NDArray[np.uint8]) -> NDArray[np.str_]:
    """ "minimum", "saddle" or "maximum" of each."""
    return np.array(["regular", "minimum", "saddle", "maximum"])[types]


def counts_of(types: NDArray[np.uint8], multiplicities: NDArray[np.uint32]) -> Counts:
    """How many there are of each type."""
    minima, saddles, maxima = (int(np.count_nonzero(types == of)) for of in (MINIMUM, SADDLE, MAXIMUM))
    return Counts(minima, saddles, int(multiplicities[types == SADDLE].sum()), maxima, len(types))


class CriticalPoints(Immutable):
    """Critical points by ascending vertex; made by critical_points().

    `array` is a structured array (vertex, type, multiplicity); each of these, and value, persistence and
    position, is an array, too. Indexing as of an array, by a slice, numbers or booleans, gives some of them:

    >>> p[p.type == ms.MAXIMUM]
    >>> p[p.persistence > 0.1 * f.extent].counts
    """

    __slots__ = ("field", "array", "_origins")

    def __init__(self, field: Field, array: NDArray[np.void],
                 origins: NDArray[np.uint32] | None = None) -> None:
        self.field = field
        self.array = array
        self._origins = origins

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, which: Any) -> CriticalPoints:
        if isinstance(which, CriticalPoints):
            raise TypeError("critical points are indexed by slices, numbers or booleans")
        places = np.atleast_1d(np.arange(len(self))[which])
        if places.ndim != 1:
            raise IndexError("critical points are indexed by slices, numbers or booleans, of one dimension")
        chosen = self.array[places]
        chosen.flags.writeable = False
        return CriticalPoints(self.field, chosen, None if self._origins is None else self._origins[places])

    def __reduce__(self) -> Any:
        return _restored, (self.field, self.array, self._origins)

    def __repr__(self) -> str:
        c = self.counts
        return (f"<morsel.CriticalPoints: {c.minima:,} minima, {c.saddles:,} saddles "
                f"(multiplicity {c.saddle_multiplicity:,}), {c.maxima:,} maxima>")

    @property
    def vertex(self) -> NDArray[np.uint32]:
        """Numbers of vertices (k,)."""
        return self.array["vertex"]

    @property
    def type(self) -> NDArray[np.uint8]:
        """MINIMUM (1), SADDLE (2) or MAXIMUM (3) (k,)."""
        return self.array["type"]

    @property
    def type_name(self) -> NDArray[np.str_]:
        """ "minimum", "saddle" or "maximum" (k,)."""
        return type_names(self.type)

    @property
    def multiplicity(self) -> NDArray[np.uint32]:
        """Of saddles, one less than the runs of lower neighbours; 1 of all others (k,)."""
        return self.array["multiplicity"]

    @property
    def value(self) -> NDArray[np.float64]:
        """The field there (k,)."""
        return self.field.values[self.vertex]

    @property
    def position(self) -> NDArray[np.float64]:
        """Where they are (k, 3)."""
        return self.field.mesh.vertices[self.vertex]

    @property
    def persistence(self) -> NDArray[np.float64]:
        """The persistence of their pairs (k,), of a multiple saddle the largest; infinite for what is
        essential or paired with a boundary loop. In the field's unit. Computed when it is first asked
        for."""
        return self.field._vertex_persistence()[self.vertex]

    @property
    def origin(self) -> NDArray[np.int64]:
        """In a comparison (k,): the vertex of the critical point of the input field that each came from; -1
        for those that have none."""
        if self._origins is None:
            raise AttributeError("only the critical points of a comparison are followed to their origins")
        return or_minus_one(self._origins)

    @property
    def counts(self) -> Counts:
        """How many there are of each type."""
        return counts_of(self.type, self.multiplicity)

    @property
    def minima(self) -> CriticalPoints:
        """The minima alone."""
        return self[self.type == MINIMUM]

    @property
    def saddles(self) -> CriticalPoints:
        """The saddles alone."""
        return self[self.type == SADDLE]

    @property
    def maxima(self) -> CriticalPoints:
        """The maxima alone."""
        return self[self.type == MAXIMUM]

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each: vertex, type, multiplicity, value, persistence, x, y, z."""
        import pandas

        position = self.position
        return pandas.DataFrame({
            "vertex": self.vertex, "type": self.type_name, "multiplicity": self.multiplicity,
            "value": self.value, "persistence": self.persistence,
            "x": position[:, 0], "y": position[:, 1], "z": position[:, 2]})

    def plot(self, mesh: Any = None, ax: Any = None) -> Any:
        """Draws the surface with the points on it in matplotlib's 3D axes, which it returns: minima blue,
        saddles green, maxima red. `mesh` is the field's if it is not given."""
        from . import _plots

        return _plots.points(self, mesh, ax)


def _restored(field: Field, array: NDArray[np.void], origins: NDArray[np.uint32] | None) -> CriticalPoints:
    """Of pickle."""
    array.flags.writeable = False
    return CriticalPoints(field, array, origins)


def critical_points(f: Field, *, progress: Progress = None) -> CriticalPoints:
    """The critical points of a field, by the runs of lower neighbours around each vertex (Banchoff 1970; Ni,
    Garland, Hart 2004).

    No lower neighbour makes a minimum, no higher one a maximum, k ≥ 2 runs a saddle of multiplicity k - 1.
    At a boundary each loop counts as capped from above, so that no boundary vertex is a maximum, and on
    every mesh minima - saddle multiplicity + maxima = Euler characteristic. O(n).

    >>> p = ms.critical_points(f)
    >>> p.counts.total, p.vertex[p.type == ms.MAXIMUM]
    """
    with reporting(progress) as report:
        return CriticalPoints(f, _library.critical_points(_field(f)._data, report))


def _field(f: Any) -> Field:
    if not isinstance(f, Field):
        raise TypeError(f"f must be a Field, not a {type(f).__name__}; make one by a Morse function or "
                        "ms.field(mesh, values)")
    return f
