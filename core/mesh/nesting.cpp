#include "morsel/core/mesh/nesting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "morsel/core/parallel/stop.h"

namespace morsel::core {
namespace {

/// The vector's direction; zero if it has none.
Point direction(const Point& from, const Point& to) {
  const Point d = to - from;
  const double length = d.stableNorm();
  return length > 0 ? Point(d / length) : Point::Zero();
}

/// The solid angle of a triangle seen from `from` (van Oosterom and Strackee 1983), signed.
double solid_angle(const Point& from, const Point& p, const Point& q, const Point& r) {
  const Point a = direction(from, p);
  const Point b = direction(from, q);
  const Point c = direction(from, r);
  if (a.isZero(0) || b.isZero(0) || c.isZero(0)) return 0;
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace

Nesting::Nesting(std::span<const Point> positions, std::span<const Triangle> triangles,
                 std::span<const Index> shell, Index count)
    : positions_(positions),
      triangles_(triangles),
      first_(count + 1, 0),
      boxes_(count),
      sizes_(count),
      by_size_(count) {
  for (const Index s : shell)
    if (s != kNone) ++first_[s + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  members_.resize(first_.back());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index t = 0; t < shell.size(); ++t)
    if (shell[t] != kNone) members_[next[shell[t]]++] = t;
  for (Index s = 0; s < count; ++s) {
    BoundingBox& box = boxes_[s];
    box.min = box.max = positions_[triangles_[members_[first_[s]]][0]];
    for (Index i = first_[s]; i < first_[s + 1]; ++i)
      for (const Index v : triangles_[members_[i]]) {
        box.min = box.min.cwiseMin(positions_[v]);
        box.max = box.max.cwiseMax(positions_[v]);
      }
    const double diagonal = (box.max - box.min).stableNorm();
    sizes_[s] = std::isnan(diagonal) ? 0 : diagonal;  // before a repair positions may be no numbers
  }
  std::iota(by_size_.begin(), by_size_.end(), Index{0});
  std::ranges::stable_sort(by_size_, [&](Index a, Index b) { return sizes_[a] > sizes_[b]; });
}

bool Nesting::holds_box(Index outer, Index inner) const {
  const BoundingBox& around = boxes_[outer];
  const BoundingBox& within = boxes_[inner];
  return (within.min.array() >= around.min.array()).all() && (within.max.array() <= around.max.array()).all();
}

bool Nesting::encloses(Index outer, Index inner) const {
  if (!holds_box(outer, inner)) return false;
  throw_if_stopped();
  const Point& witness = positions_[triangles_[members_[first_[inner]]][0]];
  double angle = 0;
  for (Index i = first_[outer]; i < first_[outer + 1]; ++i) {
    const Triangle& t = triangles_[members_[i]];
    angle += solid_angle(witness, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
  }
  // Inside it is 4 pi, on the shell itself up to half of that.
  return std::abs(angle) > 3 * M_PI;
}

template <class IsSuch>
bool Nesting::any_larger(Index shell, const IsSuch& is_such) const {
  for (const Index other : by_size_) {
    if (sizes_[other] < sizes_[shell]) break;
    if (other != shell && is_such(other)) return true;
  }
  return false;
}

Index Nesting::depth(Index shell) const {
  Index found = 0;
  any_larger(shell, [&](Index other) {
    found += encloses(other, shell) ? 1 : 0;
    return false;
  });
  return found;
}

bool Nesting::is_boxed(Index shell) const {
  return any_larger(shell, [&](Index other) { return holds_box(other, shell); });
}

}  // namespace morsel::core
