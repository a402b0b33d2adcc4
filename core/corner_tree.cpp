#include "morsel/core/corner_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace morsel::core {
namespace {

constexpr Index kLeaf = 4;        // sites
constexpr double kRound = 1e-14;  // more than rounding adds to coordinates of at most 1

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The direction in which points spread most, from the sums of their squared and mixed differences from the mean.
Eigen::Vector2d principal_axis(double xx, double xy, double yy) {
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

/// A triangle that runs counter-clockwise.
class CornerTree::Triangle2 {
 public:
  Triangle2(const Plane& a, const Plane& b, const Plane& c) : corner_{a, b, c}, side_{b - a, c - b, a - c} {}

  /// Whether a line separates it from a box with certainty: one of its sides, or a side of the box.
  bool is_apart(const Node& box) const {
    const Plane other = turned(box.axis);
    for (int i = 0; i < 3; ++i) {
      const Plane from = box.center - corner_[i];
      const double reach = std::abs(cross(side_[i], box.axis)) * box.extent.x() +
                           std::abs(cross(side_[i], other)) * box.extent.y();
      const double size = side_[i].lpNorm<1>() + from.lpNorm<1>() + box.extent.sum();
      if (cross(side_[i], from) + reach < -kRound * size) return true;
    }
    return is_beyond(box.axis, box.center, box.extent.x()) || is_beyond(other, box.center, box.extent.y());
  }

 private:
  bool is_beyond(const Plane& axis, const Plane& center, double extent) const {
    const double a = axis.dot(corner_[0] - center);
    const double b = axis.dot(corner_[1] - center);
    const double c = axis.dot(corner_[2] - center);
    return std::min({a, b, c}) > extent + kRound || std::max({a, b, c}) < -extent - kRound;
  }

  std::array<Plane, 3> corner_, side_;
};

CornerTree::CornerTree(std::span<const Point> positions, const Point& normal,
                       std::span<const std::size_t> corners)
    : positions_(positions), normal_(normal), across_(normal.unitOrthogonal()), up_(normal.cross(across_)) {
  std::vector<std::size_t> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t i, std::size_t k) {
    const Point &p = positions[i], &q = positions[k];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  site_of_.assign(positions.size(), kNone);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Point& p = positions[sorted[i]];
    if (i == 0 || p != positions[sorted[i - 1]])
      sites_.push_back({{across_.dot(p), up_.dot(p)}, static_cast<Index>(sorted[i])});
    ++sites_.back().count;
    site_of_[sorted[i]] = static_cast<Index>(sites_.size() - 1);
  }
  build();
}

/// Makes the tree of the sites that have corners left.
void CornerTree::build() {
  order_.clear();
  for (Index s = 0; s < sites_.size(); ++s)
    if (sites_[s].count > 0) order_.push_back(s);
  left_ = order_.size();
  nodes_.clear();
  if (left_ > 0) build_node(kNone, 0, static_cast<Index>(left_));
}

void CornerTree::build_node(Index parent, Index first, Index last) {
  const auto self = static_cast<Index>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.parent = parent;
  node.first = first;
  node.last = last;
  node.count = last - first;
  fit_box(node);
  if (last - first <= kLeaf) {
    for (Index i = first; i < last; ++i) sites_[order_[i]].leaf = self;
    return;
  }
  const Index middle = first + (last - first) / 2;
  const Plane axis = node.axis;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](Index i, Index k) { return axis.dot(sites_[i].place) < axis.dot(sites_[k].place); });
  build_node(self, first, middle);
  nodes_[self].right = static_cast<Index>(nodes_.size());
  build_node(self, middle, last);
}

/// Turns the box so that its first axis is the one along which the sites spread most.
void CornerTree::fit_box(Node& node) {
  const auto sites = std::span(order_).subspan(node.first, node.last - node.first);
  Plane mean = Plane::Zero();
  for (const Index s : sites) mean += sites_[s].place;
  mean /= static_cast<double>(sites.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Index s : sites) {
    const Plane d = sites_[s].place - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  node.axis = principal_axis(xx, xy, yy);
  const Plane other = turned(node.axis);
  Plane low = Plane::Constant(std::numeric_limits<double>::infinity());
  Plane high = -low;
  for (const Index s : sites) {
    const Plane d = sites_[s].place - mean;
    const Plane along(node.axis.dot(d), other.dot(d));
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  const Plane middle = (low + high) / 2;
  node.center = mean + middle.x() * node.axis + middle.y() * other;
  node.extent = (high - low) / 2;
}

void CornerTree::remove(std::size_t corner) {
  if (site_of_[corner] == kNone) return;
  Site& site = sites_[site_of_[corner]];
  site_of_[corner] = kNone;
  if (--site.count > 0) return;
  for (Index n = site.leaf; n != kNone; n = nodes_[n].parent) --nodes_[n].count;
  --left_;
  if (2 * left_ < order_.size() && order_.size() > 8 * kLeaf) build();  // tighter boxes
}

bool CornerTree::is_in(std::size_t a, std::size_t b, std::size_t c, const Point& p) const {
  if (p == positions_[a] || p == positions_[b] || p == positions_[c]) return false;
  const auto side = [&](std::size_t from, std::size_t to) {
    return normal_.dot((positions_[to] - positions_[from]).cross(p - positions_[from]));
  };
  return side(a, b) > 0 && side(b, c) > 0 && side(c, a) >= 0;
}

bool CornerTree::any_in(std::size_t a, std::size_t b, std::size_t c, std::uint64_t& tests) const {
  if (left_ == 0) return false;
  const auto in_plane = [&](std::size_t i) {
    return Plane(across_.dot(positions_[i]), up_.dot(positions_[i]));
  };
  const Triangle2 triangle(in_plane(a), in_plane(b), in_plane(c));
  std::array<Index, 64> pending;  // the tree is as deep as a number of sites has bits
  std::size_t count = 0;
  pending[count++] = 0;
  while (count > 0) {
    const Index n = pending[--count];
    const Node& node = nodes_[n];
    if (node.count == 0) continue;
    ++tests;
    if (triangle.is_apart(node)) continue;
    if (node.right != kNone) {
      pending[count++] = node.right;
      pending[count++] = n + 1;
      continue;
    }
    for (Index i = node.first; i < node.last; ++i) {
      const Site& site = sites_[order_[i]];
      if (site.count == 0) continue;
      ++tests;
      if (is_in(a, b, c, positions_[site.corner])) return true;
    }
  }
  return false;
}

}  // namespace morsel::core
