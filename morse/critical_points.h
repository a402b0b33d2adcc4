#pragma once
/// Critical points of a piecewise-linear function, vertex by vertex.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "morsel/core/field/link.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

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

/// What a vertex is by its lower part of its link; is_lower(u) tells it of each neighbour u. O(degree).
template <class IsLower>
CriticalPoint classify_link(const core::TriangleMesh& mesh, core::Index v, const IsLower& is_lower) {
  const core::LinkPart lower = core::link_part(mesh, v, /*cap_inside=*/false, is_lower, [](core::Index) {});
  if (lower.empty) return {v, CriticalType::minimum, 1};
  if (lower.whole) return {v, CriticalType::maximum, 1};
  if (lower.runs <= 1) return {v, CriticalType::regular, 1};
  return {v, CriticalType::saddle, lower.runs - 1};
}

/// Type and multiplicity of one vertex from its lower link on the capped surface (Banchoff 1970; Ni, Garland,
/// Hart 2004, section 3.1): no lower neighbour → minimum; all lower → maximum; one run of lower neighbours →
/// regular; k ≥ 2 runs → saddle of multiplicity k − 1. At a boundary vertex the loop's cap counts as a higher
/// neighbour, so it is never a maximum. O(degree).
CriticalPoint classify_vertex(const core::ScalarField& field, core::Index v);

/// All critical points. minima − saddle_multiplicity + maxima = χ(mesh), component by component. O(n),
/// parallel, the same result for every number of threads. Reads each triangle once, in the order of memory;
/// besides the result it takes a byte for each vertex and thread (eight at most).
CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress = {});

}  // namespace morsel::morse
