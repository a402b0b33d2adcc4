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

/// Bounds of the search for a least sum of distances, which ordinary points are far from: beyond them a sum
/// that is nearly least is found. They are counts, so that results depend on the points alone.
struct MatchingBounds {
  std::size_t pairs = std::size_t{1} << 23;  ///< that are in reach of one another; 16 bytes each
  std::size_t steps = std::size_t{1} << 27;  ///< looks at pairs; the order of a second
  std::size_t nearest = 32;                  ///< beyond `pairs`, reference points for each other point
};

/// A matching of as many pairs as possible.
struct PointMatches {
  std::vector<PointPair> pairs;  ///< by ascending `other`
  bool is_least = true;          ///< no other of as many pairs has a smaller sum of distances
};

/// Matches points one to one: as many pairs as possible and, among all such matchings, one with the least sum
/// of distances. So it does not depend on an order in which pairs are made, and gives up no pair for a nearer
/// one. (match_critical_points() of a report takes the nearest pair first.)
///
/// reach[j] lists the reference points, of `reference_count`, that the j-th other point can be matched with,
/// by distances of any kind from 0 to `radius`. By shortest augmenting paths (the assignment problem; Jonker,
/// Volgenant 1987), in whole numbers of 2⁻³⁰ radii: O(m k) where few points are in each other's reach,
/// O(m² k log m) at worst, for m points with k reference points in reach. Where that would take more than
/// bounds.steps, points that are left are matched as enlarge_matching() does, in O(√m m k): the number of
/// pairs is the same, but their sum of distances is not always the least (`is_least` is false).
///
/// Stops as core::throw_if_stopped().
PointMatches match_in_reach(std::span<const std::vector<InReach>> reach, std::size_t reference_count,
                            double radius, const MatchingBounds& bounds = {});

/// Matches sets of points with one reference set, as match_in_reach(), within a radius (inclusive,
/// Euclidean).
class PointMatcher {
 public:
  /// Throws InvalidArgument if the radius is negative or NaN.
  PointMatcher(std::span<const core::Point> reference, double radius, const MatchingBounds& bounds = {});

  /// May be called from any number of threads. Where more than bounds.pairs are in reach, the least sum is
  /// looked for among the bounds.nearest reference points of each point (`is_least` is false); the number of
  /// pairs is the largest all the same. So time is near-linear, but for O(√m) rounds at worst, and memory
  /// linear.
  PointMatches match(std::span<const core::Point> other) const;

  /// The number of pairs of match(), without their sum of distances: O(√m m log m) at worst.
  std::size_t count(std::span<const core::Point> other) const;

  std::size_t size() const { return reference_.size(); }

 private:
  class Pools;

  std::vector<core::Point> reference_;
  core::PointSearch search_;
  double radius_;
  MatchingBounds bounds_;
  double scale_;  // a power of two that keeps squares of distances in range
};

}  // namespace morsel::tools
