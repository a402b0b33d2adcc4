#pragma once
/// How often links change between lower and higher, by passes over the triangles in memory order.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/field/vertex_kind.h"
#include "morsel/core/mesh/mesh.h"

namespace morsel::core {

/// The changes in a vertex's link. A change is a pair of neighbouring elements in its link on the capped
/// surface of which one is lower and the other higher than the vertex: a triangle (or a boundary edge with
/// its cap) is one for the middle of its three corners, so changes are counted without walking a link
/// (Banchoff, "Critical points and curvature for embedded polyhedral surfaces", 1970). Each run begins and
/// ends with one.
class LinkChanges {
 public:
  constexpr LinkChanges() = default;
  static constexpr LinkChanges from_bits(std::uint8_t bits) {
    LinkChanges result;
    result.bits_ = bits;
    return result;
  }

  /// Up to kMostChanges.
  constexpr Index changes() const { return bits_ >> 1; }
  static constexpr Index kMostChanges = 127;  ///< or more
  constexpr bool is_cut_off() const { return changes() == kMostChanges; }

  /// The kind of the vertex; where changes are cut off, its multiplicity is a lower bound.
  constexpr VertexKind kind() const { return kind_of_link(runs(), (bits_ & 1) != 0); }
  constexpr bool is_regular() const { return is_regular_link(runs()); }
  constexpr bool is_saddle() const { return is_saddle_link(runs()); }

  void add_change() { bits_ = static_cast<std::uint8_t>(bits_ + (bits_ < 2 * kMostChanges ? 2 : 0)); }
  void set_above() { bits_ |= 1; }  ///< it is the highest corner of a triangle
  void add(LinkChanges other) {
    const Index sum = std::min(2 * kMostChanges, 2 * changes() + 2 * other.changes());
    bits_ = static_cast<std::uint8_t>(sum | ((bits_ | other.bits_) & 1));
  }

  /// Twice the changes, and 1 if the vertex is the highest corner of a triangle. Below 2 · kMostChanges this
  /// is the exact count.
  constexpr std::uint8_t bits() const { return bits_; }

 private:
  constexpr Index runs() const { return changes() / 2; }

  std::uint8_t bits_ = 0;
};

/// For every vertex. O(n), parallel, the same for every number of threads; at most 8 bytes a vertex. `rank`
/// orders the vertices (a permutation).
std::vector<LinkChanges> link_changes(const TriangleMesh& mesh, std::span<const Index> rank);

namespace detail {
/// The corners of a triangle from the lowest to the highest, by whether 0 is below 1, 1 below 2, 0 below 2.
inline constexpr std::array<std::array<std::uint8_t, 3>, 8> kAscending = {
    {{2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {}, {}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}}};
}  // namespace detail

/// Calls visit(lowest, middle, highest) for some triangles. (Looked up since branches would be mispredicted.)
template <class Visit>
void for_each_triangle(const TriangleMesh& mesh, std::span<const Index> rank, std::size_t first,
                       std::size_t last, const Visit& visit) {
  for (const Triangle& corner : mesh.triangles().subspan(first, last - first)) {
    const Index a = rank[corner[0]];
    const Index b = rank[corner[1]];
    const Index c = rank[corner[2]];
    const auto& [lowest, middle, highest] =
        detail::kAscending[static_cast<unsigned>(a < b) | static_cast<unsigned>(b < c) << 1 |
                           static_cast<unsigned>(a < c) << 2];
    visit(corner[lowest], corner[middle], corner[highest]);
  }
}

/// The same for the triangles of the caps, which are higher than all vertices.
template <class Visit>
void for_each_cap_triangle(const TriangleMesh& mesh, std::span<const Index> rank, const Visit& visit) {
  for (Index loop = 0; loop < mesh.boundary_loop_count(); ++loop)
    for (const Index h : mesh.boundary_loop(loop)) {
      const Index a = mesh.origin(h);
      const Index b = mesh.target(h);
      const bool ab = rank[a] < rank[b];
      visit(ab ? a : b, ab ? b : a, mesh.vertex_count() + loop);
    }
}

}  // namespace morsel::core
