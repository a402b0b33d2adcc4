#include "morsel/tools/commands/residues_options.h"

#include <set>
#include <utility>

#include "morsel/core/text/numbers.h"
#include "morsel/core/text/specification.h"
#include "morsel/tools/color/regions.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {

void add_residues_options(Command& command, ResiduesOptions& options) {
  command
      .output("--residues", options.output, {{"pml", "cxc", "pdb", "csv"}},
              "Residues at each segment: .pml, .cxc, .pdb or .csv")
      .value("OUT")
      .needs("--molecule")
      .in_detail(
          "The residues and atoms nearest to each segment of a molecule's surface: .pml selects and colours "
          "them in PyMOL, .cxc in ChimeraX; .pdb has the segment as temperature factor (-1: not at the "
          "surface); .csv has a row for each atom of each segment, with its area");
  command.path("--molecule", options.molecule, "The atoms of the surface, for --residues")
      .value("FILE")
      .needs("--residues");
  command.text("--atoms", options.atoms, "Which of them: hetero=all,chains=A,…")
      .value("KEYS")
      .needs("--molecule")
      .in_detail("The keys of atomic-density that choose atoms and radii, as the surface was made with");
}

ResiduesRun::ResiduesRun(const ResiduesOptions& options, const Run& run)
    : options_(options), run_(run), output_(output_target(options.output, run)) {
  if (!are_wanted()) return;
  core::require_molecules("--residues");
  static_cast<void>(residues_extension(output_));
  core::Specification keys{"--atoms", {}};
  if (!options.atoms.empty()) keys = core::parse_specification("--atoms:" + options.atoms, "--atoms");
  core::ParameterReader reader(std::move(keys));
  wanted_ = core::read_molecule_options(reader);
  reader.finish();
  files_ = reader.files();
}

void ResiduesRun::read(const core::TriangleMesh& mesh) {
  const core::Progress progress = run_.console.progress();
  molecule_ = core::read_molecule(options_.molecule, wanted_, progress);
  for (const std::string& warning : molecule_.warnings)
    run_.console.warning(options_.molecule + ": " + warning);
  nearest_ = nearest_atoms(mesh, molecule_.atoms, progress);
  if (nearest_.without > 0)
    run_.console.warning(core::grouped(nearest_.without) + " of " + core::grouped(mesh.vertex_count()) +
                         " vertices are more than 5 Å from all atoms of " + options_.molecule +
                         " and belong to none");
}

void ResiduesRun::add_level(const core::TriangleMesh& mesh, std::span<const core::Index> vertex,
                            std::span<const core::Index> triangle) {
  levels_.push_back({atoms_of_segments(mesh, triangle, nearest_), color_labels(mesh, vertex, triangle)});
}

Json ResiduesRun::request() const {
  return {{"molecule", options_.molecule}, {"atoms", to_json(core::molecule_parameters(wanted_))}};
}

void ResiduesRun::write(Provenance provenance, bool with_levels) const {
  if (!are_wanted()) return;
  provenance.add_input({options_.molecule, sha256_of_file(options_.molecule)});
  for (const core::FileParameter& file : files_) provenance.add_input({file.path, sha256_of_file(file.path)});
  write_residues(output_, molecule_.atoms, levels_, with_levels, provenance);
  std::set<core::Index> atoms;
  for (const SegmentedAtoms& level : levels_)
    for (const SegmentAtom& part : level.atoms) atoms.insert(part.atom);
  run_.console.message("residues: " + (output_.is_open_file() ? "" : options_.output + ", ") +
                       core::grouped(atoms.size()) + " of " + core::grouped(molecule_.atoms.size()) +
                       " atoms are at the surface; radii: " + to_string(molecule_.radii));
}

}  // namespace morsel::tools
