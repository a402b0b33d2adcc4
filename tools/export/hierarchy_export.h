#pragma once
/// The files of `morsel hierarchy --export`.

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools {

/// Writes, per level, into one folder:
///   surface.K.vtp  the surface as surface_file.h's, and per triangle, for each kind of cell, KIND_parent and
///                  KIND_merges_into: the label of the cell of the level before and after that its cell is
///                  linked to
///   complex.K.vtp  the complex as complex_file.h's, and per node `parent`, the vertex of its critical
///                  point's parent
/// K is the level's number, 0 the finest, so that ParaView opens each kind as a series; −1 means no link.
class HierarchyExport : public HierarchySink {
 public:
  /// Refers to `folder` and `loaded`.
  HierarchyExport(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance);
  void begin(const HierarchyBasis& basis) override;
  void level(const Level& level) override;

 private:
  /// `persistence`: per vertex.
  void write_surface(const core::FileTarget& target, const Level& level, std::span<const double> persistence,
                     const Provenance& provenance) const;
  void write_complex(const core::FileTarget& target, const Level& level, std::span<const double> persistence,
                     const Provenance& provenance) const;

  ResultFolder& folder_;
  const core::LoadedMesh& loaded_;
  Provenance provenance_;
  std::string field_name_;
  std::optional<core::ScalarField> original_;
};

}  // namespace morsel::tools
