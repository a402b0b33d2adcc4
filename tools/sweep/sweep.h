#pragma once
/// A field and a method with every combination of some of their parameters' values.

#include <functional>
#include <optional>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/study/grid.h"

namespace morsel::tools {

/// What came of a combination, as documents hold it.
struct SweepRow {  // NOLINT(bugprone-exception-escape): of the JSON library
  /// {"field", "method", "iterations_run", "critical_points", "persistence"}, see sweep.schema.json
  Json result;
  /// {"field", "method", "measuring"}: seconds that the combination would have taken by itself
  Json seconds;
};

struct SweepOptions {
  /// Rows that are known: for each combination, or empty if none is.
  std::vector<std::optional<SweepRow>> known = {};
  /// Told each row that is made, with its combination's number, by the calling thread.
  std::function<void(std::size_t combination, const SweepRow& row)> on_row = {};
};

/// A row for each combination, in their order.
///
/// Work that combinations have in common is done once: a field is taken once for all methods, the first steps
/// of a chain are applied once for all that follows, and what differs in the iterations of a step alone is
/// read out of one run of it, if the method lets itself be read (core::MethodTraits). Rows are the
/// same bits as those of a sweep with one combination. No more fields are in memory at a time than a chain
/// has steps, and two more.
///
/// Seconds of a row that was read out are those up to its iteration. Throws what functions and methods throw;
/// an error names its combination.
std::vector<SweepRow> run_sweep(const core::LoadedMesh& loaded, const PreparedSweep& prepared,
                                const SweepOptions& options = {}, const core::Progress& progress = {});

}  // namespace morsel::tools
