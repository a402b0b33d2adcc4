#pragma once
/// Critical vertices and what their links look like, by passes over the triangles. For the module's own use.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/scalar_field.h"
#include "morsel/persistence/paths.h"

namespace morsel::persistence::detail {

using core::Index;

/// What a vertex is. A change is a pair of neighbouring elements in its link on the capped surface of which
/// one is lower and the other higher than the vertex: a triangle (or a boundary edge with its cap) is one for
/// the middle of its three corners, so changes are counted without walking a link (Banchoff, "Critical points
/// and curvature for embedded polyhedral surfaces", 1970). A saddle of multiplicity m has 2 m + 2.
class VertexType {
 public:
  bool is_minimum() const { return bits_ == 0; }
  bool is_maximum() const { return bits_ == 1; }
  bool is_regular() const { return bits_ >> 1 == 2; }
  bool is_saddle() const { return bits_ >> 1 > 2; }
  /// Up to kMostChanges.
  Index changes() const { return bits_ >> 1; }
  static constexpr Index kMostChanges = 127;  ///< or more

  void add_change() { bits_ = static_cast<std::uint8_t>(bits_ + (bits_ < 2 * kMostChanges ? 2 : 0)); }
  void set_above() { bits_ |= 1; }  ///< it is the highest corner of a triangle
  void add(VertexType other) {
    const Index sum = std::min(2 * kMostChanges, 2 * changes() + 2 * other.changes());
    bits_ = static_cast<std::uint8_t>(sum | ((bits_ | other.bits_) & 1));
  }

 private:
  std::uint8_t bits_ = 0;
};

/// O(n), parallel; at most 8 bytes a vertex. `rank` orders the vertices (a permutation).
std::vector<VertexType> vertex_types(const core::TriangleMesh& mesh, std::span<const Index> rank);

/// The lower and the higher elements of the changes around saddles (vertices, or the number of vertices +
/// loop for a cap). A run of a link begins and ends with a change, so each run is met twice. At one saddle
/// they come in any order.
struct LinkEnds {
  std::vector<Index> offset;  ///< per vertex: where those of a saddle begin in both of the lists
  std::vector<Index> lower, higher;
};

struct Saddle {
  Index rank;
  Index multiplicity;
};

/// For the saddles of the field; O(n), parallel. Where there are many of them it is another pass over the
/// triangles, which then also tells the paths an element below or above each vertex; few are walked around.
LinkEnds link_ends(const core::ScalarField& field, std::span<const VertexType> types,
                   std::span<const Saddle> saddles, Paths& down_to_minima, Paths& up_to_maxima);

}  // namespace morsel::persistence::detail
