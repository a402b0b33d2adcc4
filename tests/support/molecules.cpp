#include "support/molecules.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace morsel::test {
namespace {

template <class... Arguments>
std::string format(const char* pattern, const Arguments&... arguments) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, pattern, arguments...);
  return buffer;
}

}  // namespace

std::string pdb_line(const AtomLine& atom, int serial) {
  const std::string name = atom.name.size() < 4 && atom.element.size() == 1 ? " " + atom.name : atom.name;
  return format("%-6s%5d %-4s%c%3s %1s%4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n",
                atom.hetero ? "HETATM" : "ATOM", serial, name.c_str(), atom.alternate, atom.residue.c_str(),
                atom.chain.c_str(), atom.sequence, atom.position.x(), atom.position.y(), atom.position.z(),
                atom.occupancy, 0.0, atom.element.c_str());
}

std::string pdb_text(const std::vector<AtomLine>& atoms) {
  std::string text = "HEADER    TEST\n";
  int serial = 0;
  for (const AtomLine& atom : atoms) text += pdb_line(atom, ++serial);
  return text + "END\n";
}

std::string mmcif_text(const std::vector<AtomLine>& atoms) {
  std::string text = "data_TEST\n#\nloop_\n";
  for (const char* tag :
       {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "auth_asym_id",
        "auth_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy", "pdbx_PDB_model_num"})
    text += std::string("_atom_site.") + tag + "\n";
  int serial = 0;
  for (const AtomLine& a : atoms)
    text += format("%s %d %s \"%s\" %c %s %s %d %.3f %.3f %.3f %.2f %d\n", a.hetero ? "HETATM" : "ATOM",
                   ++serial, a.element.c_str(), a.name.c_str(), a.alternate == ' ' ? '.' : a.alternate,
                   a.residue.c_str(), a.chain.c_str(), a.sequence, a.position.x(), a.position.y(),
                   a.position.z(), a.occupancy, a.model);
  return text + "#\n";
}

core::Atom atom_at(const core::Point& position, double radius) {
  core::Atom atom;
  atom.position = position;
  atom.radius = radius;
  atom.element = "C";
  return atom;
}

std::vector<core::Atom> random_molecule(unsigned seed, int count) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<core::Atom> atoms = {
      atom_at({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}, uniform(1.1, 2))};
  while (static_cast<int>(atoms.size()) < count) {
    const core::Atom& other = atoms[random() % atoms.size()];
    const core::Point direction(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (direction.norm() < 0.1 || direction.norm() > 1) continue;
    const double radius = uniform(1.1, 2);
    atoms.push_back(atom_at(
        other.position + direction.normalized() * (other.radius + radius) * uniform(0.4, 1.02), radius));
  }
  return atoms;
}

std::vector<core::Atom> ring_molecule(int count, double ring_radius, double atom_radius) {
  std::vector<core::Atom> atoms;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    atoms.push_back(atom_at({ring_radius * std::cos(angle), ring_radius * std::sin(angle), 0}, atom_radius));
  }
  return atoms;
}

}  // namespace morsel::test
