#pragma once
/// How far points agree with marked ones, by distances along the surface.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/types.h"
#include "morsel/morse/operators/surface_distance.h"
#include "morsel/tools/study/agreement.h"

namespace morsel::tools {

/// A set of points compared with the marked ones, in three ways.
struct MarkScore {
  /// Within the radius, any number of points may hit one mark, and any number of marks may be hit by one
  /// point.
  std::size_t marks_hit = 0;   ///< marks with a point in reach
  std::size_t points_hit = 0;  ///< points with a mark in reach
  /// One to one, as many pairs within the radius as possible (match_in_reach()); the marks are the reference.
  Agreement one_to_one;
  /// Marks that are detected as Dutagaci, Cheung, Godil 2012 count them ("Evaluation of 3D interest point
  /// detection techniques via human-generated ground truth", The Visual Computer 28): by a point in reach
  /// that is not nearer to another mark, so that no point detects two. Of two marks as near it is the first.
  std::size_t detected = 0;
  std::vector<std::size_t> detected_within;  ///< the same for each radius of the curve

  std::size_t marks() const { return one_to_one.reference; }
  std::size_t points() const { return one_to_one.found; }
  double recall() const { return ratio(marks_hit, marks()); }
  double precision() const { return ratio(points_hit, points()); }
  double f_score() const;
  /// 1 − detected / marks, and (points − detected) / points: the errors of Dutagaci et al. Without a point
  /// the first is 1 and the second 0.
  double false_negatives() const { return 1 - ratio(detected, marks()); }
  double false_positives() const { return 1 - ratio(detected, points()); }
  double false_negatives(std::size_t step) const { return 1 - ratio(detected_within[step], marks()); }
  double false_positives(std::size_t step) const { return 1 - ratio(detected_within[step], points()); }
};

/// Scores sets of points against the marked vertices of one mesh. Distances are those of SurfaceDistances,
/// taken from the marks; every radius is inclusive.
class MarkScorer {
 public:
  /// `marks` are different; `radius` and `curve`, the radii of detected_within, at least 0. A search around
  /// each mark, as wide as the largest radius, serial; keeps 16 bytes for each vertex that it reaches.
  MarkScorer(const morse::SurfaceDistances& distances, std::span<const core::Index> marks, double radius,
             std::vector<double> curve);

  /// `points` are different vertices. May be called from any number of threads.
  MarkScore score(std::span<const core::Index> points) const;

 private:
  struct NearMark {
    core::Index mark;  // by its place in `marks`
    double distance;
  };

  std::size_t marks_;
  double radius_;
  std::vector<double> curve_;
  std::vector<std::vector<NearMark>> near_;  // per vertex
};

}  // namespace morsel::tools
