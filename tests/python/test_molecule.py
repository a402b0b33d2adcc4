"""Surfaces of molecules."""

import pickle

import numpy as np
import pytest
from conftest import program

import morsel as ms

GLYCINE = [("N", 0.0, 0.0, 0.0), ("CA", 1.45, 0.0, 0.0), ("C", 2.0, 1.42, 0.0), ("O", 1.3, 2.42, 0.0)]


def pdb(path, residues=6):
    """A chain of glycines, and a water."""
    lines, serial = [], 0
    for residue in range(residues):
        for name, x, y, z in GLYCINE:
            serial += 1
            lines.append(f"ATOM  {serial:5d}  {name:<3s} GLY A{residue + 1:4d}    {x + 3.3 * residue:8.3f}"
                         f"{y:8.3f}{z + residue % 2:8.3f}  1.00  0.00          {name[0]:>2s}")
    lines.append(f"HETATM{serial + 1:5d}  O   HOH B   1    {50:8.3f}{50:8.3f}{50:8.3f}"
                 "  1.00  0.00           O")
    path.write_text("\n".join(lines) + "\nEND\n")
    return path


@pytest.fixture
def chain(tmp_path):
    return pdb(tmp_path / "chain.pdb")


def test_surface(chain, tmp_path):
    m = ms.molecule(chain)
    assert isinstance(m, ms.Mesh) and m.is_closed and m.genus == 0 and m.component_count == 1
    assert len(m.atoms) == 24 and m.atoms["position"].shape == (24, 3)
    assert m.atoms["element"][:4].tolist() == ["N", "C", "C", "O"] and m.atoms["name"][1] == "CA"
    assert m.atoms["residue"][0] == "GLY" and m.atoms["sequence_id"][-1] == "6" and m.atoms["chain"][0] == "A"
    assert m.atoms["radius"][0] == 1.55 and m.area > 0 and m.volume > 0 and m.cavities == 0
    program("molecule", chain, "-o", tmp_path / "surface.off")
    same = ms.read(tmp_path / "surface.off")
    assert np.array_equal(same.vertices, m.vertices) and np.array_equal(same.faces, m.faces)


def test_pickled(chain):
    m = ms.molecule(chain)
    again = pickle.loads(pickle.dumps(m))
    assert isinstance(again, ms.Molecule) and again.atoms.tobytes() == m.atoms.tobytes()
    assert np.array_equal(again.vertices, m.vertices) and np.array_equal(again.faces, m.faces)
    assert (again.area, again.volume, again.cavities, again.molecule_path, again.radii) == (
        m.area, m.volume, m.cavities, m.molecule_path, "all-atom")


def test_options(chain, tmp_path):
    m = ms.molecule(chain, kind="ses", resolution=0.4, probe=1.6, waters=True, chains=["A", "B"])
    assert m.component_count == 2 and len(m.atoms) == 25
    program("molecule", chain, "--kind", "ses", "--resolution", "0.4", "--probe", "1.6", "--waters",
            "--chains",
            "A/B", "-o", tmp_path / "surface.off")
    assert np.array_equal(ms.read(tmp_path / "surface.off").vertices, m.vertices)
    assert len(ms.molecule(chain, chains="A").atoms) == 24
    for wrong in ({"kind": "other"}, {"resolution": 0}, {"hetero": "some"}, {"blobbiness": 1000},
                  {"model": 0}):
        with pytest.raises(ms.ArgumentError):
            ms.molecule(chain, **wrong)
    for wrong in ({"chains": ["Z"]}, {"model": 9}, {"resolution": 10}):
        with pytest.raises(ms.InputError):
            ms.molecule(chain, **wrong)
    with pytest.raises(ms.InputError):
        ms.molecule(tmp_path / "none.pdb")


def test_selection_and_radii(chain, tmp_path):
    m = ms.molecule(chain, select="residue 2-3 or water")
    assert len(m.atoms) == 9 and set(m.atoms["residue"]) == {"GLY", "HOH"}
    assert np.isnan(m.atoms["charge"]).all()
    assert len(ms.molecule(chain, select="name CA,N and not residue 1").atoms) == 10
    with pytest.raises(ms.ArgumentError, match="at character 6"):
        ms.molecule(chain, select="chain")
    with pytest.raises(ms.ArgumentError, match="takes the place"):
        ms.molecule(chain, select="all", waters=True)
    table = tmp_path / "radii.txt"
    table.write_text("GLY CA 2\n")
    with pytest.warns(ms.MorselWarning, match="no radius"):
        m = ms.molecule(chain, radii=table)
    assert m.radii == "of a table" and m.atoms["radius"][:2].tolist() == [1.55, 2]
    united = ms.molecule(pdb(tmp_path / "long.pdb", 10))
    assert united.radii == "united-atom" and united.atoms["radius"][:4].tolist() == [1.64, 1.88, 1.61, 1.42]
    f = ms.atomic_density(united, structure=tmp_path / "long.pdb")
    assert f.parameters["radii"] == "united-atom"


def test_pqr(tmp_path):
    file = tmp_path / "two.pqr"
    file.write_text("ATOM 1 N GLY 1 0 0 0 -0.5 1.5\nATOM 2 CA GLY 1 2 0 0 0.25 2\n")
    m = ms.molecule(file, kind="vdw")
    assert m.radii == "of the structure's file" and m.atoms["charge"].tolist() == [-0.5, 0.25]
    charge = np.asarray(ms.atomic_density(m, structure=file, weight="charge"))
    square = ((m.vertices[:, None] - m.atoms["position"])**2).sum(2)
    assert np.allclose(charge, (np.exp(-0.5 * square / m.atoms["radius"]**2) * m.atoms["charge"]).sum(1))


def test_from_molecule_to_residues(chain):
    m = ms.molecule(chain)
    f = ms.atomic_density(m, structure=chain)
    s = ms.segment(f, by="ascending", segments=4)
    nearest = np.linalg.norm(m.atoms["position"] - m.vertices[s.minima[0]], axis=1).argmin()
    assert len(s) <= 4 and m.atoms["residue"][nearest] == "GLY"
