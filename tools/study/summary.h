#pragma once
/// Summaries of fields and diagrams, for many results: numbers alone.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/text/parameters.h"
#include "morsel/persistence/diagram.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// A Morse function's field without its values.
struct FieldSummary {
  std::string name;
  core::Parameters parameters;
  double min = 0;
  double max = 0;
  std::vector<core::FileParameter> files = {};
  std::vector<std::string> warnings = {};
};
FieldSummary summary_of(const FieldOutcome& outcome);

/// How many pairs a diagram has, and how many of them are large.
struct PersistenceSummary {
  /// Of the input field's range, so that methods can be compared.
  static constexpr std::array kPercents = {0.1, 1.0, 5.0};

  std::size_t pairs = 0;           ///< extremum-saddle pairs, infinite ones included
  std::size_t infinite_pairs = 0;  ///< of a saddle and a boundary loop's cap
  std::size_t essential_saddles = 0;
  std::optional<double> largest = {};                    ///< finite persistence; none without a finite pair
  std::array<std::size_t, kPercents.size()> above = {};  ///< pairs that exceed each of kPercents

  std::size_t above_one_percent() const {
    static_assert(kPercents[1] == 1);
    return above[1];
  }
};
PersistenceSummary summary_of(const persistence::Diagram& diagram, double extent);

}  // namespace morsel::tools
