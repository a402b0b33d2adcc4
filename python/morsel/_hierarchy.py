"""Hierarchies of critical points and Morse-Smale complexes, from fine to coarse."""

from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._arguments import Immutable, listed, place, whole
from ._complex import MorseSmaleComplex, Segmentation, segmentation_of
from ._errors import ArgumentError
from ._field import Field
from ._made import Named, field_of, mesh_file, name_of, number_text, or_minus_one
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


class Level(Immutable):
    """A level of a hierarchy: its critical points, complex and segmentation, and their links."""

    __slots__ = ("_made", "field", "critical_points", "complex", "segmentation", "parents")

    def __init__(self, made: dict[str, Any], field: Field) -> None:
        self._made = made
        self.field = field
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


class Levels(Immutable, Sequence[Level]):
    """The levels of a hierarchy, the finest first; made by hierarchy().

    A sequence: levels[0] is the finest, levels[-1] the coarsest. levels.at(5) is the level after five
    iterations, levels.at("1%") or levels.at(60) the one that was asked for so by persistence.
    """

    def __init__(self, data: _library.Levels, field: Field) -> None:
        self._data = data
        self._levels = []
        for number in range(len(data)):
            made = data.level(number)
            made["place"] = number
            of = field if made["field"] is field._data else Field._of(made["field"], field.mesh)
            self._levels.append(Level(made, of))

    def __len__(self) -> int:
        return len(self._levels)

    def __iter__(self) -> Iterator[Level]:
        return iter(self._levels)

    def __getitem__(self, number: Any) -> Any:
        return self._levels[number]

    def at(self, name: str | float) -> Level:
        """The level that was asked for by this number of iterations or of critical cells, or this
        threshold. Raises KeyError if there is none."""
        for level in self._levels:
            if level.name in (str(name), number_text(name)):
                return level
        raise KeyError(f"there is no level {name}; there are " + ", ".join(one.name for one in self._levels))

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


class PersistenceHierarchy(Immutable):
    """All complexes between that of a field and the one with nothing left to cancel; made by hierarchy().

    h[150] is the first one with at most 150 critical cells (minima, saddles with their multiplicities,
    maxima), h.at("1%") or h["1%"] the one without pairs of at most that persistence. """

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

    def __getitem__(self, count: int | str) -> MorseSmaleComplex:
        if isinstance(count, str):
            return self.at(count)
        number = whole(count, "the number of critical cells", -2**63, 2**63 - 1)
        if number < 1:
            raise IndexError(f"a complex has at least one critical cell, not {number}")
        return self._complex(self._data.level_with(number))

    def at(self, persistence: str | float) -> MorseSmaleComplex:
        """The complex in which all pairs of at most this persistence are cancelled, in the field's unit or,
        as in "1%", of its range."""
        threshold = _library.threshold(self.field._data, number_text(persistence))
        return self._complex(self._data.level_above(threshold))

    def after(self, cancellations: int) -> MorseSmaleComplex:
        """The complex after so many cancellations."""
        return self._complex(self._checked(cancellations))

    def counts(self, cancellations: int) -> tuple[int, int, int]:
        """Minima, saddles with their multiplicities and maxima after so many cancellations. O(1)."""
        return self._data.counts(self._checked(cancellations))

    def levels(self, *, persistence: Sequence[str | float] = (), counts: Sequence[int] = (),
               progress: Progress = None) -> Levels:
        """Several levels with the links between them: at thresholds, or at numbers of critical cells. By
        default at 0.1 %, 1 % and 5 % of the field's range."""
        with reporting(progress) as report:
            thresholds = [number_text(one) for one in listed(persistence, "thresholds of persistence")]
            numbers = [str(whole(one, "a number of critical cells")) for one in listed(counts, "counts")]
            made = self._data.linked(",".join(thresholds), ",".join(numbers), registry(), report)
        return Levels(made, self.field)

    def _checked(self, cancellations: int) -> int:
        return place(cancellations, "the number of cancellations", self._data.levels)

    def _complex(self, level: int) -> MorseSmaleComplex:
        return MorseSmaleComplex(self.field, self._data.complex_at(level, None))


def hierarchy(f: Any, *, by: str = "persistence", method: Named | None = None,
              levels: Sequence[int] | None = None, progress: Progress = None) -> Any:
    """A hierarchy of critical points and Morse-Smale complexes.

    Parameters
    ----------
    f : Field, or a mesh for its mean curvature
    by : "persistence" or "iteration"
        Persistence: what cancelling pairs leaves of the field's complex (Edelsbrunner, Harer, Zomorodian
        2003; Bremer, Edelsbrunner, Hamann, Pascucci 2004); a PersistenceHierarchy. Iteration: the fields
        that the method passes through (the paper's Figure 4), critical points followed from one to the
        next; Levels.
    method : str or function
        By iteration alone: a method or chain, in the program's words, of which the last one iterates;
        salient by default.
    levels : sequence of int
        By iteration alone: the numbers of the iterations; 0 is the method's input; 1, 5 and 10 by default.

    The same as `morsel hierarchy`, whose default is by iteration. Raises ArgumentError for a method that has
    no iterations or too few.

    >>> ms.hierarchy(f)[150].arcs
    >>> ms.hierarchy(f, by="iteration", levels=[1, 5, 10]).at(5).critical_points
    """
    if by not in ("persistence", "iteration"):
        raise ArgumentError(f'a hierarchy is by "persistence" or by "iteration", not by "{by}"')
    if by == "persistence" and (method is not None or levels is not None):
        raise ArgumentError('method and levels are for by="iteration"; by persistence apply methods to the '
                            "field, and take levels of the hierarchy: h[150], h.at(\"1%\"), h.levels(…)")
    asked = (1, 5, 10) if levels is None else listed(levels, "levels")
    numbers = [str(whole(one, "a level")) for one in asked]
    if not numbers:
        raise ArgumentError("there are no levels")
    steps = "salient" if method is None else name_of(method)
    field = field_of(f, "mean-curvature", progress, 2)
    with reporting(progress) as report:
        if by == "persistence":
            return PersistenceHierarchy(field, _library.hierarchy(field._data, report))
        made = _library.iteration_levels(field._data, steps, ",".join(numbers), registry(), report)
        return Levels(made, field)
