"""Morse functions and methods of the user, written in Python."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from . import _library
from ._errors import ArgumentError
from ._field import Field
from ._functions import make_function, make_method
from ._mesh import Mesh
from ._registry import add, registry


class Length(str):
    """A length as the default of a parameter: Length("8eps"). The function gets it in the mesh's unit."""


class File(str):
    """A path as the default of a parameter: File(""). Reports hash the file."""


def _kind(key: str, default: Any) -> tuple[str, Any]:
    if isinstance(default, (bool, np.bool_)):
        return "flag", bool(default)
    if isinstance(default, Length):
        return "length", str(default)
    if isinstance(default, File):
        return "file", str(default)
    if isinstance(default, (int, np.integer)):
        return "count", int(default)
    if isinstance(default, (float, np.floating)):
        return "number", float(default)
    if isinstance(default, str):
        return "text", default
    raise TypeError(f"the default of {key} must be a number, True or False, a text or a Length, not a "
                    f"{type(default).__name__}")


def _rows(parameters: dict[str, Any], descriptions: dict[str, str]) -> list[tuple[str, str, Any, str]]:
    unknown = set(descriptions) - set(parameters)
    if unknown:
        raise TypeError(f"there is a description of {sorted(unknown)[0]}, which is no parameter")
    return [(key.replace("_", "-"), *_kind(key, default), descriptions.get(key, "")) for key, default
            in parameters.items()]


def _result(made: Any) -> Any:
    """What a function returned, as the library takes it."""
    if isinstance(made, Field):
        return made._data
    values = np.asarray(made)
    return made if values.ndim == 0 else values  # which the library refuses


def _summary(function: Callable[..., Any], name: str) -> str:
    lines = (function.__doc__ or "").strip().splitlines()
    return lines[0].rstrip(".") if lines else name


def _arguments(values: dict[str, Any]) -> dict[str, Any]:
    return {key.replace("-", "_"): value for key, value in values.items()}


def function(name: str, *, descriptions: dict[str, str] | None = None,
             **parameters: Any) -> Callable[[Callable[..., Any]], Callable[..., Field]]:
    """Makes a Python function a Morse function, with its parameters and their defaults.

    The function gets a Mesh and the parameters as keywords, and returns an array (n,) of finite values, or
    a Field. The Mesh that it gets is that of the computation, in its own numbers: its path is empty. It
    becomes a function like ms.height, and has a name for compare(), sweep(), stability() and the like.
    Adding one of the same name replaces it. The types of the parameters are those of their
    defaults: numbers, True or False, texts, ms.Length("8eps"), ms.File("") for a file that it reads.

    >>> @ms.function("radius", power=1.0)
    ... def radius(mesh, power):
    ...     return np.linalg.norm(mesh.vertices - mesh.vertices.mean(axis=0), axis=1) ** power
    >>> f = radius(mesh);  r = ms.compare(mesh, field="radius:power=2")
    """
    def decorate(own: Callable[..., Any]) -> Callable[..., Field]:
        def call(data: _library.Mesh, values: dict[str, Any]) -> Any:
            return _result(own(Mesh._of(data), **_arguments(values)))

        add("function", name, _summary(own, name), _rows(parameters, descriptions or {}), call)
        row = next(row for row in registry().functions() if row[0] == name)
        return _wrapped(make_function(*row, module=own.__module__), own)

    return decorate


def method(name: str, *, descriptions: dict[str, str] | None = None,
           **parameters: Any) -> Callable[[Callable[..., Any]], Callable[..., Field]]:
    """Makes a Python function a method, with its parameters and their defaults.

    The function gets a Field and the parameters as keywords, and returns an array (n,) of finite values, or
    a Field on the same mesh, whose order is kept. The Field that it gets is that of the computation, in the
    mesh's own numbers: f.function, f.steps and f.mesh.path are empty. It becomes a function like ms.salient,
    and has a name for Field.apply(), compare(), targets, reports and the like. Adding one of the same name
    replaces it. The types of the parameters are those of their defaults: numbers, True or False, texts,
    ms.Length("8eps").

    It is always called on the thread that asked for the work. Of a study that runs on several threads,
    calls come one after the other.

    >>> @ms.method("mine", strength=1.0)
    ... def mine(f, strength):
    ...     return np.abs(f.values) ** strength
    >>> g = mine(f, strength=2.0);  r = ms.compare(mesh, methods=["salient", "mine:strength=0.5"])
    """
    def decorate(own: Callable[..., Any]) -> Callable[..., Field]:
        def call(data: _library.Field, values: dict[str, Any]) -> Any:
            return _result(own(Field._of(data), **_arguments(values)))

        add("method", name, _summary(own, name), _rows(parameters, descriptions or {}), call)
        row = next(row for row in registry().methods() if row[0] == name)
        return _wrapped(make_method(*row, module=own.__module__), own)

    return decorate


def _wrapped(made: Callable[..., Field], own: Callable[..., Any]) -> Callable[..., Field]:
    if not callable(own):
        raise ArgumentError("a decorator is for functions")
    made.__doc__ = (own.__doc__ or "") + "\n\n" + (made.__doc__ or "")
    made.__wrapped_function__ = own  # type: ignore[attr-defined]
    return made


def functions() -> dict[str, str]:
    """The Morse functions that can be named, with a line on each; ms.NAME has the keys.

    >>> ms.functions()["height"]
    'distance along an axis or a direction'
    """
    return {name: summary for name, summary, _ in registry().functions()}


def methods() -> dict[str, str]:
    """The methods that can be named, with a line on each; ms.NAME has the keys.

    >>> "salient" in ms.methods()
    True
    """
    return {name: summary for name, summary, _ in registry().methods()}


def presets() -> dict[str, tuple[str, str, list[str]]]:
    """Purpose, field and methods of each preset of compare().

    >>> purpose, field, methods = ms.presets()["noise"]
    """
    return {name: (purpose, field, methods) for name, purpose, field, methods in _library.presets()}
