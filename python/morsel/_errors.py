"""The exceptions of the package: what the library refuses, in one clear sentence each."""

from __future__ import annotations

from dataclasses import dataclass


class Error(Exception):
    """Base of all errors of morsel. Its text says what, where, how many, and what would help."""


class ArgumentError(Error, ValueError):
    """A parameter out of range, or an unknown name or key."""


class InputError(Error, ValueError):
    """A file, mesh or field that is missing, damaged or refused."""


class WriteError(Error, OSError):
    """A file that could not be written. What was there before is unchanged."""


class Cancelled(Error):
    """A computation whose progress function returned False."""


@dataclass(frozen=True)
class Defect:
    """One kind of defect of a mesh."""

    kind: str
    """Its name: "non_manifold_edge", "duplicate_face", …"""
    count: int
    """How many there are."""
    first: list[int]
    """The first few: numbers of vertices or of faces, two vertices for each edge."""
    description: str
    """All this as a clause."""


class MeshError(InputError):
    """A mesh that breaks a rule; `defects` has every kind of defect, of type Defect."""

    def __init__(self, message: str, defects: list[tuple[str, int, list[int], str]] | None = None) -> None:
        super().__init__(message)
        self.defects = [Defect(*defect) for defect in defects or ()]


class MorselWarning(UserWarning):
    """What values do not mean on a mesh, or what a method could not do there."""
