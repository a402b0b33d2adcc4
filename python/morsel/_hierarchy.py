"""Hierarchies of critical points and Morse-Smale complexes, from fine to coarse."""

from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._complex import MorseSmaleComplex, Segmentation, segmentation_of
from ._errors import ArgumentError
from ._field import Field
from ._made import field_of, mesh_file, number_text, or_minus_one
from ._mesh import PathLike, path_bytes
from ._points import Counts, CriticalPoints
from ._progress import Progress, reporting
from ._registry import registry


class Links(NamedTuple):
    """How the cells of a level lie in those of the levels beside it, by label."""

    areas: NDArray[np.float64]
    parents: NDArray[np.void]
    """A structured array (segment, area): the cell of the finer level that each shares the most area with;
    2³² - 1 where there is none."""
    merges_into: NDArray[np.void]
    """The same of the coarser level."""


class Level:
    """A level of a hierarchy: its critical points, complex and segmentation, and their links."""

    __slots__ = ("_made", "field", "critical_points", "complex", "segmentation", "parents")

    def __init__(self, made: dict[str, Any], mesh: Any) -> None:
        self._made = made
        self.field = Field._of(made["field"], mesh)
        """The field; by persistence the same one for all levels."""
        self.critical_points = CriticalPoints(self.field, made["points"])
        """Its critical points: by persistence those that are left, with the values of the field."""
        self.complex = MorseSmaleComplex(self.field, made["complex"])
        self.segmentation: Segmentation = segmentation_of(made["segmentation"])
        self.parents = or_minus_one(made["parents"])
        """Per critical point (k,): the vertex of the one of the finer level that it came from; -1 for
        none."""

    def __repr__(self) -> str:
        return f"<morsel.Level {self.name}: {len(self.critical_points):,} critical points>"

    @property
    def name(self) -> str:
        """As asked for: "5", "0.1%", "150"."""
        made: str = self._made["name"]
        return made

    @property
    def note(self) -> str:
        """Why it is another level than was asked for; empty if it is not."""
        made: str = self._made["note"]
        return made

    @property
    def iteration(self) -> int | None:
        """The number of the iteration, by iteration."""
        made: int | None = self._made["iteration"]
        return made

    @property
    def cancellations(self) -> int | None:
        """How many pairs are cancelled, by persistence."""
        made: int | None = self._made["cancellations"]
        return made

    @property
    def largest_persistence(self) -> float | None:
        """The largest persistence among those, in the field's unit."""
        made: float | None = self._made["largest_persistence"]
        return made

    @property
    def persistence(self) -> NDArray[np.float64]:
        """Per critical point (k,): that at which it goes; infinite for what stays."""
        made: NDArray[np.float64] = self._made["persistence"]
        return made

    @property
    def status(self) -> NDArray[np.str_]:
        """Per critical point (k,): "first" (of the finest level), "kept", "moved" or "new"."""
        if self._made["place"] == 0:
            return np.full(len(self.parents), "first")
        kept = self.parents == self.critical_points.vertex
        return np.where(self.parents < 0, "new", np.where(kept, "kept", "moved"))

    @property
    def nodes(self) -> NDArray[np.void]:
        """The complex's nodes."""
        return self.complex.nodes

    @property
    def arcs(self) -> NDArray[np.void]:
        """The complex's arcs."""
        return self.complex.arcs

    @property
    def counts(self) -> Counts:
        """How many critical points there are of each type."""
        return self.critical_points.counts

    @property
    def cell_count(self) -> int:
        """Quads of the complex that have area."""
        made: int = self._made["cell_count"]
        return made

    def links(self, kind: str = "morse_smale") -> Links:
        """The links of the cells: "descending", "ascending" or "morse_smale"."""
        if kind not in ("descending", "ascending", "morse_smale"):
            raise ArgumentError(f'cells are "descending", "ascending" or "morse_smale", not "{kind}"')
        return Links(*self._made["links_" + kind])


class Levels(Sequence[Level]):
    """The levels of a hierarchy, the finest first; made by hierarchy().

    By iteration levels[5] is the level after five iterations; list(levels) are all of them.
    """

    def __init__(self, data: _library.Levels, mesh: Any) -> None:
        self._data = data
        self._levels = []
        for place in range(len(data)):
            made = data.level(place)
            made["place"] = place
            self._levels.append(Level(made, mesh))

    def __len__(self) -> int:
        return len(self._levels)

    def __iter__(self) -> Iterator[Level]:
        return iter(self._levels)

    def __getitem__(self, number: Any) -> Any:
        for level in self._levels:
            if number == (level.iteration if level.iteration is not None else level.name):
                return level
        if isinstance(number, str) or any(level.iteration is not None for level in self._levels):
            names = ", ".join(level.name for level in self._levels)
            raise KeyError(f"there is no level {number}; there are {names}")
        return self._levels[number]

    def __repr__(self) -> str:
        return "<morsel.Levels: " + ", ".join(level.name for level in self._levels) + ">"

    def save(self, path: PathLike, *, mesh: PathLike | None = None, items: bool = True,
             progress: Progress = None) -> None:
        """Writes levels and links as JSON ("morsel.hierarchy/1"), as `morsel hierarchy` does; they are made
        again.

        `mesh` is a file that the mesh is written to first where it has none. Without `items`, what is listed
        one by one is left out.
        """
        from . import _documents

        with reporting(progress) as report:
            _documents.write_hierarchy(self._data, path_bytes(path), mesh_file(mesh), bool(items), registry(),
                                       report)

    def export(self, folder: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes, for each level, the surface and the complex for ParaView (.vtp) into a folder, as `morsel
        hierarchy --export` does; they are made again. `mesh` is as of save()."""
        from . import _documents

        with reporting(progress) as report:
            _documents.export_hierarchy(self._data, path_bytes(folder), mesh_file(mesh), registry(), report)


class PersistenceHierarchy:
    """All complexes between that of a field and the one with nothing left to cancel; made by hierarchy().

    h[150] is the first one with at most 150 critical cells (minima, saddles with their multiplicities,
    maxima), h.at("1%") the one without pairs of at most that persistence. """

    __slots__ = ("field", "_data")

    def __init__(self, field: Field, data: _library.Hierarchy) -> None:
        self.field = field
        self._data = data

    def __repr__(self) -> str:
        return f"<morsel.PersistenceHierarchy: {self._data.levels:,} cancellations>"

    @property
    def cancellations(self) -> NDArray[np.void]:
        """A structured array (arc, extremum, survivor, persistence), in order: the arc of the saddle that
        goes with the extremum, and the nodes of the extremum and of the one that takes over its arcs."""
        return self._data.cancellations

    def __getitem__(self, count: int) -> MorseSmaleComplex:
        if count < 1:
            raise IndexError(f"a complex has at least one critical cell, not {count}")
        return self._complex(self._data.level_with(count))

    def at(self, persistence: str | float) -> MorseSmaleComplex:
        """The complex in which all pairs of at most this persistence are cancelled, in the field's unit or,
        as in "1%", of its range."""
        threshold = _library.threshold(self.field._data, number_text(persistence))
        return self._complex(self._data.level_above(threshold))

    def after(self, cancellations: int) -> MorseSmaleComplex:
        """The complex after so many cancellations."""
        if cancellations < 0:
            raise IndexError(f"cancellations are counted from 0 on, not {cancellations}")
        return self._complex(cancellations)

    def counts(self, cancellations: int) -> tuple[int, int, int]:
        """Minima, saddles with their multiplicities and maxima after so many cancellations. O(1)."""
        return self._data.counts(cancellations)

    def levels(self, *, persistence: Sequence[str | float] = (), counts: Sequence[int] = (),
               progress: Progress = None) -> Levels:
        """Several levels with the links between them: at thresholds, or at numbers of critical cells. By
        default at 0.1 %, 1 % and 5 % of the field's range."""
        with reporting(progress) as report:
            made = self._data.linked(",".join(number_text(one) for one in persistence),
                                     ",".join(str(one) for one in counts), registry(), report)
        return Levels(made, self.field.mesh)

    def _complex(self, level: int) -> MorseSmaleComplex:
        return MorseSmaleComplex(self.field, self._data.complex_at(level, None))


def hierarchy(f: Any, *, by: str = "persistence", method: str = "salient", levels: Sequence[int] = (1, 5, 10),
              progress: Progress = None) -> Any:
    """A hierarchy of critical points and Morse-Smale complexes.

    Parameters
    ----------
    f : Field, or a mesh for its mean curvature
    by : "persistence" or "iteration"
        Persistence: what cancelling pairs leaves of the field's complex (Edelsbrunner, Harer, Zomorodian
        2003; Bremer, Edelsbrunner, Hamann, Pascucci 2004); a PersistenceHierarchy. Iteration: the fields
        that the method passes through (the paper's Figure 4), critical points followed from one to the
        next; Levels.
    method : str
        By iteration: a method or chain, in the program's words, of which the last one iterates.
    levels : sequence of int
        By iteration: the numbers of the iterations; 0 is the method's input.

    The same as `morsel hierarchy`. Raises ArgumentError for a method that has no iterations or too few.

    >>> ms.hierarchy(f)[150].arcs
    >>> ms.hierarchy(f, by="iteration", levels=[1, 5, 10])[5].critical_points
    """
    field = field_of(f, "mean-curvature", progress, 2)
    with reporting(progress) as report:
        if by == "persistence":
            return PersistenceHierarchy(field, _library.hierarchy(field._data, report))
        if by != "iteration":
            raise ArgumentError(f'a hierarchy is by "persistence" or by "iteration", not by "{by}"')
        numbers = ",".join(str(one) for one in levels)
        if not numbers:
            raise ArgumentError("there are no levels")
        return Levels(_library.iteration_levels(field._data, method, numbers, registry(), report), field.mesh)
