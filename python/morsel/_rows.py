"""What studies that are tables of named values share."""

from __future__ import annotations

from typing import Any, Dict, Iterator, Sequence

from ._arguments import Immutable


class Rows(Immutable, Sequence[Dict[str, Any]]):
    """A table, a dict for each row."""

    def __init__(self, rows: list[dict[str, Any]]) -> None:
        self._rows = rows

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self._rows)

    def __getitem__(self, which: Any) -> Any:
        return self._rows[which]
