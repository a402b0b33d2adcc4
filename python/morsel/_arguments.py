"""What the arguments of several functions have in common: whole numbers, sequences, objects that stay as they
are."""

from __future__ import annotations

import operator
from typing import Any, Iterable

from ._errors import ArgumentError


def _number(value: Any, what: str) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{what} must be a whole number, not {value!r:.60}") from None


def whole(value: Any, what: str, least: int = -2**31, most: int = 2**31 - 1) -> int:
    """A whole number in a range; `what` names it in errors. TypeError for what is none, ArgumentError for one
    that is out of range."""
    number = _number(value, what)
    if not least <= number <= most:
        raise ArgumentError(f"{what} must be {f'{least} or more' if number < least else f'{most} or less'}, "
                            f"not {number}")
    return number


def place(value: Any, what: str, most: int) -> int:
    """A number from 0 to `most`, of something that exists; IndexError where there is none."""
    number = _number(value, what)
    if not 0 <= number <= most:
        raise IndexError(f"{what} must be between 0 and {most}, not {number}")
    return number


def target_of(value: Any) -> int | None:
    """The argument `target`; None for none."""
    return None if value is None else whole(value, "the target", 1, 2**63 - 1)


def listed(values: Any, what: str) -> Iterable[Any]:
    """A sequence; TypeError for a single text or number."""
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise TypeError(f"{what} are a sequence, such as [{values!r:.30}]")
    made: Iterable[Any] = values
    return made


class Immutable:
    """What never changes is its own copy."""

    __slots__ = ()

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, _: Any) -> Any:
        return self
