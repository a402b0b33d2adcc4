#pragma once
/// Small molecules, as atoms and as texts of PDB and mmCIF files.

#include <string>
#include <vector>

#include "morsel/core/io/molecule.h"

namespace morsel::test {

/// An atom as a line of a file gives it.
struct AtomLine {
  std::string name = "C";
  std::string residue = "GLY";
  std::string chain = "A";
  int sequence = 1;
  core::Point position = core::Point::Zero();
  std::string element = "C";
  bool hetero = false;
  char alternate = ' ';
  double occupancy = 1;
  int model = 1;
};

std::string pdb_line(const AtomLine& atom, int serial);
std::string pdb_text(const std::vector<AtomLine>& atoms);  ///< without MODEL records
std::string mmcif_text(const std::vector<AtomLine>& atoms);

/// Atoms that no file was read for; only what geometry needs is set.
core::Atom atom_at(const core::Point& position, double radius);

/// A seeded cluster of `count` atoms, each touching or overlapping an earlier one, radii from 1.1 to 2.
std::vector<core::Atom> random_molecule(unsigned seed, int count);

/// Carbon atoms evenly on a circle in the xy-plane.
std::vector<core::Atom> ring_molecule(int count, double ring_radius, double atom_radius);

}  // namespace morsel::test
