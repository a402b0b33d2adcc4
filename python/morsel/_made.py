"""What functions on one field share: the field that they take, and where their documents are written."""

from __future__ import annotations

import os
from typing import Any, Callable, Union

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._field import Field, evaluate
from ._mesh import PathLike, path_bytes
from ._progress import Progress


Named = Union[str, Callable[..., Field]]


def name_of(named: Named) -> str:
    """A method or Morse function in the program's words: a text, or a function such as ms.salient."""
    if isinstance(named, str):
        return named
    name = getattr(named, "name", None)
    if not isinstance(name, str):
        raise TypeError("methods and Morse functions are texts, or functions such as ms.salient, not "
                        f"{type(named).__name__}")
    return name


def field_of(given: Any, function: str, progress: Progress, level: int) -> Field:
    """A Field as it is, or the Morse function `function` of a mesh."""
    return given if isinstance(given, Field) else evaluate(given, function, progress, level + 1)


def or_minus_one(numbers: NDArray[np.uint32]) -> NDArray[np.int64]:
    """The library's numbers of vertices, -1 where there is none."""
    return np.where(numbers == _library.none, -1, numbers.astype(np.int64))


def mesh_file(mesh: PathLike | None) -> bytes | None:
    """The argument `mesh` of the functions that write documents."""
    return None if mesh is None else path_bytes(mesh)


def ending(path: PathLike) -> str:
    """A path's ending, in small letters."""
    return os.path.splitext(os.fsdecode(path))[1].lower()


def number_text(value: str | float) -> str:
    """A number, length or threshold as the library reads it."""
    return value if isinstance(value, str) else repr(float(value))
