"""Morse functions and methods of the user, written in Python."""

from __future__ import annotations

import inspect
from typing import Any, Callable

import numpy as np

from . import _interop, _library
from ._field import Field
from ._functions import ON_METHODS, make_function, make_method
from ._mesh import Mesh
from ._registry import add, registry


class Length(str):
    """A length as the default of a parameter: Length("8eps"). The function gets it in the mesh's unit."""


class File(str):
    """A path as the default of a parameter: File(""). Reports hash the file."""


def _check_name(name: Any, kind: str) -> None:
    if not isinstance(name, str):
        raise TypeError(f'a {kind} of one\'s own has a name: @ms.{kind}("mine")')


def _module(own: Callable[..., Any]) -> str:
    return getattr(own, "__module__", None) or "__main__"


_TYPES = (bool, np.bool_, int, np.integer, float, np.floating, str)


def _declared(own: Any, name: str, given: dict[str, Any], taken: tuple[str, ...]) -> dict[str, Any]:
    """The parameters with their defaults: those of the decorator, then those of the function. A TypeError
    where it cannot be called with them, or their names, `taken`, are those of other arguments."""
    if not callable(own):
        raise TypeError(f"{name} must be a function, not a {type(own).__name__}")
    try:
        signature = inspect.signature(own)
    except ValueError:  # of a function that is written in C
        signature = inspect.Signature([inspect.Parameter("input", inspect.Parameter.POSITIONAL_ONLY),
                                       inspect.Parameter("keys", inspect.Parameter.VAR_KEYWORD)])
    positional_only = inspect.Parameter.POSITIONAL_ONLY
    defaults = {key: one.default for key, one in list(signature.parameters.items())[1:]
                if isinstance(one.default, _TYPES) and one.kind is not positional_only}
    declared = {**given, **{key: value for key, value in defaults.items() if key not in given}}
    for key in declared:
        if key in taken:
            raise TypeError(f"{name} cannot have a parameter {key}: that is another argument of all such "
                            "functions")
    try:
        signature.bind(None, **declared)
    except TypeError as error:
        raise TypeError(f"{name} cannot be called with an input and its parameters: {error}") from None
    return declared


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


def _result(made: Any, name: str) -> Any:
    """What a function returned, as the library takes it."""
    if isinstance(made, Field):
        return made._data
    values = made if isinstance(made, np.ma.MaskedArray) else np.asarray(made)
    if values.ndim == 0:
        return made  # which the library refuses
    return _interop.array(values, f"the values that {name} returns")


def _summary(function: Callable[..., Any], name: str) -> str:
    lines = (function.__doc__ or "").strip().splitlines()
    return lines[0].rstrip(".") if lines else name


def _arguments(values: dict[str, Any]) -> dict[str, Any]:
    return {key.replace("-", "_"): value for key, value in values.items()}


def function(name: str, /, *, descriptions: dict[str, str] | None = None,
             **parameters: Any) -> Callable[[Callable[..., Any]], Callable[..., Field]]:
    """Makes a Python function a Morse function, with its parameters and their defaults.

    The function gets a Mesh and the parameters as keywords, and returns an array (n,) of finite values, or
    a Field. The Mesh that it gets is that of the computation, in its own numbers: its path is empty. It
    becomes a function like ms.height, and has a name for compare(), sweep(), stability() and the like.
    Adding one of the same name replaces it. The types of the parameters are those of their
    defaults: numbers, True or False, texts, ms.Length("8eps"), ms.File("") for a file that it reads.
    Parameters that only the function gives such defaults are parameters, too.

    >>> @ms.function("radius", power=1.0)
    ... def radius(mesh, power):
    ...     return np.linalg.norm(mesh.vertices - mesh.vertices.mean(axis=0), axis=1) ** power
    >>> f = radius(mesh);  r = ms.compare(mesh, field="radius:power=2")
    """
    _check_name(name, "function")

    def decorate(own: Callable[..., Any]) -> Callable[..., Field]:
        def call(data: _library.Mesh, values: dict[str, Any]) -> Any:
            return _result(own(Mesh._of(data), **_arguments(values)), name)

        declared = _declared(own, name, parameters, ("mesh", "progress"))
        add("function", name, _summary(own, name), _rows(declared, descriptions or {}), call)
        row = next(row for row in registry().functions() if row[0] == name)
        return _wrapped(make_function(*row, module=_module(own)), own)

    return decorate


def method(name: str, /, *, descriptions: dict[str, str] | None = None,
           **parameters: Any) -> Callable[[Callable[..., Any]], Callable[..., Field]]:
    """Makes a Python function a method, with its parameters and their defaults.

    The function gets a Field and the parameters as keywords, and returns an array (n,) of finite values, or
    a Field on the same mesh, whose order is kept. The Field that it gets is that of the computation, in the
    mesh's own numbers: f.function, f.steps and f.mesh.path are empty. It becomes a function like ms.salient,
    and has a name for Field.apply(), compare(), targets, reports and the like. Adding one of the same name
    replaces it. The types of the parameters are those of their defaults: numbers, True or False, texts,
    ms.Length("8eps"). Parameters that only the function gives such defaults are parameters, too.

    It is always called on the thread that asked for the work. Of a study that runs on several threads,
    calls come one after the other.

    >>> @ms.method("mine", strength=1.0)
    ... def mine(f, strength):
    ...     return np.abs(f.values) ** strength
    >>> g = mine(f, strength=2.0);  r = ms.compare(mesh, methods=["salient", "mine:strength=0.5"])
    """
    _check_name(name, "method")

    def decorate(own: Callable[..., Any]) -> Callable[..., Field]:
        def call(data: _library.Field, values: dict[str, Any]) -> Any:
            return _result(own(Field._of(data), **_arguments(values)), name)

        declared = _declared(own, name, parameters, ("f", *ON_METHODS))
        add("method", name, _summary(own, name), _rows(declared, descriptions or {}), call)
        row = next(row for row in registry().methods() if row[0] == name)
        return _wrapped(make_method(*row, module=_module(own)), own)

    return decorate


def _wrapped(made: Callable[..., Field], own: Callable[..., Any]) -> Callable[..., Field]:
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
