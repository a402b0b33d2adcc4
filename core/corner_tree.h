#pragma once
/// Points of a polygon that may lie in an ear. Internal to the triangulation of polygons.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::core {

/// Corners of a polygon, of which any can be removed, and the question whether one of them lies in a triangle.
///
/// A binary tree of boxes, each turned as its points lie, so that a chain of corners close to a straight side is a thin box
/// (Gottschalk, Lin, Manocha 1996). O(n log n) for making it and for all removals; a question takes O(log n) as a rule and
/// O(√n) for a thin triangle across evenly spread points.
class CornerTree {
 public:
  /// Of these corners of a polygon that is seen against `normal`, of unit length; `positions` must outlive this.
  CornerTree(std::span<const Point> positions, const Point& normal, std::span<const std::size_t> corners);

  void remove(std::size_t corner);

  /// Whether one of the corners lies in the triangle, its side ca included. Corners at the place of a, b or c do not: the
  /// polygon touches itself there. Adds the number of boxes and corners looked at to `tests`.
  bool any_in(std::size_t a, std::size_t b, std::size_t c, std::uint64_t& tests) const;

 private:
  using Plane = Eigen::Vector2d;

  /// The corners at one place.
  struct Site {
    Plane place;
    Index corner = 0;  ///< one of them
    Index count = 0;
    Index leaf = 0;
  };
  struct Node {
    Plane center, axis;  ///< of the box; the other axis is a quarter turn from this
    Plane extent;        ///< half of it, along both axes
    Index parent = kNone;
    Index right = kNone;        ///< child; the left one follows its parent; kNone at a leaf
    Index first = 0, last = 0;  ///< its sites, in order_
    Index count = 0;            ///< those of them that have corners left
  };
  class Triangle2;

  void build();
  void build_node(Index parent, Index first, Index last);
  void fit_box(Node& node);
  bool is_in(std::size_t a, std::size_t b, std::size_t c, const Point& p) const;

  std::span<const Point> positions_;
  Point normal_, across_, up_;  // normal_ and two axes of the plane
  std::vector<Site> sites_;
  std::vector<Index> site_of_;  // per corner of the polygon; kNone for those that are not here
  std::vector<Index> order_;    // sites as the tree has them
  std::vector<Node> nodes_;     // the root first
  std::size_t left_ = 0;        // sites that have corners left
};

}  // namespace morsel::core
