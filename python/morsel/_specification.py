"""Names with their keys as the library reads them: "salient:iterations=5,sigma=8eps"."""

from __future__ import annotations

import keyword
import operator
import os
from typing import Any, NamedTuple

import numpy as np

from . import _library


class Parameter(NamedTuple):
    """A key of a Morse function or method."""

    key: str
    kind: str
    """"number", "count", "length", "flag", "choice", "text" or "list"."""
    default: str
    """As text; empty where there is none."""
    description: str
    choices: list[str]

    @property
    def argument(self) -> str:
        """Its name as an argument of a Python function."""
        name = self.key.replace("-", "_")
        return name + "_" if keyword.iskeyword(name) else name

    @property
    def value(self) -> Any:
        """Its default as Python has it; None where there is none."""
        if self.kind == "flag":
            return self.default == "yes"
        if self.kind == "count":
            return int(self.default)
        if self.kind == "number" or (self.kind == "length" and _is_number(self.default)):
            return float(self.default)
        return None if self.kind in ("text", "list") and self.default in ("", "none") else self.default

    @property
    def annotation(self) -> str:
        """Its type in a signature."""
        of_kind = {"number": "float | str", "count": "int", "length": "float | str", "flag": "bool",
                   "choice": "str", "text": "float | str | PathLike[str]",
                   "list": "str | Sequence[float | str | PathLike[str]]"}[self.kind]
        return of_kind + (" | None" if self.value is None else "")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def text_of(parameter: Parameter, value: Any) -> str:
    """A value as the library reads it."""
    kind = parameter.kind
    if isinstance(value, (bool, np.bool_)):
        if kind != "flag":
            raise TypeError(f"{parameter.argument} is {_phrase(kind)}, not {bool(value)}")
        return "yes" if value else "no"
    if kind == "list" and not isinstance(value, (str, os.PathLike)):
        items = value if np.iterable(value) else [value]
        return "/".join(_library.escape(_word(parameter, item)) for item in items)
    if isinstance(value, str):
        # A list, a number or a length is written as in the program; of texts separators are taken literally.
        return _library.escape(value) if kind in ("text", "choice") else value
    return _library.escape(_word(parameter, value))


def _word(parameter: Parameter, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    try:
        return str(operator.index(value))
    except TypeError:
        pass
    if isinstance(value, (float, np.floating)):
        if parameter.kind == "count" and float(value).is_integer():
            return str(int(value))
        return repr(float(value))
    raise TypeError(f"{parameter.argument} is {_phrase(parameter.kind)}, not a {type(value).__name__}")


def _phrase(kind: str) -> str:
    return {"number": "a number", "count": "a whole number", "length": "a length", "flag": "True or False",
            "choice": "a word", "text": "a text", "list": "a list"}[kind]


def specification(name: str, parameters: dict[str, Parameter], given: dict[str, Any]) -> str:
    """A name with the arguments that were given; None stands for one that was not."""
    keys = [f"{parameters[argument].key}={text_of(parameters[argument], value)}"
            for argument, value in given.items() if value is not None]
    return name + (":" + ",".join(keys) if keys else "")
