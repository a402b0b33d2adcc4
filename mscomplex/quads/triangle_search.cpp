#include "morsel/mscomplex/quads/triangle_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace morsel::mscomplex {

using core::Index;
using core::Point;

namespace {

Point nearest_on_segment(const Point& x, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((x - a).dot(ab) / length, 0.0, 1.0) : 0;
  return a + t * ab;
}

Point nearest_on_triangle(const Point& x, const std::array<Point, 3>& p) {
  const Point u = p[1] - p[0];
  const Point v = p[2] - p[0];
  const Point normal = u.cross(v);
  const double area = normal.squaredNorm();
  if (area > 0) {
    const Point w = x - p[0];
    const double b = w.cross(v).dot(normal) / area;
    const double c = u.cross(w).dot(normal) / area;
    if (b >= 0 && c >= 0 && b + c <= 1) return p[0] + b * u + c * v;
  }
  Point nearest = nearest_on_segment(x, p[0], p[1]);
  for (const Point& other : {nearest_on_segment(x, p[1], p[2]), nearest_on_segment(x, p[2], p[0])})
    if ((other - x).squaredNorm() < (nearest - x).squaredNorm()) nearest = other;
  return nearest;
}

}  // namespace

TriangleSearch::TriangleSearch(std::span<const Point> positions, std::span<const core::Triangle> triangles) {
  std::vector<Point> middle;
  middle.reserve(triangles.size());
  for (const core::Triangle& t : triangles)
    middle.emplace_back((positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3);
  std::vector<Index> order(triangles.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::size_t nodes = 1;
  while (kLeaf * (nodes + 1) / 2 < triangles.size()) nodes = 2 * nodes + 1;
  boxes_.resize(nodes);
  if (!triangles.empty()) build(0, 0, triangles.size(), order, middle);
  corners_.reserve(triangles.size());
  for (const Index i : order)
    corners_.push_back({positions[triangles[i][0]], positions[triangles[i][1]], positions[triangles[i][2]]});
  const std::size_t first_leaf = boxes_.size() / 2;
  // Boxes from the leaves up, each leaf's range found again by halving.
  const auto fill = [&](const auto& self, std::size_t node, std::size_t first, std::size_t last) -> void {
    Box& box = boxes_[node];
    const double infinity = std::numeric_limits<double>::infinity();
    box = {Point::Constant(infinity), Point::Constant(-infinity)};
    if (node >= first_leaf) {
      for (std::size_t i = first; i < last; ++i)
        for (const Point& p : corners_[i]) {
          box.min = box.min.cwiseMin(p);
          box.max = box.max.cwiseMax(p);
        }
      return;
    }
    const std::size_t half = first + (last - first) / 2;
    self(self, 2 * node + 1, first, half);
    self(self, 2 * node + 2, half, last);
    box.min = boxes_[2 * node + 1].min.cwiseMin(boxes_[2 * node + 2].min);
    box.max = boxes_[2 * node + 1].max.cwiseMax(boxes_[2 * node + 2].max);
  };
  fill(fill, 0, 0, corners_.size());
}

void TriangleSearch::build(Index node, std::size_t first, std::size_t last, std::vector<Index>& order,
                           const std::vector<Point>& middle) {
  if (node >= boxes_.size() / 2) return;
  Point low = middle[order[first]];
  Point high = low;
  for (std::size_t i = first; i < last; ++i) {
    low = low.cwiseMin(middle[order[i]]);
    high = high.cwiseMax(middle[order[i]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = first + (last - first) / 2;
  std::nth_element(
      order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(half),
      order.begin() + static_cast<std::ptrdiff_t>(last),
      [&](Index a, Index b) { return std::pair(middle[a][axis], a) < std::pair(middle[b][axis], b); });
  build(2 * node + 1, first, half, order, middle);
  build(2 * node + 2, half, last, order, middle);
}

void TriangleSearch::search(const Point& x, double& best, Point& at) const {
  const auto square_to = [&](const Box& box) {
    return (box.min - x).cwiseMax(x - box.max).cwiseMax(Point::Zero()).squaredNorm();
  };
  const auto visit = [&](const auto& self, std::size_t node, std::size_t first, std::size_t last) -> void {
    if (node >= boxes_.size() / 2) {
      for (std::size_t i = first; i < last; ++i) {
        const Point nearest = nearest_on_triangle(x, corners_[i]);
        const double square = (nearest - x).squaredNorm();
        if (square >= best) continue;
        best = square;
        at = nearest;
      }
      return;
    }
    const std::size_t half = first + (last - first) / 2;
    const double left = square_to(boxes_[2 * node + 1]);
    const double right = square_to(boxes_[2 * node + 2]);
    const bool left_first = left <= right;
    if (std::min(left, right) >= best) return;
    if (left_first)
      self(self, 2 * node + 1, first, half);
    else
      self(self, 2 * node + 2, half, last);
    if (std::max(left, right) >= best) return;
    if (left_first)
      self(self, 2 * node + 2, half, last);
    else
      self(self, 2 * node + 1, first, half);
  };
  visit(visit, 0, 0, corners_.size());
}

double TriangleSearch::distance(const Point& x) const {
  double best = std::numeric_limits<double>::infinity();
  Point at;
  search(x, best, at);
  return std::sqrt(best);
}

Point TriangleSearch::nearest(const Point& x) const {
  double best = std::numeric_limits<double>::infinity();
  Point at = x;
  search(x, best, at);
  return at;
}

}  // namespace morsel::mscomplex
