"""The Morse functions and methods that ship, as functions. _shipped.pyi, which python/make_stub writes, has
their signatures for type checkers."""

from ._functions import shipped

_functions = shipped()
globals().update(_functions)
__all__ = list(_functions)
