#pragma once
/// Critical points of a piecewise-linear function, vertex by vertex.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "morsel/core/progress.h"
#include "morsel/core/scalar_field.h"

namespace morsel::morse {

enum class CriticalType : std::uint8_t { regular, minimum, saddle, maximum };

/// "regular", "minimum", "saddle", "maximum".
std::string_view to_string(CriticalType type);

struct CriticalPoint {
  core::Index vertex = core::kNone;
  CriticalType type = CriticalType::regular;
  core::Index multiplicity = 1;  ///< k − 1 for a saddle with k runs of lower neighbours, 1 for an extremum
  friend bool operator==(const CriticalPoint&, const CriticalPoint&) = default;
};

/// The critical points by ascending vertex, and their counts.
struct CriticalPoints {
  std::vector<CriticalPoint> points;
  std::size_t minima = 0;
  std::size_t saddles = 0;              ///< saddle vertices
  std::size_t saddle_multiplicity = 0;  ///< sum of their multiplicities
  std::size_t maxima = 0;               ///< without the virtual ones at boundary loops

  /// The paper's "#CP".
  std::size_t total() const { return minima + saddles + maxima; }
};

/// Type and multiplicity of one vertex from its lower link on the capped surface (Banchoff 1970; Ni, Garland,
/// Hart 2004, section 3.1): no lower neighbour → minimum; all lower → maximum; one run of lower neighbours →
/// regular; k ≥ 2 runs → saddle of multiplicity k − 1. At a boundary vertex the loop's cap counts as a higher
/// neighbour, so it is never a maximum. O(degree).
CriticalPoint classify_vertex(const core::ScalarField& field, core::Index v);

/// All critical points. minima − saddle_multiplicity + maxima = χ(mesh), component by component. O(n), parallel,
/// the same result for every number of threads. Reads each triangle once, in the order of memory; besides the
/// result it takes a byte for each vertex and thread (eight at most).
CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress = {});

}  // namespace morsel::morse
