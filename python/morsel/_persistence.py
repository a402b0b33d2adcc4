"""Persistence diagrams."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable
from ._field import Field
from ._made import number_text
from ._points import _field
from ._progress import Progress, reporting

MINIMUM_SADDLE = 0
SADDLE_MAXIMUM = 1
SADDLE_CAP = 2


class Diagram(Immutable):
    """The persistence pairs of a field; made by persistence()."""

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Diagram) -> None:
        self.field = field
        self._data = data

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        return (f"<morsel.Diagram: {self._data.finite_count:,} finite pairs, "
                f"{len(self) - self._data.finite_count:,} with boundary loops>")

    @property
    def pairs(self) -> NDArray[np.void]:
        """A structured array (extremum, saddle, kind, birth, death), by ascending persistence: the finite
        pairs, then those with caps. `extremum` and `saddle` are vertices (of a cap the number of its
        boundary loop); `kind` is MINIMUM_SADDLE (0), SADDLE_MAXIMUM (1) or SADDLE_CAP (2). Read-only, in
        the diagram's memory. """
        return self._data.pairs

    @property
    def birth_death(self) -> NDArray[np.float64]:
        """Birth and death (k, 2) of the pairs, in their order and memory; the death of a cap is infinite."""
        return self._data.birth_death

    @property
    def persistence(self) -> NDArray[np.float64]:
        """Death - birth (k,), ascending, in the field's unit."""
        return self.birth_death[:, 1] - self.birth_death[:, 0]

    @property
    def dimension(self) -> NDArray[np.int64]:
        """The dimension of each pair's class (k,): 0 of minima, 1 of maxima and caps."""
        return np.asarray(self.pairs["kind"] != MINIMUM_SADDLE, np.int64)

    @property
    def finite(self) -> NDArray[np.float64]:
        """birth_death of the finite pairs alone (k, 2), for programs that take no infinite ones."""
        return self.birth_death[:self._data.finite_count]

    @property
    def essential_extrema(self) -> NDArray[np.void]:
        """A structured array (minimum, top, top_is_cap) with a row for each component of the mesh: its lowest
        vertex, and its highest or, of a bounded one, its last boundary loop."""
        return self._data.essential_extrema

    @property
    def essential_saddles(self) -> NDArray[np.void]:
        """A structured array (vertex, count): saddles that are paired with nothing, twice the genus in
        all."""
        return self._data.essential_saddles

    def count_above(self, threshold: str | float) -> int:
        """How many finite pairs have more persistence than this, in the field's unit or, as in "1%", of its
        range."""
        least = _library.threshold(self.field._data, number_text(threshold))
        return int(np.count_nonzero(self.persistence[:self._data.finite_count] > least))

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each pair: extremum, saddle, kind, birth, death, persistence."""
        import pandas

        kinds = np.array(["minimum-saddle", "saddle-maximum", "saddle-cap"])[self.pairs["kind"]]
        return pandas.DataFrame({
            "extremum": self.pairs["extremum"], "saddle": self.pairs["saddle"], "kind": kinds,
            "birth": self.pairs["birth"], "death": self.pairs["death"], "persistence": self.persistence})

    def plot(self, ax: Any = None) -> Any:
        """Draws the diagram in matplotlib's axes, which it returns: minima blue, maxima red."""
        from . import _plots

        return _plots.diagram(self, ax)


def persistence(f: Field, *, progress: Progress = None) -> Diagram:
    """The extremum-saddle pairs of a field, in the sense of its lower-star filtration (Edelsbrunner,
    Letscher, Zomorodian 2002), boundary loops capped at infinity.

    Pairs + essential saddles = saddle multiplicity, component by component. O(n), and nearly linear in the
    number of saddles.

    >>> d = ms.persistence(f)
    >>> gudhi.bottleneck_distance(d.finite, other.finite)
    """
    with reporting(progress) as report:
        return Diagram(f, _library.persistence(_field(f)._data, report))
