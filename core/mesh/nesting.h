#pragma once
/// Which closed shells of a surface lie within which. Internal to what decides where the outside is.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// The boxes and triangles of some shells. Refers to positions and triangles.
class Nesting {
 public:
  /// `shell`: per triangle the number of its shell, below `count`, or kNone if it belongs to none. O(n).
  Nesting(std::span<const Point> positions, std::span<const Triangle> triangles, std::span<const Index> shell,
          Index count);

  /// Whether a vertex of `inner` lies within `outer`, by the solid angle that `outer` covers around it.
  /// O(triangles of `outer`) where the box of the one holds that of the other, else O(1).
  bool encloses(Index outer, Index inner) const;
  /// How many other shells enclose this one. O(shells), and encloses() of those whose box holds its box.
  Index depth(Index shell) const;
  /// Whether the box of another shell holds the box of this one: else it is an outermost one. O(shells).
  bool is_boxed(Index shell) const;

 private:
  bool holds_box(Index outer, Index inner) const;
  /// Whether `is_such` holds for any shell that is large enough to hold this one; stops at the first.
  template <class IsSuch>
  bool any_larger(Index shell, const IsSuch& is_such) const;

  std::span<const Point> positions_;
  std::span<const Triangle> triangles_;
  std::vector<Index> first_;    // per shell, and one: of its triangles in members_
  std::vector<Index> members_;  // triangles by shell
  std::vector<BoundingBox> boxes_;
  std::vector<double> sizes_;   // their diagonals
  std::vector<Index> by_size_;  // shells, the largest box first
};

}  // namespace morsel::core
