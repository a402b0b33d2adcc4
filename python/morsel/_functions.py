"""Every Morse function and method as a Python function, made from the library's tables of parameters."""

from __future__ import annotations

import inspect
from typing import Any, Callable

from . import _library
from ._field import Field, apply, evaluate
from ._progress import Progress
from ._specification import Parameter, specification

Rows = list[tuple[str, str, str, str, list[str]]]

ON_METHODS = ("target", "count_iterations", "on_iteration", "progress")


def python_name(name: str) -> str:
    """"mean-curvature" as a Python function is called."""
    return name.replace("-", "_")


def parameters_of(rows: Rows) -> dict[str, Parameter]:
    """Rows of the library's tables by the names of arguments."""
    declared = [Parameter(*row) for row in rows]
    return {parameter.argument: parameter for parameter in declared}


def _described(parameters: dict[str, Parameter]) -> str:
    lines = []
    for argument, parameter in parameters.items():
        default = "" if parameter.value is None else f", default {parameter.value!r}"
        lines += [f"{argument} : {parameter.annotation}{default}", f"    {parameter.description}"]
    return "\n".join(lines)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + "."


_EXAMPLES = {"atomic-density": 'surface, structure="1bp2.pdb"', "geodesic": "mesh, source=[0, 7]",
             "vertex-scalar": 'mesh, file="values.txt"'}
"""The arguments of Morse functions that need more than a mesh."""

_DEFAULTS = ("A key may change the defaults of others, as its line says. "
             "All that were taken: {where}.")

_FUNCTION_DOC = """{summary}{unit}

Parameters
----------
mesh : Mesh, or what Mesh() takes
{parameters}
progress : bool or callable
    True shows a bar; a function is called with the step's name and the fraction done.

{defaults}

Returns a Field, one value per vertex (n,). The same bits as --field {name} of the program. Raises
ArgumentError for bad values, InputError where the mesh or a file does not allow it.

>>> f = ms.{python}({example})
"""

_METHOD_DOC = """{summary}

Parameters
----------
f : Field
{parameters}
target : int
    End with so many critical points, or the nearest smaller number.
count_iterations : bool
    Count the critical points of every iteration: Field.steps[-1].iterations.
on_iteration : callable
    Called with the number and the Field of each iteration, of the input first (0); returning False ends the
    method there. With a target the method may be started again, and the numbers with it.
progress : bool or callable
    True shows a bar; a function is called with the step's name and the fraction done.

Lengths are in the mesh's unit, or texts: "8eps" (of 0.3 % of the bounding box's diagonal), "5%" of that,
"3edges" (mean edges), "0.02rootarea". {defaults}
Returns a Field on the same mesh, in the unit of f. The same bits as --method {name} of
the program. Raises ArgumentError for bad values.

>>> g = ms.{python}(f)
"""


def _signature(first: str, kind: str, parameters: dict[str, Parameter]) -> inspect.Signature:
    keyword = inspect.Parameter.KEYWORD_ONLY
    rows = [inspect.Parameter(first, inspect.Parameter.POSITIONAL_OR_KEYWORD,
                              annotation="Mesh" if kind == "function" else "Field")]
    rows += [inspect.Parameter(argument, keyword, default=parameter.value, annotation=parameter.annotation)
             for argument, parameter in parameters.items()]
    if kind == "method":
        rows += [inspect.Parameter("target", keyword, default=None, annotation="int | None"),
                 inspect.Parameter("count_iterations", keyword, default=False, annotation="bool"),
                 inspect.Parameter("on_iteration", keyword, default=None, annotation="OnIteration | None")]
    rows.append(inspect.Parameter("progress", keyword, default=None, annotation="Progress"))
    return inspect.Signature(rows, return_annotation="Field")


def make_function(name: str, summary: str, rows: Rows, module: str = "morsel",
                  unit: str = "") -> Callable[..., Field]:
    """The Python function of a Morse function."""
    parameters = parameters_of(rows)
    signature = _signature("mesh", "function", parameters)

    def call(*args: Any, **keys: Any) -> Field:
        bound = _bind(call.__name__, signature, args, keys)
        progress: Progress = bound.pop("progress", None)
        mesh = bound.pop("mesh")
        return evaluate(mesh, specification(name, parameters, bound), progress, 2)

    doc = _FUNCTION_DOC.format(summary=_sentence(summary), parameters=_described(parameters), name=name,
                               python=python_name(name), example=_EXAMPLES.get(name, "mesh"),
                               unit=f" Unit: {unit}, of the mesh's." if unit else "",
                               defaults=_DEFAULTS.format(where="Field.parameters"))
    return _finished(call, name, doc, signature, parameters, module)


def make_method(name: str, summary: str, rows: Rows, module: str = "morsel") -> Callable[..., Field]:
    """The Python function of a method."""
    parameters = parameters_of(rows)
    signature = _signature("f", "method", parameters)

    def call(*args: Any, **keys: Any) -> Field:
        bound = _bind(call.__name__, signature, args, keys)
        options = {key: bound.pop(key, None) for key in ON_METHODS}
        field = bound.pop("f")
        if not isinstance(field, Field):
            raise TypeError(f"{call.__name__}() takes a Field, not a {type(field).__name__}; make one by "
                            "a Morse function or ms.field(mesh, values)")
        return apply(field, specification(name, parameters, bound), options["target"],
                     options["count_iterations"], options["on_iteration"], options["progress"], 2)

    doc = _METHOD_DOC.format(summary=_sentence(summary), parameters=_described(parameters), name=name,
                             python=python_name(name),
                             defaults=_DEFAULTS.format(where="Field.steps[-1].parameters"))
    return _finished(call, name, doc, signature, parameters, module)


def _bind(name: str, signature: inspect.Signature, args: tuple[Any, ...],
          keys: dict[str, Any]) -> dict[str, Any]:
    """The arguments by name; a TypeError that lists the valid ones for an unknown one."""
    unknown = [key for key in keys if key not in signature.parameters]
    if unknown:
        raise TypeError(f"{name}() has no argument {unknown[0]}; it takes "
                        + ", ".join(signature.parameters))
    try:
        return dict(signature.bind(*args, **keys).arguments)
    except TypeError as error:
        raise TypeError(f"{name}(): {error}") from None


def _finished(call: Callable[..., Field], name: str, doc: str, signature: inspect.Signature,
              parameters: dict[str, Parameter], module: str) -> Callable[..., Field]:
    def spec(**keys: Any) -> str:
        """The function or method with these keys in the program's words, for compare() and the like."""
        for key in keys:
            if key not in parameters:
                raise TypeError(f"{call.__name__} has no key {key}; it has " + ", ".join(parameters))
        return specification(name, parameters, keys)

    call.__name__ = call.__qualname__ = python_name(name)
    call.__doc__ = doc
    call.__module__ = module
    call.__signature__ = signature  # type: ignore[attr-defined]
    call.spec = spec  # type: ignore[attr-defined]
    call.name = name  # type: ignore[attr-defined]
    return call


def shipped() -> dict[str, Callable[..., Field]]:
    """The functions of all that ships, by their Python names."""
    registry = _library.Registry()
    units = registry.units()
    functions = {python_name(row[0]): make_function(*row, unit=units[row[0]])
                 for row in registry.functions()}
    methods = {python_name(row[0]): make_method(*row) for row in registry.methods()}
    return {**functions, **methods}
