#pragma once
/// What was measured, as JSON and as tables.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/machine.h"
#include "benchmark/measure.h"

namespace morsel::benchmark {

/// Something to compare with.
struct Baseline {
  std::string name;
  double seconds = 0;
};

/// One step on one input.
struct Row {
  std::string step;
  std::string mesh;
  std::size_t vertices = 0;
  std::string field;
  int threads = 1;
  Cost cost;
  std::vector<Baseline> baselines;
  double bytes_moved =
      0;             ///< that the step cannot avoid: input read once and result written once; 0: not counted
  double pairs = 0;  ///< (v, x) that salient smoothing visits in all iterations; 0: not counted
  std::optional<double> error;  ///< largest difference to the reference, as a share of the field's extent
  std::optional<double>
      growth;  ///< exponent of the growth of seconds with size, from a smaller size to this one
  std::string note;
};

nlohmann::ordered_json to_json(const Row& row, const Machine& machine);
/// A table for people; a column that no row fills is left out.
std::string table(const std::vector<Row>& rows, const Machine& machine);

}  // namespace morsel::benchmark
