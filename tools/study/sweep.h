#pragma once
/// The parameter sweep: a field and a method with every combination of some of their parameters' values.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/critical_points.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/summary.h"
#include "morsel/tools/study/sweep_plan.h"

namespace morsel::tools {

/// The seconds that a combination would have taken alone.
struct SweepSeconds {
  double field = 0;
  double method = 0;
  double measuring = 0;
  double sum() const { return field + method + measuring; }
};

/// The result of a combination.
struct SweepRow {
  FieldSummary field;              ///< before the method
  std::vector<StepOutcome> steps;  ///< without details and records of their iterations
  double min = 0;                  ///< of the field that the method made
  double max = 0;
  std::optional<std::int64_t> iterations_run = {};  ///< of all steps together; none if no step iterates
  morse::CriticalPoints critical_points;            ///< counts only
  PersistenceSummary persistence;
  SweepSeconds seconds;

  /// "salient+tps"
  std::string method_name() const;
};

struct SweepOptions {
  /// Rows that are known: for each combination, or empty if none is.
  std::vector<std::optional<SweepRow>> known = {};
  /// Called with each row that is made and its combination's number, on the calling thread.
  std::function<void(std::size_t combination, const SweepRow& row)> on_row = {};
};

/// A row for each combination, in their order.
///
/// Work that combinations have in common is done once: a function is evaluated once for all methods, the
/// first steps of a chain are applied once for all continuations, and combinations that differ only in the
/// iterations of a step are taken from one run of it, if core::MethodTraits allow it. Rows are the same bits
/// as those of a sweep with one combination. No more fields are in memory at a time than a chain has steps,
/// and two more.
///
/// The seconds of a row that was taken from a longer run are those up to its iteration. Throws what functions
/// and methods throw; an error names its combination.
std::vector<SweepRow> run_sweep(const core::LoadedMesh& loaded, const SweepPlan& plan,
                                const SweepOptions& options = {}, const core::Progress& progress = {});

}  // namespace morsel::tools
