#pragma once
/// The kind of a vertex: the one definition, used wherever critical vertices are found.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "morsel/core/types.h"

namespace morsel::core {

enum class CriticalType : std::uint8_t { regular, minimum, saddle, maximum };

/// "regular", "minimum", "saddle", "maximum".
constexpr std::string_view to_string(CriticalType type) {
  constexpr std::array<std::string_view, 4> kNames = {"regular", "minimum", "saddle", "maximum"};
  return kNames[static_cast<std::size_t>(type)];
}

struct VertexKind {
  CriticalType type = CriticalType::regular;
  Index multiplicity = 1;  ///< k − 1 for a saddle with k runs of lower neighbours, 1 for all others
  constexpr bool is_extremum() const {
    return type == CriticalType::minimum || type == CriticalType::maximum;
  }
  friend bool operator==(const VertexKind&, const VertexKind&) = default;
};

// Parts of the rule on their own, without branches, for loops over all vertices.
constexpr bool is_regular_link(Index lower_runs) { return lower_runs == 1; }
constexpr bool is_saddle_link(Index lower_runs) { return lower_runs > 1; }

/// By the lower part of a link, a cycle on the capped surface (Banchoff 1970; Ni, Garland, Hart 2004, section
/// 3.1): no lower neighbour → minimum; all lower → maximum; one run of lower neighbours → regular; k ≥ 2 runs
/// → saddle of multiplicity k − 1. At a boundary vertex the loop's cap counts as a higher neighbour, so it is
/// never a maximum. `lower_runs` is 0 where none or all are lower.
constexpr VertexKind kind_of_link(Index lower_runs, bool all_lower) {
  if (is_regular_link(lower_runs)) return {CriticalType::regular, 1};
  if (is_saddle_link(lower_runs)) return {CriticalType::saddle, lower_runs - 1};
  return {all_lower ? CriticalType::maximum : CriticalType::minimum, 1};
}

}  // namespace morsel::core
