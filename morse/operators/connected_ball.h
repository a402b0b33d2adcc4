#pragma once
/// The connected part of a surface within a ball.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// The balls ‖x − v‖ ≤ radius around the vertices of a surface, of each only what can be reached from v along
/// edges whose ends all lie in the ball: the other side of a thin part, a near finger, is left out. Distances
/// are Euclidean, in double precision, inclusive and compared as lengths. Immutable; keeps what it needs of
/// the mesh, about 70 bytes a vertex. May be read from any number of threads, each of which needs a Walk.
class ConnectedBalls {
 public:
  /// O(n), parallel.
  explicit ConnectedBalls(const core::TriangleMesh& mesh);

  /// A search and its buffers (4 bytes a vertex): make one for many balls. Not thread-safe.
  class Walk {
   public:
    explicit Walk(const ConnectedBalls& balls);

    /// Replaces `found` by the vertices of v's ball, v first, in the order of a breadth-first search.
    /// O(edges in the ball and at its rim).
    void within(core::Index v, double radius, std::vector<core::Index>& found);
    /// Replaces `found` by as much of v's ball as that search finds until there are more than `most`
    /// vertices.
    void begin(core::Index v, double radius, std::size_t most, std::vector<core::Index>& found);
    /// Adds to what within() has just found the neighbours of all of these, ring by ring, until there are at
    /// least `least` vertices or the component has no more.
    void widen(std::size_t least, std::vector<core::Index>& found);

   private:
    const ConnectedBalls& balls_;
    std::vector<std::uint32_t> seen_;  // in which search a vertex was found
    std::uint32_t search_ = 0;
  };

  /// How many vertices one Walk should serve in a parallel loop over all.
  std::size_t grain() const;

 private:
  std::span<const core::Index> neighbors(core::Index v) const {
    return {neighbors_.data() + start_[v], neighbors_.data() + start_[v + 1]};
  }

  std::vector<core::Point> positions_;  // divided by 2^exponent_
  int exponent_;
  std::vector<std::size_t> start_;
  std::vector<core::Index> neighbors_;
};

}  // namespace morsel::morse
