"""Sweeps over parameters, and the stability of critical points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence, Union

import numpy as np

from . import _library
from ._arguments import target_of, whole
from ._comparison import input_of
from ._field import Field, warn
from ._made import Named, mesh_file, name_of, number_text
from ._mesh import PathLike, path_bytes
from ._progress import Progress, reporting
from ._registry import registry
from ._rows import Rows

Values = Union[str, Sequence[Union[str, float, bool]], range]


def _word(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value.replace(",", "\\,")
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    return repr(float(value))


def _variation(key: str, values: Values) -> str:
    """"sigma=2eps,4eps" in the program's words."""
    if not isinstance(values, str):
        values = ",".join(_word(value) for value in values)
    return f"{key}={values}"


class Sweep(Rows):
    """The results of a sweep, a dict for each combination; made by sweep()."""

    def __init__(self, data: _library.Sweep) -> None:
        self._data = data
        super().__init__([data.row(i) for i in range(len(data))])

    def __repr__(self) -> str:
        return f"<morsel.Sweep over {', '.join(self.keys)}: {len(self):,} combinations>"

    @property
    def keys(self) -> list[str]:
        """The keys that vary."""
        return self._data.keys

    def table(self) -> str:
        """The table of `morsel sweep`."""
        from . import _documents

        return _documents.sweep_table(self._data)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each combination; values that are numbers are numbers."""
        import pandas

        frame = pandas.DataFrame(self._rows)
        for key in self.keys:
            try:
                frame[key] = pandas.to_numeric(frame[key])
            except ValueError:
                pass  # texts
        return frame

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes .json ("morsel.sweep/1") or .csv, as `morsel sweep` does. `mesh` is a file that the mesh
        is written to first where it has none."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_sweep(self._data, path_bytes(path), mesh_file(mesh), report)

    def plot(self, key: str | None = None, ax: Any = None) -> Any:
        """Draws the number of critical points against a key that varies, by default the first; a line for
        each combination of the others. Returns matplotlib's axes."""
        from . import _plots

        return _plots.sweep(self, key, ax)


def sweep(mesh: Any, vary: Mapping[str, Values], *, field: Field | Named | None = None,
          method: Named = "salient", progress: Progress = None) -> Sweep:
    """A field and a method with every combination of some of their parameters' values, as `morsel sweep`.

    Parameters
    ----------
    mesh : Mesh, or what Mesh() takes, or a Field
    vary : dict
        The values of each key: a sequence, or a text ("1..10", "2eps..16eps..x2"). A key is one of the method
        or of the field; where several have it, it is "field.KEY", "NAME.KEY" or, with the number of the step,
        "2.KEY".
    field, method
        In the program's words, or functions such as ms.height and ms.salient.

    Common work is done once. Raises ArgumentError on unknown keys and bad values.

    >>> s = ms.sweep(mesh, {"iterations": range(1, 11), "sigma": ["4eps", "8eps"]}); s.to_pandas()
    """
    on, values, function = input_of(mesh, field)
    texts = [_variation(key, of) for key, of in vary.items()]
    with reporting(progress) as report:
        made = Sweep(_library.sweep(on._data, values, function or "mean-curvature", name_of(method), texts,
                                    registry(), report))
    told = {(row["field"].partition(":")[0], text)
            for i, row in enumerate(made) for text in made._data.warnings(i)}
    for name, text in sorted(told):
        warn(name, [text], 2)
    return made


@dataclass(frozen=True)
class Estimate:
    """The mean of a quantity over trials."""

    mean: float
    """NaN where no trial has a value: the drift where no point was found again."""
    half_width: float | None
    """Of the 95 % confidence interval; None for fewer than two trials."""
    count: int


def _estimate(mean: float, half_width: float | None, count: int) -> Estimate:
    return Estimate(mean if count else float("nan"), half_width, count)


_ESTIMATES = ("recall", "precision", "f_score", "chance", "drift", "found")


class Stability(Rows):
    """How well critical points repeat on perturbed surfaces; made by stability().

    A dict for each field, method, count and perturbation: field, method, target, perturbation, amount,
    trials, clean (critical points of the clean surface), agreement (the share of them that the reference
    has, too), and Estimates over the trials: recall (repeatability), precision, f_score, chance (the
    F-score of as many random points), drift (mean distance of matched points, in mean edge lengths), found
    (number of points).
    """

    def __init__(self, data: _library.Stability) -> None:
        self._data = data
        super().__init__([{key: _estimate(*value) if key in _ESTIMATES else value
                           for key, value in row.items()} for row in data.rows()])

    def __repr__(self) -> str:
        return f"<morsel.Stability: {len(self):,} rows, seed {self.seed}>"

    @property
    def seed(self) -> int:
        """The seed of the trials."""
        return self._data.seed

    @property
    def radius(self) -> float:
        """Within which points match, in the mesh's unit."""
        return self._data.radius

    @property
    def mean_edge_length(self) -> float:
        """Of the clean mesh, in its unit: that of drift and of the amounts of noise."""
        return self._data.mean_edge_length

    def table(self) -> str:
        """The table of `morsel stability`."""
        from . import _documents

        return _documents.stability_table(self._data)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each; of estimates KEY and KEY_half_width."""
        import pandas

        rows = []
        for row in self._rows:
            flat = {}
            for key, value in row.items():
                if key in _ESTIMATES:
                    flat[key] = value.mean
                    flat[key + "_half_width"] = float("nan") if value.half_width is None else value.half_width
                else:
                    flat[key] = value
            rows.append(flat)
        return pandas.DataFrame(rows)

    def save(self, path: PathLike, *, mesh: PathLike | None = None, progress: Progress = None) -> None:
        """Writes .json ("morsel.stability/1", every trial) or .csv, as `morsel stability` does. `mesh` is a
        file that the mesh is written to first where it has none."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_stability(self._data, path_bytes(path), mesh_file(mesh), report)

    def plot(self, quantity: str = "f_score", perturbation: str | None = None, ax: Any = None) -> Any:
        """Draws a quantity against the amount of one kind of perturbation ("noise", "decimation" or
        "subdivision", by default the first that the study has): a line for each field, method and count with
        its confidence intervals. Returns matplotlib's axes."""
        from . import _plots

        return _plots.stability(self, quantity, perturbation, ax)


def stability(mesh: Any, *, fields: Sequence[Named] | None = None, methods: Sequence[Named] | None = None,
              preset: str | None = None, noise: Sequence[float] = (), kind: str = "normal",
              decimate: Sequence[float] = (), subdivide: Sequence[int] = (), trials: int = 10, seed: int = 1,
              target: int | None = None, radius: str | float | None = None, points: str = "all",
              reference: Named = "conventional", reference_field: Named | None = None,
              progress: Progress = None) -> Stability:
    """How well critical points repeat on perturbed surfaces, as `morsel stability`.

    Parameters
    ----------
    mesh : Mesh, or what Mesh() takes, or a Field
    fields, methods : sequences of str or function
        By default the mean curvature; conventional, salient and tps.
    preset : str
        Fields and methods at once, as of compare(), for `target` points.
    noise : sequence of float
        Standard deviations of Gaussian noise, in mean edge lengths, along normals (kind "normal") or in x,
        y and z ("isotropic"). If no perturbation is given: 0.05, 0.15, 0.3, 0.5.
    decimate : sequence of float
        Shares of the vertices that are left after decimation.
    subdivide : sequence of int
        Pieces that every edge is cut into.
    trials, seed : int
        Of each random perturbation.
    target : int
        Besides each method's own count: end with so many critical points.
    radius : str or float
        Points match within this length on the clean mesh, by default "0.02rootarea".
    points : "all" or "extrema"
    reference, reference_field
        The method that agreement is measured with, and its field, by default each row's own.

    The same numbers as the program's for the same seed. Raises ArgumentError for bad values.

    >>> ms.stability(mesh, noise=[0.1, 0.3], trials=5).to_pandas()
    """
    if preset is not None and (fields is not None or methods is not None):
        raise TypeError("a preset sets fields and methods: give it without them")
    on, values, _ = input_of(mesh, None)
    if preset is not None and values is not None:
        raise TypeError("a preset sets the field: give it a mesh")
    request: dict[str, Any] = {
        "noise": [float(one) for one in noise], "kind": kind, "decimate": [float(one) for one in decimate],
        "subdivide": [float(one) for one in subdivide], "trials": whole(trials, "the number of trials"),
        "seed": whole(seed, "the seed", 0, 2**64 - 1), "target": target_of(target),
        "preset": preset, "points": points, "reference": name_of(reference)}
    if radius is not None:
        request["radius"] = number_text(radius)
    if fields is not None:
        if values is not None:
            raise TypeError("give a mesh with fields, or a Field alone")
        request["fields"] = [name_of(one) for one in fields]
    if methods is not None:
        request["methods"] = [name_of(one) for one in methods]
    if reference_field is not None:
        request["reference_field"] = name_of(reference_field)
    with reporting(progress) as report:
        made = Stability(_library.stability(on._data, values, request, registry(), report))
    for name, texts in made._data.warnings():
        warn(name, texts, 2)
    return made
