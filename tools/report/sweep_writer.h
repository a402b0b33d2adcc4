#pragma once
/// The result of a parameter sweep, as a JSON document ("morsel.sweep/1", see sweep.schema.json), as CSV and
/// as a table for people.

#include <ostream>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::tools {

/// A parameter sweep and the files that its fields read; refers to all of it.
struct SweepReport {
  const core::LoadedMesh& loaded;
  const ReportInput& input;
  const SweepRequest& request;
  const SweepPlan& plan;
  const std::vector<SweepRow>& rows;
  const std::vector<HashedFile>& files;
};

/// The request, with ranges written out.
Json request_section(const SweepRequest& request, const SweepPlan& plan, const core::BuildOptions& build);

/// All that rows depend on besides their combination: the key of their journal. `files` are those that fields
/// read.
Json rows_key(const ReportInput& input, const std::vector<HashedFile>& files);

/// The document. Of its members only "timings" differs between runs.
void write_sweep(JsonSink& json, const SweepReport& report);

/// A row for each combination: version, mesh and its hash, field and method in the syntax of other
/// commands, the varied values, a column each, counts, pairs, all resolved parameters, and last the seconds,
/// the only column that differs between runs.
void write_sweep_csv(std::ostream& out, const SweepReport& report);

/// Varied values, counts, pairs and seconds.
std::string sweep_table(const SweepReport& report);

}  // namespace morsel::tools
