from typing import Any

from . import _library
from ._library import Report

def molecule(path: bytes, kind: str, resolution: float, probe: float, blobbiness: float, cavities: bool,
             keys: str, report: Report) -> tuple[_library.Mesh, dict[str, Any], float, float, int,
                                                      str, list[str]]: ...
