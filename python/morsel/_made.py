"""What functions on one field share: the field that they take, and where their documents are written."""

from __future__ import annotations

import os
from typing import Any

from ._field import Field, evaluate
from ._mesh import PathLike, path_bytes
from ._progress import Progress


def field_of(given: Any, function: str, progress: Progress, level: int) -> Field:
    """A Field as it is, or the Morse function `function` of a mesh."""
    return given if isinstance(given, Field) else evaluate(given, function, progress, level + 1)


def mesh_file(mesh: PathLike | None) -> bytes | None:
    """The argument `mesh` of the functions that write documents."""
    return None if mesh is None else path_bytes(mesh)


def ending(path: PathLike) -> str:
    """A path's ending, in small letters."""
    return os.path.splitext(os.fsdecode(path))[1].lower()


def number_text(value: str | float) -> str:
    """A number, length or threshold as the library reads it."""
    return value if isinstance(value, str) else repr(float(value))
