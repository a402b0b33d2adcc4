"""The Morse functions and methods that can be named: what ships, and those of the user."""

from __future__ import annotations

from typing import Any, Callable

from . import _library

_registry = _library.Registry()
_own: dict[tuple[str, str], tuple[Any, ...]] = {}


def registry() -> _library.Registry:
    """What names stand for. It is not changed, but replaced, when users add something."""
    return _registry


def add(kind: str, name: str, summary: str, parameters: list[tuple[str, str, Any, str]],
        call: Callable[..., Any]) -> None:
    """Adds a Morse function (kind "function") or a method ("method") of the user; one of the same name that
    they added before is replaced, so that a notebook's cell may be run again. Raises ArgumentError for a
    name that ships with the library or is none."""
    global _registry
    own: dict[tuple[str, str], tuple[Any, ...]] = {**_own, (kind, name): (summary, parameters, call)}
    made = _library.Registry()
    for (of, what), entry in own.items():
        (made.add_function if of == "function" else made.add_method)(what, *entry)
    _own.clear()
    _own.update(own)
    _registry = made
