#pragma once
/// Lengths as users give them: in the unit of the mesh, in ε, in edges, or as a share of its size.

#include <cstdint>
#include <string>

#include "morsel/core/mesh/mesh.h"

namespace morsel::core {

/// The mean length of the mesh's edges, 0 if there are none. Scales exactly by powers of two. O(edges),
/// parallel, the same bits for every number of threads.
double mean_edge_length(const TriangleMesh& mesh);

/// The square root of the surface's area, which does not turn with the mesh, as ε does. Scales exactly by
/// powers of two. O(triangles), parallel, the same bits for every number of threads.
double root_area(const TriangleMesh& mesh);

enum class LengthUnit : std::uint8_t {
  mesh,      ///< the mesh's own
  epsilon,   ///< ε = 0.3 % of the bounding box's diagonal (the paper's "Parameters")
  edge,      ///< the mesh's mean_edge_length()
  percent,   ///< 1 % of the bounding box's diagonal
  root_area  ///< the mesh's root_area()
};

/// A length in one of these units.
struct Length {
  double value = 0;
  LengthUnit unit = LengthUnit::mesh;

  static constexpr Length absolute(double length) { return {length, LengthUnit::mesh}; }
  static constexpr Length epsilons(double count) { return {count, LengthUnit::epsilon}; }
  static constexpr Length edges(double count) { return {count, LengthUnit::edge}; }
  static constexpr Length percent(double count) { return {count, LengthUnit::percent}; }
  static constexpr Length root_areas(double count) { return {count, LengthUnit::root_area}; }

  /// The length in the unit of `mesh`. O(1), or O(n) in edges and roots of the area.
  double on(const TriangleMesh& mesh) const;

  friend bool operator==(const Length&, const Length&) = default;
};

/// "8eps", "3edges", "5%", "0.02rootarea" or "0.25"; parse_length() reads it back exactly.
std::string to_string(const Length& length);

}  // namespace morsel::core
