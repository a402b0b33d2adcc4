#pragma once
/// Points of a polygon that may lie in an ear. Internal to the triangulation of polygons.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::core {

/// The corners of a polygon, with removal and the query whether any of them lies in a triangle.
///
/// Two binary trees of oriented boxes, so that a chain of corners close to a straight side has a thin box
/// (Gottschalk, Lin, Manocha 1996). One tree halves the corners as they are spread in the plane, the other as
/// they follow one another in the polygon; a query alternates between both and ends as soon as either is
/// searched completely. The first is good for spirals, the second for narrow spikes, in which a thin triangle
/// would meet √n boxes of the first. O(n log n) for making them and for all removals; a query usually takes
/// O(log n).
class CornerTree {
 public:
  /// Holds these corners of a polygon, projected along `normal` of unit length; `positions` must outlive
  /// this.
  CornerTree(std::span<const Point> positions, const Point& normal, std::span<const std::size_t> corners);

  void remove(std::size_t corner);

  /// Whether one of the corners lies in the triangle, its side ca included. Corners at the position of a, b
  /// or c do not count: the polygon touches itself there. Adds the number of boxes and corners tested to
  /// `tests`.
  bool any_in(std::size_t a, std::size_t b, std::size_t c, std::uint64_t& tests);

 private:
  using Plane = Eigen::Vector2d;

  /// The corners at one place.
  struct Site {
    Plane place;
    Index corner = 0;             ///< the first of them
    Index count = 0;              ///< how many are left
    std::array<Index, 2> leaf{};  ///< by tree
  };
  struct Node {
    Plane center, axis;  ///< of the box; the other axis is a quarter turn from this
    Plane extent;        ///< half of it, along both axes
    Index parent = kNone;
    Index right = kNone;        ///< child; the left one follows its parent; kNone at a leaf
    Index first = 0, last = 0;  ///< its sites, in the tree's order
    Index count = 0;            ///< those of them that have corners left
  };
  struct Tree {
    std::vector<Index> order;  ///< of the sites
    std::vector<Node> nodes;   ///< the root first
  };
  struct Triangle2;
  struct Search;
  enum class Outcome { unfinished, found, nothing };

  void build();
  void build_node(std::size_t tree, Index parent, Index first, Index last);
  void fit_box(Node& node, std::span<const Index> sites) const;
  Outcome advance(Search& search, const Triangle2& triangle, std::uint64_t steps) const;

  std::span<const Point> positions_;
  Point normal_, across_, up_;  // normal_ and two axes of the plane
  std::vector<Site> sites_;
  std::vector<Index> site_of_;  // per corner of the polygon; kNone for those that are not here
  std::array<Tree, 2> trees_;
  std::size_t better_ = 0;  // the tree in which the last search ended
  std::size_t left_ = 0;    // sites that have corners left
};

}  // namespace morsel::core
