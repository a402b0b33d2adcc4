"""The number of threads."""

from __future__ import annotations

from . import _library
from ._arguments import whole


class threads:
    """Limits the number of threads within a `with` block; no result depends on it.

    The limit holds for the whole process: for what other threads of Python compute meanwhile, too.
    Of nested blocks the smallest number holds. More threads than processors are allowed. Raises
    ArgumentError for a number below 1.

    >>> with ms.threads(4):
    ...     g = ms.salient(f)
    """

    def __init__(self, count: int) -> None:
        self._limit = _library.Threads(whole(count, "the number of threads"))

    def __enter__(self) -> threads:
        self._limit.begin()
        return self

    def __exit__(self, *_: object) -> None:
        self._limit.end()


def thread_count() -> int:
    """The number of threads that computations may use now.

    >>> with ms.threads(1):
    ...     ms.thread_count()
    1
    """
    return _library.thread_count()
