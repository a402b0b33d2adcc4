#pragma once
/// The result of a stability study, as a JSON document ("morsel.stability/1", see stability.schema.json) and
/// as CSV.

#include <ostream>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/stability.h"

namespace morsel::tools {

/// A run; refers to all of it.
struct StabilityReport {
  const core::LoadedMesh& loaded;
  const ReportInput& input;
  const StabilityRequest& request;  ///< with its defaults
  const StabilityPlan& plan;
  const StabilityResult& result;
};

/// The request with its defaults, as documents have it.
Json request_section(const StabilityRequest& request, const core::BuildOptions& build);

/// All that the trials of a run depend on besides their perturbation and number: the key of their journal.
Json trials_key(const StabilityRequest& request, const ReportInput& input,
                const Registry& registry = Registry::standard());

/// The whole document, every trial included.
void write_stability(JsonSink& json, const StabilityReport& report);

/// A row for each count, field, method and perturbation, with the means over the trials; each has the
/// program's version, the mesh with its hash, the seed and all resolved parameters. Without timings, so
/// always the same bytes.
void write_stability_csv(std::ostream& out, const StabilityReport& report);

}  // namespace morsel::tools
