"""Surfaces of molecules."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._mesh import Mesh, PathLike, path_bytes
from ._progress import Progress, reporting
from ._specification import Parameter, specification

_KEYS = {"hetero": "choice", "waters": "flag", "hydrogens": "flag", "altloc": "text", "chains": "list",
         "model": "count"}


class Molecule(Mesh):
    """The surface of a molecule, a closed mesh in Å, with its atoms; made by molecule()."""

    __slots__ = ("atoms", "area", "volume", "cavities", "molecule_path")

    atoms: NDArray[np.void]
    """A structured array with a row for each atom: position (x, y, z in Å), radius, element, name, residue,
    chain, sequence_id, serial."""
    area: float
    """In Å²."""
    volume: float
    """In Å³."""
    cavities: int
    """Components that are walls of closed cavities, kept or not."""
    molecule_path: str
    """The file of the atoms."""


    def __reduce__(self) -> Any:
        made = (self.atoms, self.area, self.volume, self.cavities, self.molecule_path)
        return _restored, (_library.mesh_state(self._data), made)


def _restored(state: tuple[Any, ...], made: tuple[Any, ...]) -> Molecule:
    """Of pickle."""
    return _molecule_of(_library.restored_mesh(state), *made)


def _molecule_of(data: _library.Mesh, atoms: NDArray[np.void], area: float, volume: float, cavities: int,
                 path: str) -> Molecule:
    made: Molecule = object.__new__(Molecule)
    made._data = data
    made.atoms, made.area, made.volume, made.cavities = atoms, area, volume, cavities
    made.molecule_path = path
    return made


def _atoms(columns: dict[str, Any]) -> NDArray[np.void]:
    texts = {name: np.array(columns[name], dtype=str) for name in ("element", "name", "residue", "chain",
                                                                   "sequence_id")}
    kinds = [("position", np.float64, (3,)), ("radius", np.float64)]
    kinds += [(name, column.dtype if column.dtype.itemsize else "U1") for name, column in texts.items()]
    atoms = np.empty(len(columns["radius"]), dtype=[*kinds, ("serial", np.int64)])
    for name in ("position", "radius", "serial"):
        atoms[name] = columns[name]
    for name, column in texts.items():
        atoms[name] = column
    return atoms


def molecule(path: PathLike, *, kind: str = "gaussian", resolution: float = 0.5, probe: float = 1.4,
             blobbiness: float = 1.0, cavities: bool = False, hetero: str = "residues", waters: bool = False,
             hydrogens: bool = True, altloc: str = "highest", chains: Sequence[str] | None = None,
             model: int = 1, progress: Progress = None) -> Molecule:
    """The surface of a molecule, a closed manifold, from a .pdb, .ent, .cif or .mmcif file.

    Parameters
    ----------
    path : str or path
    kind : "gaussian", "ses", "sas" or "vdw"
        A level of a sum of Gaussians (Blinn 1982), smooth; solvent-excluded (Connolly 1983);
        solvent-accessible (Lee, Richards 1971); the atoms' balls.
    resolution : float
        Spacing of the grid, about an edge's length, in Å.
    probe : float
        Radius of the solvent for ses and sas, in Å.
    blobbiness : float
        B of exp(B (1 - d²/r²)) for gaussian: the smaller, the smoother.
    cavities : bool
        Keep the walls of closed cavities inside.
    hetero, waters, hydrogens, altloc, chains, model
        Which atoms to take: "none", "residues" or "all" of HETATM records; the waters, too; the hydrogens
        that the file has; alternate locations: "highest" (occupancy), "first", "all" or a letter; chains,
        by default all; which model, from 1.

    The same as `morsel molecule`. Raises InputError for a file that is damaged or has no such atoms.

    >>> surface = ms.molecule("1bp2.pdb")
    >>> f = ms.atomic_density(surface, structure="1bp2.pdb")
    """
    from . import _molecule

    given = {"hetero": hetero, "waters": waters, "hydrogens": hydrogens, "altloc": altloc, "chains": chains,
             "model": model}
    keys = {name: Parameter(name, of_kind, "", "", []) for name, of_kind in _KEYS.items()}
    if isinstance(chains, str):
        given["chains"] = [chains]
    with reporting(progress) as report:
        data, columns, area, volume, walls = _molecule.molecule(
            path_bytes(path), kind, resolution, probe, blobbiness, bool(cavities),
            specification("molecule", keys, given), report)
    return _molecule_of(data, _atoms(columns), area, volume, walls, str(path))
