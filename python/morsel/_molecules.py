"""Surfaces of molecules."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library
from ._field import warn
from ._mesh import Mesh, PathLike, path_bytes
from ._progress import Progress, reporting
from ._specification import Parameter, specification

_KEYS = {"hetero": "choice", "waters": "flag", "hydrogens": "flag", "altloc": "text", "chains": "list",
         "model": "count", "select": "text", "radii": "text"}


class Molecule(Mesh):
    """The surface of a molecule, a closed mesh in Å, with its atoms; made by molecule()."""

    __slots__ = ("atoms", "area", "volume", "cavities", "molecule_path", "radii")

    atoms: NDArray[np.void]
    """A structured array with a row for each atom: position (x, y, z in Å), radius, charge (nan where the
    file has none), element, name, residue, chain, sequence_id, serial."""
    area: float
    """In Å²."""
    volume: float
    """In Å³."""
    cavities: int
    """Components that are walls of closed cavities, kept or not."""
    molecule_path: str
    """The file of the atoms."""
    radii: str
    """Which radii the atoms have: "all-atom", "united-atom", "of the structure's file" or "of a table"."""

    def __reduce__(self) -> Any:
        made = (self.atoms, self.area, self.volume, self.cavities, self.molecule_path, self.radii)
        return _restored, (_library.mesh_state(self._data), made)


def _restored(state: tuple[Any, ...], made: tuple[Any, ...]) -> Molecule:
    """Of pickle."""
    return _molecule_of(_library.restored_mesh(state), *made)


def _molecule_of(data: _library.Mesh, atoms: NDArray[np.void], area: float, volume: float, cavities: int,
                 path: str, radii: str = "all-atom") -> Molecule:
    made: Molecule = object.__new__(Molecule)
    made._data = data
    made.atoms, made.area, made.volume, made.cavities = atoms, area, volume, cavities
    made.molecule_path, made.radii = path, radii
    return made


def _atoms(columns: dict[str, Any]) -> NDArray[np.void]:
    texts = {name: np.array(columns[name], dtype=str) for name in ("element", "name", "residue", "chain",
                                                                   "sequence_id")}
    kinds = [("position", np.float64, (3,)), ("radius", np.float64), ("charge", np.float64)]
    kinds += [(name, column.dtype if column.dtype.itemsize else "U1") for name, column in texts.items()]
    atoms = np.empty(len(columns["radius"]), dtype=[*kinds, ("serial", np.int64)])
    for name in ("position", "radius", "charge", "serial"):
        atoms[name] = columns[name]
    for name, column in texts.items():
        atoms[name] = column
    return atoms


def molecule(path: PathLike, *, kind: str = "gaussian", resolution: float = 0.5, probe: float = 1.4,
             blobbiness: float = 1.0, cavities: bool = False, hetero: str = "residues", waters: bool = False,
             hydrogens: bool = True, altloc: str = "highest", chains: Sequence[str] | None = None,
             model: int = 1, select: str | None = None, radii: PathLike = "auto",
             progress: Progress = None) -> Molecule:
    """The surface of a molecule, a closed manifold, from a .pdb, .ent, .cif, .mmcif or .pqr file.

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
    select : str
        An expression that takes the place of hetero and waters: "chain A and not residue 10-20", of all,
        polymer, ligand, ion, water, hydrogen, hetero, chain, resname, residue, name and element.
    radii : "auto", "all-atom", "united-atom" or path
        Van der Waals radii of the elements; those for structures without hydrogens; one of both, by the
        hydrogens; or a table of lines [RESIDUE] ATOM|ELEMENT RADIUS.

    The same as `morsel molecule`. Warns of what is odd in the file. Raises InputError for a file that is
    damaged or has no such atoms.

    >>> surface = ms.molecule("1bp2.pdb")
    >>> f = ms.atomic_density(surface, structure="1bp2.pdb")
    """
    from . import _molecule

    given: dict[str, Any] = {"hydrogens": hydrogens, "altloc": altloc, "chains": chains, "model": model,
                             "radii": radii}
    # An expression excludes them; their defaults mean that they were not given.
    given.update({name: value for name, value, default in (("hetero", hetero, "residues"),
                                                           ("waters", waters, False))
                  if value != default})
    if select is not None:
        given["select"] = select
    keys = {name: Parameter(name, of_kind, "", "", []) for name, of_kind in _KEYS.items()}
    if isinstance(chains, str):
        given["chains"] = [chains]
    with reporting(progress) as report:
        data, columns, area, volume, walls, which, warnings = _molecule.molecule(
            path_bytes(path), kind, resolution, probe, blobbiness, bool(cavities),
            specification("molecule", keys, given), report)
    warn(str(path), warnings, 1)
    return _molecule_of(data, _atoms(columns), area, volume, walls, str(path), which)
