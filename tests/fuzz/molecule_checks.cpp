#include "molecule_checks.h"

#include <algorithm>
#include <cmath>

#include "morsel/core/error.h"
#include "target.h"

namespace morsel::fuzz {
namespace {

using namespace core;

void check_choice(const AtomRecords& all, const MoleculeOptions& options) {
  try {
    const Molecule molecule = choose_atoms(all, "fuzz", options);
    require(!molecule.atoms.empty(), "no atoms");
    require(molecule.models == all.models, "models");
    require(molecule.atoms.size() + molecule.left_out.total() == molecule.atoms_in_model,
            "atoms that are neither taken nor left out");
    const bool by_role = options.select.empty();
    for (const Atom& atom : molecule.atoms) {
      require(atom.radius > 0 && std::isfinite(atom.radius), "a radius");
      require(atom.polymer + atom.ion + atom.water <= 1, "two roles");
      require(!by_role || options.waters || !atom.water, "a water");
      require(!by_role || options.hetero == HeteroAtoms::all || !atom.ion, "an ion");
      require(!by_role || options.hetero != HeteroAtoms::none || !atom.hetero || atom.water, "a hetero atom");
      require(!atom.described().empty(), "a description");
    }
    for (std::size_t i = 1; i < molecule.atoms.size() && options.alternate == "highest"; ++i) {
      const Atom& a = molecule.atoms[i - 1];
      const Atom& b = molecule.atoms[i];
      require(a.chain != b.chain || a.sequence_id != b.sequence_id || a.alternate == 0 || b.alternate == 0 ||
                  a.alternate == b.alternate,
              "two locations of a residue");
    }
  } catch (const BadInput&) {
  }
}

}  // namespace

void check_atoms(const AtomRecords& all) {
  require(all.records.empty() || all.models >= 1, "atoms of no model");
  for (const AtomRecord& record : all.records) {
    require(record.atom.position.allFinite(), "a coordinate that is no number");
    require((record.atom.element == "X") == (record.atom.radius == 0), "an unknown element has no radius");
  }
  check_choice(all, {});
  check_choice(all, {.hetero = HeteroAtoms::all, .waters = true, .alternate = "all", .chains = {}});
  check_choice(all, {.hetero = HeteroAtoms::none, .hydrogens = false, .alternate = "first", .chains = {}});
  check_choice(all,
               {.chains = {}, .select = "not (polymer or ion and residue 1-50)", .radii = "united-atom"});
  if (!all.records.empty()) check_choice(all, {.alternate = "A", .chains = {all.records.back().atom.chain}});
}

}  // namespace morsel::fuzz
