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

/// A reference point that another point can be matched with.
struct InReach {
  core::Index reference;
  double distance;
};

/// Matches points one to one: as many pairs as possible and, among all such matchings, one with the least sum
/// of distances. So it does not depend on an order in which pairs are made, and gives up no pair for a nearer
/// one. (match_critical_points() of a report takes the nearest pair first.)
///
/// reach[j] lists the reference points, of `reference_count`, that the j-th other point can be matched with,
/// by distances of any kind from 0 to `radius`. The pairs by ascending `other`. By shortest augmenting paths
/// (the assignment problem; Jonker, Volgenant 1987), in whole numbers of 2⁻³⁰ radii: O(m k) where few points
/// are in each other's reach, O(m² k log m) at worst, for m points with k reference points in reach.
std::vector<PointPair> match_in_reach(std::span<const std::vector<InReach>> reach,
                                      std::size_t reference_count, double radius);

/// Matches sets of points with one reference set, as match_in_reach(), within a radius (inclusive,
/// Euclidean).
class PointMatcher {
 public:
  /// Throws InvalidArgument if the radius is negative or NaN.
  PointMatcher(std::span<const core::Point> reference, double radius);

  /// The pairs by ascending `other`. May be called from any number of threads.
  std::vector<PointPair> match(std::span<const core::Point> other) const;

  std::size_t size() const { return reference_.size(); }

 private:
  std::vector<core::Point> reference_;
  core::PointSearch search_;
  double radius_;
};

}  // namespace morsel::tools
