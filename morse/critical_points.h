#pragma once
/// Critical points of a piecewise-linear function, vertex by vertex.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/field/link.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/field/vertex_kind.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

using core::CriticalType;
using core::to_string;

/// A vertex and its core::VertexKind.
struct CriticalPoint {
  core::Index vertex = core::kNone;
  CriticalType type = CriticalType::regular;
  core::Index multiplicity = 1;
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

/// The counts of these points, without their list.
CriticalPoints counts_of(std::span<const CriticalPoint> points);

/// The kind of a vertex from the lower part of its link; is_lower(u) says whether neighbour u is lower.
/// O(degree).
template <class IsLower>
CriticalPoint classify_link(const core::TriangleMesh& mesh, core::Index v, const IsLower& is_lower) {
  const core::VertexKind kind = core::vertex_kind(mesh, v, is_lower);
  return {v, kind.type, kind.multiplicity};
}

/// Type and multiplicity of one vertex from its lower link on the capped surface, by core::kind_of_link():
/// a boundary vertex is never a maximum. O(degree).
CriticalPoint classify_vertex(const core::ScalarField& field, core::Index v);

/// All critical points. minima − saddle_multiplicity + maxima = χ(mesh), component by component. O(n),
/// parallel, the same result for every number of threads. Reads each triangle once, in memory order; besides
/// the result it takes a byte for each vertex and thread (eight at most).
CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress = {});

}  // namespace morsel::morse
