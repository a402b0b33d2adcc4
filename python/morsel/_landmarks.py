"""Chosen points compared with those that people marked."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _interop
from ._arguments import place, whole
from ._chosen import choice
from ._field import warn
from ._made import Named, name_of, number_text
from ._mesh import PathLike, Weld, as_mesh, mask_text, path_bytes, weld_text
from ._progress import Progress, reporting
from ._registry import registry
from ._rows import Rows

if TYPE_CHECKING:
    from . import _documents

Marked = Union[PathLike, Sequence["tuple[Any, Any]"]]


class MeshMean(NamedTuple):
    """The mean of a quantity over meshes, each of which counts alike."""

    mean: float
    low: float | None
    """Of the 95 % bootstrap interval; None of a single mesh."""
    high: float | None


class Marks(NamedTuple):
    """What a row of a study of landmarks has on one mesh."""

    name: str
    """Of the row."""
    points: NDArray[np.uint32]
    """The chosen vertices, in the numbers of the mesh's file; none of random ones."""
    f_score: float
    """Of hits."""
    note: str
    """Why there are fewer points than wanted; empty if there are not."""


class Landmarks(Rows):
    """How well chosen critical points agree with points that people marked; made by landmarks().

    A dict for each field and method, then for random vertices and farthest points: name, field, method (None
    of the two rows of chance), fewer (meshes with fewer points than wanted), distance (of matched pairs in
    radii, None without any), and MeshMeans: points, recall, precision, f_score (of hits within the radius),
    matched_recall, matched_precision, matched_f_score (of pairs one to one), false_negatives,
    false_positives (Dutagaci, Cheung, Godil 2012), f_score_gain (over the first row).
    """

    def __init__(self, data: _documents.Landmarks) -> None:
        self._data = data
        super().__init__([{key: MeshMean(*value) if isinstance(value, tuple) else value
                           for key, value in row.items()} for row in data.rows()])

    def __repr__(self) -> str:
        return f"<morsel.Landmarks: {len(self):,} rows, {self.mesh_count:,} meshes, seed {self.seed}>"

    @property
    def mesh_count(self) -> int:
        """Number of meshes."""
        return len(self._data)

    @property
    def seed(self) -> int:
        """The seed of the random points and of the intervals."""
        return self._data.seed

    def on_mesh(self, i: int) -> list[Marks]:
        """What each row has on the mesh of number i."""
        rows = self._data.on_mesh(place(i, "the number of the mesh", self.mesh_count - 1))[2]
        return [Marks(row["name"], *of) for row, of in zip(self._rows, rows)]

    def table(self) -> str:
        """The table of `morsel landmarks`."""
        return self._data.table()

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each; of means KEY, KEY_low and KEY_high."""
        import pandas

        rows = []
        for row in self._rows:
            flat: dict[str, Any] = {}
            for key, value in row.items():
                if isinstance(value, MeshMean):
                    ends = [float("nan") if end is None else end for end in value[1:]]
                    flat.update({key: value.mean, key + "_low": ends[0], key + "_high": ends[1]})
                else:
                    flat[key] = value
            rows.append(flat)
        return pandas.DataFrame(rows)

    def save(self, path: PathLike, *, progress: Progress = None) -> None:
        """Writes .json ("morsel.landmarks/1", every mesh; `morsel check` and ms.check() make it again) or
        .csv, as `morsel landmarks` does. Only of a list of files, which the documents name."""
        from . import _documents

        with reporting(progress) as report:
            _documents.write_landmarks(self._data, path_bytes(path), report)


def landmarks(marked: Marked, *, fields: Sequence[Named] | None = None,
              methods: Sequence[Named] | None = None, points: int | None = None, kind: str = "extrema",
              rank: str = "persistence", spacing: str | float = "5%", fill: Named | None = None,
              scale: str | float | None = None, radius: str | float = "5%",
              largest_radius: str | float = "12%", first: int = 0, repair: bool = False, weld: Weld = None,
              mask: PathLike | None = None, resamples: int = 10000, seed: int = 1,
              progress: Progress = None) -> Landmarks:
    """How well chosen critical points agree with points that people marked, as `morsel landmarks`.

    Parameters
    ----------
    marked : path, or sequence of pairs (mesh, vertices)
        The list that `morsel landmarks` reads, or meshes and the numbers of their marked vertices.
    fields, methods : sequences of str or function
        By default the diffused Gaussian curvature; conventional.
    points : int
        Points on each mesh, by default as many as it has marks.
    kind, rank, spacing, fill, scale
        As of points(); nothing fills up by default.
    radius, largest_radius : str or float
        Of a hit, along the surface; and up to which errors are counted in the document.
    first, repair, weld, mask
        Of a list: the number of a file's first vertex, 0 or 1; and whether meshes are repaired, their
        vertices joined and vertices left out, as of read().
    resamples, seed : int
        Of the intervals; the seed is that of the random points, too.

    Methods and Morse functions written in Python are called on other threads than the one that asked, one
    call after the other. The same numbers as the program's for the same seed. Raises ArgumentError for bad
    values, InputError for files that cannot be read.

    >>> ms.landmarks([(mesh, marks)], methods=["conventional", "salient"]).table()
    """
    from . import _documents

    request: dict[str, Any] = {
        "choice": choice(kind=kind, rank=rank, spacing=spacing, fill=fill, scale=scale),
        "points": None if points is None else whole(points, "the number of points", 0),
        "radius": number_text(radius), "largest_radius": number_text(largest_radius),
        "first": whole(first, "first"),
        "resamples": whole(resamples, "the number of resamples"),
        "seed": whole(seed, "the seed", 0, 2**64 - 1)}
    if fields is not None:
        request["fields"] = [name_of(one) for one in fields]
    if methods is not None:
        request["methods"] = [name_of(one) for one in methods]
    with reporting(progress) as report:
        if isinstance(marked, (str, os.PathLike)):
            data = _documents.landmarks_of_list(path_bytes(marked), bool(repair), weld_text(weld),
                                                mask_text(mask), request, registry(), report)
        else:
            pairs = [(as_mesh(mesh)._data, _interop.array(vertices, "the marked vertices"))
                     for mesh, vertices in marked]
            data = _documents.landmarks_of_meshes(pairs, request, registry(), report)
    for what, texts in data.warnings():
        warn(what, texts, 2)
    return Landmarks(data)
