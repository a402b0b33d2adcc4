"""Comparisons of methods on one field, and checks of their reports."""

from __future__ import annotations

import os
import sys
from typing import Any, Iterator, Mapping, NamedTuple, Sequence

from . import _library
from ._arguments import Immutable, target_of
from ._chosen import Points, choice, warn_of_fill
from ._complex import MorseSmaleComplex, Segmentation, segmentation_of
from ._errors import ArgumentError
from ._field import Field, warn
from ._made import Named, ending, mesh_file, name_of
from ._mesh import Mesh, PathLike, as_mesh, path_bytes
from ._persistence import Diagram
from ._points import Counts, CriticalPoints
from ._progress import Progress, reporting
from ._registry import registry

class Row(Immutable):
    """What one method gave; a row of a Comparison."""

    __slots__ = ("_made", "specification", "name", "field", "critical_points", "diagram", "complex",
                 "segmentation", "chosen")

    def __init__(self, made: dict[str, Any], mesh: Mesh) -> None:
        self._made = made
        self.specification: str = made["specification"]
        """The method as it was given: "tps:count=salient"."""
        self.name: str = made["name"]
        """"salient+tps"."""
        self.field = Field._of(made["field"], mesh)
        self.critical_points = CriticalPoints(self.field, made["points"], made["origins"])
        """With their origins in the input field."""
        self.diagram = Diagram(self.field, made["diagram"])
        self.complex = MorseSmaleComplex(self.field, made["complex"])
        self.segmentation: Segmentation = segmentation_of(made["segmentation"])
        self.chosen = None if made["chosen"] is None else Points(self.field, made["chosen"])
        """The points that were chosen of the field, if points were asked for."""

    def __repr__(self) -> str:
        return f"<morsel.Row {self.specification}: {self.counts.total:,} critical points>"

    @property
    def counts(self) -> Counts:
        """How many critical points there are of each type."""
        return self.critical_points.counts

    @property
    def numbers(self) -> dict[str, Any]:
        """The table's other numbers: pairs, those above 0.1, 1 and 5 % of the input field's range, arcs,
        cells, kept, moved, added, removed, seconds."""
        made: dict[str, Any] = self._made["summary"]
        return made

    @property
    def timings(self) -> dict[str, float]:
        """Seconds by step."""
        made: dict[str, float] = self._made["timings"]
        return made


class Comparison(Immutable, Sequence[Row]):
    """Several methods on one field, each measured by the same code; made by compare().

    A row for each method: by number, or by the method as it was given or by its name, r["salient"].
    """

    def __init__(self, data: _library.Comparison, mesh: Mesh) -> None:
        self._data = data
        self.mesh = mesh
        self.field = Field._of(data.field, mesh)
        """The field before any method."""
        self._rows = [Row(data.row(i), mesh) for i in range(len(data))]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self._rows)

    def __getitem__(self, which: Any) -> Any:
        if not isinstance(which, str):
            return self._rows[which]
        found = [row for row in self._rows if row.specification == which] or [
            row for row in self._rows if row.name == which]
        if len(found) != 1:
            names = ", ".join(row.specification for row in self._rows)
            raise KeyError(f"there {'are several rows' if found else 'is no row'} {which}; there are {names}")
        return found[0]

    def __repr__(self) -> str:
        return f"<morsel.Comparison: {', '.join(row.specification for row in self._rows)}>"

    def table(self) -> str:
        """The table of `morsel compare`, with the meaning of its columns below."""
        from . import _documents

        return _documents.comparison_table(self._data)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each method, indexed by the methods as they were given."""
        import pandas

        rows = [{**row.counts._asdict(), **row.numbers} for row in self._rows]
        return pandas.DataFrame(rows, index=pandas.Index([row.specification for row in self._rows],
                                                         name="method"))

    def save(self, path: PathLike, *, mesh: PathLike | None = None, items: bool = True,
             progress: Progress = None) -> None:
        """Writes the report (.json, "morsel.comparison/1"), the same as of `morsel compare -o`, or the
        interactive page (.html).

        A report names the mesh's file, so that `morsel check` and ms.check() can make it again. Where the
        mesh is in no file, or the field is of values, `mesh` names one, .off or .ply (for values .ply),
        which they are written to first. Without `items` the critical points and pairs are left out. """
        from . import _documents

        kind = ending(path)
        if kind not in (".json", ".html"):
            raise ArgumentError(f"a comparison is written to .json or .html, not to {os.fsdecode(path)}")
        with reporting(progress) as report:
            if kind == ".html":
                _documents.write_page(self._data, path_bytes(path), mesh_file(mesh), True, report)
            else:
                _documents.write_report(self._data, path_bytes(path), mesh_file(mesh), bool(items), report)

    def export(self, folder: PathLike, *, glb: bool = False, mesh: PathLike | None = None,
               progress: Progress = None) -> None:
        """Writes, for each method, the surface, the complex and its nodes for ParaView (.vtp), the complex as
        a graph (.graphml) and the critical points (.csv) into a folder, as `morsel compare --export` does;
        with `glb` a scene of all that for slides, web pages and Blender, too (.glb)."""
        from . import _documents

        with reporting(progress) as report:
            _documents.export_comparison(self._data, path_bytes(folder), mesh_file(mesh), glb, report)

    def html(self) -> str:
        """The interactive page, in one document that needs no network."""
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "comparison.html")
            self._write_page(path)
            with open(path, encoding="utf-8") as file:
                return file.read()

    def _write_page(self, path: str) -> None:
        """The page, which does not name the temporary file that it is in."""
        from . import _documents

        _documents.write_page(self._data, path_bytes(path), None, False, None)

    def show(self, height: int = 700) -> Any:
        """The interactive page: in a notebook below the cell; elsewhere in the browser, as a file that is
        kept, whose path is returned."""
        if "IPython" in sys.modules:
            from IPython import get_ipython

            shell = get_ipython()
            if shell is not None and hasattr(shell, "kernel"):
                return Shown(self.html(), height)
        import tempfile
        import webbrowser

        handle, path = tempfile.mkstemp(prefix="morsel-", suffix=".html")
        os.close(handle)
        os.unlink(path)
        self._write_page(path)
        webbrowser.open("file://" + path)
        return path

    def _repr_html_(self) -> str:
        from html import escape

        return "<pre>" + escape(self.table()) + "</pre>"

    def plot_counts(self, ax: Any = None) -> Any:
        """Draws the numbers of minima, saddles and maxima of each method in matplotlib's axes, which it
        returns."""
        from . import _plots

        return _plots.counts(self, ax)

    def plot_diagrams(self, axes: Any = None) -> Any:
        """Draws the persistence diagrams side by side; returns their axes."""
        from . import _plots

        return _plots.diagrams(self, axes)


class Shown:
    """A page inside a notebook."""

    def __init__(self, page: str, height: int) -> None:
        self.page = page
        self.height = height

    def _repr_html_(self) -> str:
        from html import escape

        return (f'<iframe srcdoc="{escape(self.page)}" width="100%" height="{int(self.height)}" '
                'style="border:0" sandbox="allow-scripts allow-downloads"></iframe>')


def input_of(mesh: Any, field: Any) -> tuple[Mesh, Any, str | None]:
    """What users may give for the mesh and field of a study: the mesh, the library's field or None, and the
    Morse function's text or None."""
    if isinstance(mesh, Field) and field is None:
        field = mesh
    if isinstance(field, Field):
        if not isinstance(mesh, Field) and as_mesh(mesh) != field.mesh:
            raise ValueError("the field is on another mesh")
        return field.mesh, field._data, None
    return as_mesh(mesh), None, None if field is None else name_of(field)


def compare(mesh: Any, *, field: Field | Named | None = None, methods: Sequence[Named] | None = None,
            preset: str | None = None, target: int | None = None, snap: bool = False,
            points: int | Mapping[str, Any] | None = None, progress: Progress = None) -> Comparison:
    """Runs methods on a field and compares their critical points, diagrams and complexes, as `morsel
    compare` does.

    Parameters
    ----------
    mesh : Mesh, or what Mesh() takes, or a Field
    field : str, function or Field
        A Morse function in the program's words ("height:axis=x"), a function such as ms.height or one made by
        @ms.function, or a Field; by default the mean curvature.
    methods : sequence of str or function
        A row for each: "salient:iterations=5", ms.salient, a chain "salient+tps", a method made by
        @ms.method. "tps:count=salient" takes the number of critical points of an earlier row. By default
        conventional, salient and tps:count=salient.
    preset : str
        Field and methods at once: "paper", "noise", "resampled", "landmarks" or "molecule".
    target : int
        Every method is to end with so many critical points.
    snap : bool
        Report critical points at their origins.
    points : int or dict
        Choose so many points of each row's field (Row.chosen), which table, report, page and exports then
        show; or a dict of arguments of points(): {"count": 20, "rank": "salience"}. Nothing fills up unless
        it has "fill".

    All results are kept in memory. Raises ArgumentError on unknown names and keys and bad values.

    >>> r = ms.compare(mesh, methods=["conventional", "salient", "tps:count=salient"])
    >>> print(r.table()); r["salient"].critical_points
    """
    if preset is not None and (field is not None or methods is not None):
        raise TypeError("a preset sets field and methods: give it without them")
    on, values, function = input_of(mesh, field)
    if preset is not None and values is not None:
        raise TypeError("a preset sets the field: give it a mesh")
    named = None if methods is None else [name_of(method) for method in _listed(methods)]
    keys = {} if points is None else dict(points) if isinstance(points, Mapping) else {"count": points}
    with reporting(progress) as report:
        made = Comparison(_library.compare(on._data, values, function, named, preset, target_of(target),
                                           bool(snap), None if points is None else choice(**keys), registry(),
                                           report),
                          on)
    warn(made.field.function.partition(":")[0] or "values", made.field._data.warnings, 2)
    for row in made:
        for step in row.field.steps:
            warn(step.name, step.warnings, 2)
    if made[0:1] and made[0].chosen is not None:
        warn_of_fill(made[0].chosen, keys.get("fill"), 2)
    return made


def _listed(methods: Sequence[Named]) -> Sequence[Named]:
    if isinstance(methods, str) or callable(methods):
        raise TypeError("methods are a list of methods")
    return methods


class Difference(NamedTuple):
    """Where a report and what it gives now differ."""

    where: str
    before: str
    after: str


def check(path: PathLike, *, progress: Progress = None) -> list[Difference]:
    """Runs a report's comparison, or its study of landmarks, again and returns what changed; empty if
    nothing did. As `morsel check`, with the user's own methods and Morse functions.

    Raises InputError if the mesh or the list of meshes is missing, or the file is not a report or names
    an unknown Morse function or method.

    >>> r.save("report.json"); assert ms.check("report.json") == []
    """
    from . import _documents
    from ._errors import InputError

    with reporting(progress) as report:
        made_of, is_missing, differences = _documents.check(path_bytes(path), registry(), report)
    if is_missing:
        raise InputError(f"{made_of}, which the report is of, is missing")
    return [Difference(*one) for one in differences]
