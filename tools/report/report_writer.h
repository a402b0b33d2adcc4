#pragma once
/// The JSON report of a comparison ("morsel.comparison/1", see comparison.schema.json).

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// The input of a report besides the mesh itself.
struct ReportInput {
  std::string mesh_path;  ///< as the user gave it
  std::string mesh_sha256;
  core::BuildOptions build = {};  ///< how the mesh was made of the file
  bool items = true;  ///< whether to list the critical points and the diagram's pairs, or only their counts
  double load_seconds = 0;
  std::string format = {};  ///< that the mesh was read as, where it is not its extension's
};

/// The request.
Json request_section(const ReportInput& input, const ComparisonRequest& request);

/// Writes a report while the comparison runs, method by method.
class ReportWriter : public ComparisonSink {
 public:
  /// Refers to `json` and `loaded`, which must outlive the writer.
  ReportWriter(JsonSink& json, const core::LoadedMesh& loaded, const ReportInput& input,
               const ComparisonRequest& request);
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;
  /// Closes the document; nothing may follow.
  void finish();

 private:
  void add_members(const Json& section);
  void write_target(const TargetOutcome& target);
  void write_persistence(const MethodOutcome& outcome);
  void write_diagram(const MethodOutcome& outcome);
  void write_items(const MethodOutcome& outcome);
  void write_chosen(const ChosenOutcome& chosen);

  JsonSink& json_;
  const core::LoadedMesh& loaded_;
  bool items_;
  std::string field_name_;
  Json timings_;
  Stopwatch watch_;
};

}  // namespace morsel::tools
