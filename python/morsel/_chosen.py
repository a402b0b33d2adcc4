"""Chosen points: exactly as many critical points as asked for, that stand out and lie apart."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable, whole
from ._field import Field, warn
from ._made import Named, field_of, mesh_file, name_of, number_text
from ._mesh import PathLike, path_bytes
from ._points import Counts, counts_of, type_names
from ._progress import Progress, reporting
from ._registry import registry


class Points(Immutable):
    """Chosen critical points, in the order in which they were chosen; made by points()."""

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Points) -> None:
        self.field = field
        self._data = data

    def __len__(self) -> int:
        return len(self.vertex)

    def __repr__(self) -> str:
        return f"<morsel.Points: {len(self):,}, at least {self.spacing:.6g} apart>"

    @property
    def vertex(self) -> NDArray[np.uint32]:
        """Numbers of vertices (k,)."""
        return self._data.vertex

    @property
    def type(self) -> NDArray[np.uint8]:
        """MINIMUM (1), SADDLE (2) or MAXIMUM (3) (k,)."""
        return self._data.type

    @property
    def type_name(self) -> NDArray[np.str_]:
        """ "minimum", "saddle" or "maximum" (k,)."""
        return type_names(self.type)

    @property
    def counts(self) -> Counts:
        """How many there are of each type."""
        return counts_of(self.type, self.multiplicity)

    @property
    def multiplicity(self) -> NDArray[np.uint32]:
        """Multiplicities of saddles (k,)."""
        return self._data.multiplicity

    @property
    def value(self) -> NDArray[np.float64]:
        """The field there (k,); of the field that fills up, its own."""
        return self._data.value

    @property
    def persistence(self) -> NDArray[np.float64]:
        """Persistence (k,), infinite for what is essential."""
        return self._data.persistence

    @property
    def rank(self) -> NDArray[np.float64]:
        """What they were chosen by (k,), in the field's unit."""
        return self._data.rank

    @property
    def distance(self) -> NDArray[np.float64]:
        """Along the surface to the nearest other one (k,), in the mesh's unit."""
        return self._data.distance

    @property
    def percentile(self) -> NDArray[np.float64]:
        """The share of all vertices that have less mesh saliency (k,); nan unless percentiles were asked
        for."""
        return self._data.percentile

    @property
    def is_fill(self) -> NDArray[np.bool_]:
        """Which are of the field that fills up (k,)."""
        return np.asarray(self._data.source != 0)

    @property
    def position(self) -> NDArray[np.float64]:
        """Where they are (k, 3)."""
        return self.field.mesh.vertices[self.vertex]

    @property
    def spacing(self) -> float:
        """The least distance that was wanted, in the mesh's unit."""
        return self._data.spacing

    @property
    def candidates(self) -> list[int]:
        """How many points there were to choose from: of the field, and of the one that fills up."""
        return self._data.candidates

    @property
    def note(self) -> str:
        """Why there are fewer than asked for; empty if there are not."""
        return self._data.note

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each point."""
        import pandas

        position = self.position
        return pandas.DataFrame({
            "vertex": self.vertex, "type": self.type_name,
            "value": self.value, "persistence": self.persistence, "rank": self.rank,
            "distance": self.distance, "percentile": self.percentile, "is_fill": self.is_fill,
            "x": position[:, 0], "y": position[:, 1], "z": position[:, 2]})

    def plot(self, mesh: Any = None, ax: Any = None) -> Any:
        """Draws the surface with the points on it, as CriticalPoints.plot()."""
        from . import _plots

        return _plots.points(self, mesh, ax)

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes .csv, .json, .ply, .vtp or .glb as `morsel points` does.

        `mesh` is a file, .ply or .off, that the mesh is written to first where it has none.
        """
        from . import _documents

        with reporting(progress) as report:
            _documents.write_points(self._data, path_bytes(path), mesh_file(mesh), registry(), report)


def choice(count: int = 20, kind: str = "extrema", rank: str = "persistence", spacing: str | float = "5%",
           fill: Named | None = None, scale: str | float | None = None,
           percentiles: bool = False) -> dict[str, Any]:
    """How points are chosen, as the library reads it."""
    wanted = {"count": whole(count, "the number of points", 0), "kind": kind, "rank": rank,
              "spacing": number_text(spacing), "percentiles": bool(percentiles)}
    if fill is not None:
        wanted["fill"] = name_of(fill)
    if scale is not None:
        wanted["scale"] = number_text(scale)
    return wanted


def warn_of_fill(made: Points, fill: Named | None, level: int) -> None:
    """Warns of what the field that filled up does not mean."""
    if fill is not None:
        warn(name_of(fill).partition(":")[0], made._data.fill_warnings, level + 1)


def points(f: Any, count: int = 20, *, kind: str = "extrema", rank: str = "persistence",
           spacing: str | float = "5%", fill: Named | None = _library.fill_field,
           scale: str | float | None = None, percentiles: bool = False,
           progress: Progress = None) -> Points:
    """Chooses critical points of a field that stand out and lie apart, greedily by rank.

    Parameters
    ----------
    f : Field, or a mesh for its diffused Gaussian curvature
    count : int
        How many; `Points.note` tells why there are fewer.
    kind : "extrema", "maxima", "minima", "saddles" or "all"
    rank : "persistence" or "salience"
        Salience is persistence times the mesh saliency of the surface there (Lee, Varshney, Jacobs 2005).
    spacing : float or str
        The least distance of two points along the surface.
    fill : str, function or None
        A Morse function whose points come after those of the field, where these are too few.
    scale : float or str
        How far salience is smoothed; by default the last method's sigma, or 8eps.
    percentiles : bool
        Measure how salient the surface is at each point, Points.percentile; takes as long as ms.saliency().

    The same as `morsel points`. Raises ArgumentError for bad values.

    >>> ms.points(mesh, 50, spacing="5%").position
    """
    wanted = choice(count, kind, rank, spacing, fill, scale, percentiles)
    field = field_of(f, _library.points_field, progress, 2)
    with reporting(progress) as report:
        made = Points(field, _library.choose_points(field._data, wanted, registry(), report))
    warn_of_fill(made, fill, 2)
    return made
