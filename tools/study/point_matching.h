#pragma once
/// Matching of two sets of points.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/types.h"

namespace morsel::tools {

/// Two points that belong together, by their places in the two sets.
struct PointPair {
  std::size_t reference;
  std::size_t other;
  double distance;
};

/// Matches sets of points with one reference set, one to one, within a radius (inclusive, Euclidean): as many
/// pairs as possible and, among all such matchings, one with the least sum of distances. So it does not
/// depend on an order in which pairs are made, and gives up no pair for a nearer one.
/// (match_critical_points() of a report takes the nearest pair first.)
class PointMatcher {
 public:
  /// Throws InvalidArgument if the radius is negative or NaN.
  PointMatcher(std::span<const core::Point> reference, double radius);

  /// The pairs by ascending `other`. By shortest augmenting paths (the assignment problem; Jonker, Volgenant
  /// 1987), in whole numbers of 2⁻³⁰ radii: O(m k) where few points are in each other's reach, O(m² k log m)
  /// at worst, for m points with k reference points in reach. May be called from any number of threads.
  std::vector<PointPair> match(std::span<const core::Point> other) const;

  std::size_t size() const { return reference_.size(); }

 private:
  std::vector<core::Point> reference_;
  core::PointSearch search_;
  double radius_;
};

}  // namespace morsel::tools
