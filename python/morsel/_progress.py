"""How computations report their progress."""

from __future__ import annotations

import sys
from typing import Callable, Optional, Union

Report = Callable[[str, float], Optional[bool]]
Progress = Union[None, bool, Report]


class _Bar:
    """A line on standard error that shows the step and its share."""

    WIDTH = 24

    def __init__(self) -> None:
        self.length = 0

    def __call__(self, step: str, fraction: float) -> None:
        done = round(self.WIDTH * fraction)
        line = f"{step} [{'#' * done}{'.' * (self.WIDTH - done)}] {100 * fraction:3.0f} %"
        sys.stderr.write("\r" + line.ljust(self.length))
        sys.stderr.flush()
        self.length = len(line)

    def close(self) -> None:
        if self.length:
            sys.stderr.write("\r" + " " * self.length + "\r")
            sys.stderr.flush()


class reporting:
    """`with reporting(progress) as report`: what the library is given for an argument `progress`."""

    def __init__(self, progress: Progress) -> None:
        self.bar = _Bar() if progress is True else None
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            raise TypeError("progress must be True or a function of the step's name and the fraction done, "
                            f"not {type(progress).__name__}")
        self.report: Report | None = self.bar or (progress if callable(progress) else None)

    def __enter__(self) -> Report | None:
        return self.report

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.close()
