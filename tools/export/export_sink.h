#pragma once
/// The files of `morsel compare --export`.

#include <optional>
#include <string>

#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/file_names.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// Writes, per method, into one folder:
///   NAME.surface.vtp  the surface with the field, critical types and segment labels as arrays
///   NAME.complex.vtp  the nodes and arcs of the Morse-Smale complex
///   NAME.nodes.vtp    the nodes alone, as points
///   NAME.complex.graphml  the complex as a graph
///   NAME.points.csv   the critical points
///   NAME.glb          if asked for: surface, points and arcs, to be looked at
/// Where points were chosen, the table has these (points_file.h), and critical types are theirs alone.
/// They are written whole (file_writer.h) without waiting for the disk, since they can be made again.
/// NAME is the method's; a second method of the same name gets "-2", and so on.
class ExportSink : public ComparisonSink {
 public:
  /// Refers to `folder` and `loaded`.
  ExportSink(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance,
             bool writes_glb = false);
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;

 private:
  ResultFolder& folder_;
  const core::LoadedMesh& loaded_;
  Provenance provenance_;
  bool writes_glb_;
  std::string field_name_;
  std::optional<core::ScalarField> original_;
  FileNames names_;
};

}  // namespace morsel::tools
