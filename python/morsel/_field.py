"""Scalar fields: a value for each vertex, and the order of the vertices that they induce."""

from __future__ import annotations

import warnings as _warnings
from typing import Any, Callable, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _interop, _library
from ._arguments import Immutable, target_of
from ._errors import ArgumentError, MorselWarning
from ._mesh import Mesh, PathLike, as_mesh, path_bytes
from ._progress import Progress, reporting
from ._registry import registry

OnIteration = Callable[[int, "Field"], Optional[bool]]


class End(NamedTuple):
    """How many iterations a method ran, and what ended them."""

    iterations_run: int
    stopped_by: str
    """"iterations", the key of another condition ("change"), or "caller": what on_iteration returned."""


class Step(NamedTuple):
    """What one method of a chain did."""

    name: str
    parameters: dict[str, Any]
    """All of them, as resolved on the mesh: a sigma of "8eps" in the mesh's unit."""
    details: dict[str, Any]
    """Further details of the run: {"iterations_run": 7}."""
    iterations: NDArray[np.void]
    """If they were counted, a record of each, from the input on: iteration, minima, saddles,
    saddle_multiplicity, maxima, change."""
    warnings: list[str]
    """What the method could not do here."""
    end: End | None
    """Of a method that iterates."""
    sigma: float | None
    """The standard deviation of the weight of distances, in the mesh's unit, of a method that averages by
    one."""


class Target(NamedTuple):
    """How a wanted number of critical points was reached."""

    wanted: int
    reached: int
    iterations: int
    """Of the method that the field had (1 if it has none)."""
    left_by_next: int | None
    """Critical points after one more iteration, if that was too few."""
    before_cancelling: int
    """Critical points of the method's field."""
    cancelled: NDArray[np.void]
    """The pairs that were cancelled then, as Diagram.pairs."""
    largest_cancelled: float
    """The largest persistence among them, in the field's unit."""
    unfolded: NDArray[np.uint32]
    """Multiple saddles that were unfolded, where a pair too many had to be cancelled."""
    largest_unfolding: float
    note: str
    """Why another number was reached; empty if it was not."""
    early_end: str
    """What an iterative method's next iteration would have left; empty if it was run to its end."""


def warn(name: str, texts: list[str], level: int) -> None:
    """Issues warnings of a Morse function or method; `level` as of warnings.warn() in the caller."""
    for text in texts:
        _warnings.warn(f"{name}: {text}", MorselWarning, stacklevel=level + 1)


class Field(Immutable):
    """A scalar field on a mesh: one finite value per vertex, and the total order of the vertices.

    Vertices are compared by (value, vertex number), unless a method, such as persistence simplification,
    defines an order of its own. Made by Morse functions (ms.mean_curvature(mesh), …), of values
    (ms.field(mesh, values)) and by methods (ms.salient(f), f.apply(…)). Immutable. An array of its values for
    numpy: np.asarray(f).
    """

    __slots__ = ("_data", "_mesh", "_persistence", "__weakref__")

    def __init__(self, *_: Any) -> None:
        raise TypeError("a Field is made by ms.field(mesh, values) or a Morse function")

    @classmethod
    def _of(cls, data: _library.Field, mesh: Mesh | None = None) -> Field:
        field = object.__new__(cls)
        field._data = data
        field._mesh = mesh if mesh is not None else Mesh._of(data.mesh)
        field._persistence = None
        return field

    def _vertex_persistence(self) -> NDArray[np.float64]:
        """The persistence of each critical vertex (n,), 0 of all others; kept."""
        if self._persistence is None:
            self._persistence = _library.persistence(self._data, None).vertex_persistence(len(self))
        return self._persistence

    def __reduce__(self) -> Any:
        return _restored, (self._mesh, _library.field_state(self._data))

    def __repr__(self) -> str:
        made = self.function or "values"
        method = f", {self.method}" if self.method else ""
        return f"<morsel.Field: {made}{method}, {self.min:.6g} to {self.max:.6g} on {len(self):,} vertices>"

    _data: _library.Field
    _mesh: Mesh
    _persistence: NDArray[np.float64] | None

    def __len__(self) -> int:
        return self._mesh.vertex_count

    def __array__(self, dtype: Any = None) -> NDArray[Any]:
        return np.asarray(self.values, dtype)

    def __neg__(self) -> Field:
        """The negated values with the order reversed exactly, ties included."""
        return Field._of(self._data.negated(), self._mesh)

    @property
    def mesh(self) -> Mesh:
        """The mesh that it is on."""
        return self._mesh

    @property
    def values(self) -> NDArray[np.float64]:
        """Values (n,), read-only, in the field's memory."""
        return self._data.values

    @property
    def ranks(self) -> NDArray[np.uint32]:
        """Per vertex (n,): its place in the order; 0 is the lowest."""
        return self._data.ranks

    @property
    def order(self) -> NDArray[np.uint32]:
        """The vertices (n,) from the lowest to the highest."""
        return self._data.order

    @property
    def min(self) -> float:
        """The least value."""
        return self._data.min

    @property
    def max(self) -> float:
        """The greatest value."""
        return self._data.max

    @property
    def extent(self) -> float:
        """max - min, the range of the values."""
        return self.max - self.min

    @property
    def function(self) -> str:
        """The Morse function with the keys that were given: "height:axis=x"; empty for values."""
        return self._data.function

    @property
    def method(self) -> str:
        """The chain of methods that was applied: "salient:iterations=5+tps"; empty for none."""
        return self._data.method

    @property
    def parameters(self) -> dict[str, Any]:
        """The Morse function's parameters as resolved on the mesh."""
        return self._data.parameters

    @property
    def steps(self) -> list[Step]:
        """The methods that were applied, with their resolved parameters."""
        return [Step(*step[:5], None if step[5] is None else End(*step[5]), step[6])
                for step in self._data.steps]

    @property
    def target(self) -> Target | None:
        """How the wanted number of critical points was reached, if one was wanted."""
        reached = self._data.reached
        return None if reached is None else Target(**reached)

    @property
    def input(self) -> Field:
        """The field before any method."""
        return Field._of(self._data.input, self._mesh)

    @property
    def warnings(self) -> list[str]:
        """What the values do not mean on this mesh, and what methods could not do."""
        return self._data.warnings + [text for step in self.steps for text in step.warnings]

    def apply(self, methods: str | Callable[..., Field], *, target: int | None = None,
              count_iterations: bool = False, on_iteration: OnIteration | None = None,
              progress: Progress = None) -> Field:
        """Applies a method or a chain of methods, in the program's words.

        Parameters
        ----------
        methods : str or function
            "salient:iterations=5+tps:count=150", or a function such as ms.salient. help(ms.salient) tells
            the keys of a method.
        target : int
            End with so many critical points, or the nearest smaller number: as much of the last method as
            leaves enough of them, persistence cancellation for the rest. `Field.target` tells how.
        count_iterations : bool
            Count the critical points of every iteration: Field.steps[-1].iterations.
        on_iteration : callable
            Called with the number and the Field of each iteration of the last method, of its input first
            (0); returning False ends the method there. With a target a method may be started again, and the
            numbers with it.
        progress : bool or callable
            True shows a bar; a function is called with the step's name and the fraction done, and ends the
            work by returning False.

        Raises ArgumentError on unknown names and keys and bad values.

        >>> f.apply("salient:iterations=5+tps:count=150", target=150)
        """
        from ._made import name_of

        return apply(self, name_of(methods), target, count_iterations, on_iteration, progress, 2)

    def save(self, path: PathLike, *, progress: Progress = None) -> None:
        """Writes the field: .txt (a value a line), .ply, .vtp (the surface with the values) or .glb (the
        surface in colours, with the critical points), as `morsel field` does; vertices have the numbers of
        the file or arrays that the mesh was made from."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_field(self._data, path_bytes(path), registry(), report)


def apply(field: Field, methods: str, target: int | None, count_iterations: bool,
          on_iteration: OnIteration | None, progress: Progress, level: int) -> Field:
    """Field.apply(); `level` as of warnings.warn() in the caller."""
    def called(number: int, data: _library.Field) -> bool | None:
        assert on_iteration is not None
        return on_iteration(number, Field._of(data, field.mesh))

    with reporting(progress) as report:
        made = Field._of(_library.apply(field._data, methods, target_of(target), bool(count_iterations),
                                        None if on_iteration is None else called, registry(), report),
                         field.mesh)
    for step in made.steps[len(field._data.steps):]:
        warn(step.name, step.warnings, level + 1)
    return made


def evaluate(mesh: Any, specification: str, progress: Progress, level: int) -> Field:
    """A Morse function by its text; `level` as of warnings.warn() in the caller."""
    on = as_mesh(mesh)
    with reporting(progress) as report:
        made = Field._of(_library.evaluate(on._data, specification, registry(), report), on)
    warn(specification.partition(":")[0], made._data.warnings, level + 1)
    return made


def field(mesh: Any, values: ArrayLike | str | Field, *, ranks: ArrayLike | None = None, name: str = "values",
          numbering: str | None = None, progress: Progress = None) -> Field:
    """A field of values, or of a Morse function in the program's words.

    Parameters
    ----------
    mesh : Mesh, or what Mesh() takes
    values : array_like (n,), or str, or Field
        A finite value for each vertex of the mesh, or of the arrays or file that it was made from, where
        repair has changed their number. Or a text: "height:axis=x". A Field on the same mesh is returned
        as it is, with its order.
    ranks : array_like (n,)
        An order of one's own: a permutation of 0 … n - 1 along which values never decrease. By default
        vertices are ordered by (value, vertex number).
    name : str
        The name of the values as a property of a PLY file, in reports.
    numbering : "mesh" or "input"
        Whose vertex numbers the values have, where that is not clear from their number.

    Raises ValueError for a wrong shape or type, InputError for values that are not finite.

    >>> f = ms.field(mesh, mesh.vertices[:, 2])
    >>> f = ms.field(mesh, "height:axis=x")
    """
    if isinstance(values, str):
        if ranks is not None or numbering is not None:
            raise TypeError("ranks and numbering are for values, not for a Morse function")
        return evaluate(mesh, values, progress, 2)
    on = as_mesh(mesh)
    if isinstance(values, Field):
        return _whole(on, values, ranks is None and numbering is None and name == "values")
    given = _interop.array(values, "the values")
    given = by_vertex(on, given, numbering)
    order = None if ranks is None else _interop.array(ranks, "the ranks")
    return Field._of(_library.given(on._data, given, order, str(name)), on)


def _restored(mesh: Mesh, state: tuple[Any, ...]) -> Field:
    """Of pickle."""
    return Field._of(_library.restored_field(mesh._data, state), mesh)


def _whole(mesh: Mesh, given: Field, is_alone: bool) -> Field:
    """A Field that was given for values."""
    if given.mesh != mesh:
        raise ValueError("the field is on another mesh; its values alone are FIELD.values")
    if not is_alone:
        raise TypeError("ranks, name and numbering are for values, not for a Field; its values alone are "
                        "FIELD.values")
    return given


def by_vertex(mesh: Mesh, values: NDArray[Any], numbering: str | None) -> NDArray[Any]:
    """Values in the mesh's numbers; of another shape as they are, which the library refuses."""
    if values.ndim != 1:
        return values
    inputs = mesh._data.input_count
    if numbering not in (None, "mesh", "input"):
        raise ArgumentError(f'the numbering must be "mesh" or "input", not "{numbering}"')
    if numbering is None:
        if len(values) == inputs == mesh.vertex_count and mesh._data.is_renumbered:
            raise ValueError('repair has renumbered the vertices without changing their number: say '
                             'numbering="mesh" or numbering="input"')
        numbering = "input" if len(values) == inputs != mesh.vertex_count else "mesh"
    expected = inputs if numbering == "input" else mesh.vertex_count
    if len(values) != expected:
        raise ValueError(f"there are {len(values):,} values, but {expected:,} vertices")
    return values[mesh.input_vertices] if numbering == "input" and mesh._data.is_renumbered else values
