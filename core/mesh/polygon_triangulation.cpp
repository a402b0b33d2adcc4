#include "morsel/core/mesh/polygon_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/mesh/large_polygon.h"

namespace morsel::core {
namespace {

constexpr std::size_t kSmallPolygon = 64;

}  // namespace

void PolygonTriangulator::triangulate(std::span<const Index> polygon, std::size_t face,
                                      std::vector<Triangle>& triangles) {
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  progress_.throw_if_cancelled();
  place(polygon);
  if (polygon.size() == 4) {
    cut_quad(polygon, triangles);
  } else if (polygon.size() <= kSmallPolygon) {
    clip_ears(polygon, triangles);
  } else {
    tests_left_ += tests_per_corner_ * polygon.size();
    if (!cut_large_polygon({polygon, local_, normal_}, edges_, tests_left_, triangles, progress_))
      throw BadInput("face " + std::to_string(face) + " is a polygon of " + std::to_string(polygon.size()) +
                     " corners, too intricate to be cut into triangles");
  }
}

/// Scaling to unit size keeps products of coordinates in range.
void PolygonTriangulator::place(std::span<const Index> polygon) {
  const Point origin = positions_[polygon[0]];
  local_.clear();
  double size = 0;
  for (const Index v : polygon) {
    local_.push_back(positions_[v] - origin);
    size = std::max(size, local_.back().cwiseAbs().maxCoeff());
  }
  normal_ = Point::Zero();
  if (!(size > 0) || !std::isfinite(size)) return;
  for (Point& p : local_) p /= size;
  for (std::size_t i = 0; i < local_.size(); ++i) normal_ += local_[i].cross(local_[(i + 1) % local_.size()]);
  const double length = normal_.norm();
  if (length > 1e-14) normal_ /= length;
  if (!normal_.allFinite()) normal_ = Point::Zero();
}

double PolygonTriangulator::shape(std::size_t a, std::size_t b, std::size_t c) const {
  return PlacedPolygon{{}, local_, normal_}.shape(a, b, c);
}

void PolygonTriangulator::cut_quad(std::span<const Index> polygon, std::vector<Triangle>& triangles) {
  const auto [a, b, c, d] = std::array{polygon[0], polygon[1], polygon[2], polygon[3]};
  const auto is_free = [&](Index u, Index v) { return u != v && !edges_.contains(u, v); };
  const bool free_ac = is_free(a, c);
  const bool free_bd = is_free(b, d);
  const double shape_ac = std::min(shape(0, 1, 2), shape(0, 2, 3));
  const double shape_bd = std::min(shape(1, 2, 3), shape(1, 3, 0));
  // Rounding must not decide between equals, or a grid of squares gets random diagonals.
  const bool take_ac = free_ac != free_bd ? free_ac : shape_ac >= shape_bd - 1e-9;
  if (take_ac) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
    if (a != c) edges_.insert(a, c);
  } else {
    triangles.push_back({b, c, d});
    triangles.push_back({b, d, a});
    if (b != d) edges_.insert(b, d);
  }
}

/// Whether no corner lies in the ear abc or on its diagonal ca. If any corner is inside, a reflex one is, so
/// only those are tested.
bool PolygonTriangulator::is_empty(std::size_t a, std::size_t b, std::size_t c) const {
  const auto side = [&](std::size_t from, std::size_t to, const Point& p) {
    return normal_.dot((local_[to] - local_[from]).cross(p - local_[from]));
  };
  for (const std::size_t i : reflex_) {
    if (i == a || i == b || i == c || is_gone(i)) continue;
    const Point& p = local_[i];
    if (p == local_[a] || p == local_[b] || p == local_[c]) continue;  // the polygon touches itself
    if (side(a, b, p) > 0 && side(b, c, p) > 0 && side(c, a, p) >= 0) return false;
  }
  return true;
}

bool PolygonTriangulator::is_reflex(std::size_t i) const { return !(shape(previous_[i], i, next_[i]) > 0); }

/// The first of the best shaped from `start` on.
PolygonTriangulator::Ear PolygonTriangulator::best_ear(std::span<const Index> polygon,
                                                       std::size_t start) const {
  Ear best;
  std::size_t b = start;
  do {
    const std::size_t a = previous_[b];
    const std::size_t c = next_[b];
    Ear ear{b, Ear::degenerate, shape(a, b, c)};
    if (polygon[a] != polygon[c] && polygon[a] != polygon[b] && polygon[b] != polygon[c])
      ear.rank = edges_.contains(polygon[a], polygon[c]) ? Ear::taken : Ear::crossing;
    const bool may_win = best.rank != Ear::proper || ear.shape > best.shape + 1e-9;
    if (may_win && ear.rank == Ear::crossing && ear.shape > 0 && is_empty(a, b, c)) ear.rank = Ear::proper;
    // Rounding must not decide between equals.
    if (ear.rank > best.rank || (ear.rank == best.rank && ear.shape > best.shape + 1e-9)) best = ear;
    b = c;
  } while (b != start);
  return best;
}

void PolygonTriangulator::clip_ears(std::span<const Index> polygon, std::vector<Triangle>& triangles) {
  const std::size_t n = polygon.size();
  previous_.resize(n);
  next_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    previous_[i] = i == 0 ? n - 1 : i - 1;
    next_[i] = i + 1 == n ? 0 : i + 1;
  }
  reflex_.clear();
  for (std::size_t i = 0; i < n; ++i)
    if (is_reflex(i)) reflex_.push_back(i);
  std::size_t start = 0;
  for (std::size_t left = n; left > 3; --left) {
    const std::size_t b = best_ear(polygon, start).corner;
    const std::size_t a = previous_[b];
    const std::size_t c = next_[b];
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
    if (polygon[a] != polygon[c]) edges_.insert(polygon[a], polygon[c]);
    next_[a] = c;
    previous_[c] = a;
    previous_[b] = b;  // removed
    start = next_[c];
  }
  const std::size_t a = start;
  triangles.push_back({polygon[a], polygon[next_[a]], polygon[previous_[a]]});
}

}  // namespace morsel::core
