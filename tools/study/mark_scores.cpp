#include "morsel/tools/study/mark_scores.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/stop.h"
#include "morsel/tools/study/point_matching.h"

namespace morsel::tools {
namespace {

/// A search finds what is nearer than its radius; what is at this one is to be found, too.
double just_beyond(double radius) { return std::max(radius * (1 + 1e-9), 1e-300); }

}  // namespace

double MarkScore::f_score() const {
  const double sum = recall() + precision();
  return sum > 0 ? 2 * recall() * precision() / sum : 0;
}

MarkScorer::MarkScorer(const morse::SurfaceDistances& distances, std::span<const core::Index> marks,
                       double radius, std::vector<double> curve)
    : marks_(marks.size()), radius_(radius), curve_(std::move(curve)), near_(distances.vertex_count()) {
  double widest = radius;
  for (const double one : curve_) widest = std::max(widest, one);
  morse::SurfaceDistances::Search search(distances);
  for (std::size_t mark = 0; mark < marks.size(); ++mark) {
    core::throw_if_stopped();
    for (const auto& [v, distance] : search.within(marks[mark], just_beyond(widest)))
      near_[v].push_back({static_cast<core::Index>(mark), distance});
  }
}

MarkScore MarkScorer::score(std::span<const core::Index> points) const {
  MarkScore score;
  std::vector<std::vector<InReach>> reach(points.size());
  std::vector<bool> is_hit(marks_, false);
  std::vector<double> detected_at(marks_, HUGE_VAL);  // by the nearest of the points that are nearest to it
  for (std::size_t j = 0; j < points.size(); ++j) {
    const std::vector<NearMark>& near = near_[points[j]];
    for (const auto& [mark, distance] : near) {
      if (distance > radius_) continue;
      reach[j].push_back({mark, distance});
      is_hit[mark] = true;
    }
    if (!reach[j].empty()) ++score.points_hit;
    const auto nearest = std::ranges::min_element(near, {}, &NearMark::distance);  // of several the first
    if (nearest != near.end())
      detected_at[nearest->mark] = std::min(detected_at[nearest->mark], nearest->distance);
  }
  score.marks_hit = static_cast<std::size_t>(std::ranges::count(is_hit, true));
  score.one_to_one.reference = marks_;
  score.one_to_one.found = points.size();
  const PointMatches matches = match_in_reach(reach, marks_, radius_);
  score.one_to_one.matched = matches.pairs.size();
  for (const PointPair& pair : matches.pairs) score.one_to_one.distances += pair.distance;
  score.one_to_one.is_least = matches.is_least;
  const auto detected_within = [&](double radius) {
    return static_cast<std::size_t>(
        std::ranges::count_if(detected_at, [&](double d) { return d <= radius; }));
  };
  score.detected = detected_within(radius_);
  for (const double radius : curve_) score.detected_within.push_back(detected_within(radius));
  return score;
}

}  // namespace morsel::tools
