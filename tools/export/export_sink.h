#pragma once
/// The files of `morsel compare --export`.

#include <string>

#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/file_names.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// Writes, per method, into one folder:
///   NAME.surface.vtp  the surface with the field, critical types and segment labels as arrays
///   NAME.complex.vtp  the nodes and arcs of the Morse-Smale complex
///   NAME.points.csv   the critical points; column `provenance` has a text in the first row alone
/// Where points were chosen, the table has these (points_file.h), and critical types are theirs alone.
/// They are written whole (file_writer.h) without waiting for the disk, since they can be made again.
/// NAME is the method's; a second method of the same name gets "-2", and so on.
class ExportSink : public ComparisonSink {
 public:
  /// Refers to `folder` and `loaded`.
  ExportSink(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance);
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;

 private:
  ResultFolder& folder_;
  const core::LoadedMesh& loaded_;
  Provenance provenance_;
  std::string field_name_;
  FileNames names_;
};

}  // namespace morsel::tools
