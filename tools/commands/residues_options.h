#pragma once
/// The options of residues at segments, the same in all commands that make segments of molecular surfaces.

#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/molecule.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/residues_file.h"

namespace morsel::tools {

struct ResiduesOptions {
  std::string molecule;
  std::string atoms;  ///< keys of core::read_molecule_options()
  std::string output;

  bool are_wanted() const { return !output.empty(); }
};

/// --molecule, --atoms and --residues.
void add_residues_options(Command& command, ResiduesOptions& options);

/// What the options ask for, checked; nothing if no residues are wanted.
class ResiduesRun {
 public:
  /// Throws InvalidArgument on an output of another kind, keys that are none, and without molecules. Refers
  /// to both, which must outlive it.
  ResiduesRun(const ResiduesOptions& options, const Run& run);

  /// Adds what is read and written to a RunFiles or FieldRun.
  template <class Files>
  void add_files(Files& files) const {
    if (!options_.are_wanted()) return;
    files.reads("--molecule", options_.molecule).writes("--residues", output_);
    for (const core::FileParameter& file : files_) files.reads("--atoms " + file.key, file.path);
  }

  /// Reads the molecule, tells what was odd in it, and finds the atoms nearest to the mesh's vertices.
  void read(const core::TriangleMesh& mesh);
  /// Adds a level: a label for each vertex and each triangle of the mesh. Those of triangles count; colours
  /// are those that files of both have.
  void add_level(const core::TriangleMesh& mesh, std::span<const core::Index> vertex,
                 std::span<const core::Index> triangle);
  /// Writes them and tells so; `provenance` is completed. Nothing if no residues are wanted.
  void write(Provenance provenance, bool with_levels) const;

  bool are_wanted() const { return options_.are_wanted(); }
  const core::FileTarget& output() const { return output_; }
  /// What a provenance's request has about them: {molecule, atoms}.
  Json request() const;

 private:
  const ResiduesOptions& options_;
  const Run& run_;
  core::FileTarget output_;
  core::MoleculeOptions wanted_;
  std::vector<core::FileParameter> files_;
  core::Molecule molecule_;
  NearestAtoms nearest_;
  std::vector<SegmentedAtoms> levels_;
};

}  // namespace morsel::tools
