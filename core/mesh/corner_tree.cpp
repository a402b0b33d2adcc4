#include "morsel/core/mesh/corner_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace morsel::core {
namespace {

constexpr Index kLeaf = 4;  // sites
constexpr std::uint64_t kFirstSteps = 128;
constexpr double kRound = 1e-14;  // more than rounding adds to coordinates of at most 1

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The direction in which points spread most, from the sums of their squared and mixed differences from the
/// mean.
Eigen::Vector2d principal_axis(double xx, double xy, double yy) {
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

/// A triangle that runs counter-clockwise.
struct CornerTree::Triangle2 {
  std::array<Point, 3> point;
  std::array<Plane, 3> corner;  ///< the same in the plane
  std::array<Plane, 3> side = {corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2]};

  /// Whether a line separates it from a box with certainty: one of its sides, or a side of the box.
  bool is_apart(const Node& box) const {
    const Plane other = turned(box.axis);
    for (int i = 0; i < 3; ++i) {
      const Plane from = box.center - corner[i];
      const double reach = std::abs(cross(side[i], box.axis)) * box.extent.x() +
                           std::abs(cross(side[i], other)) * box.extent.y();
      const double size = side[i].lpNorm<1>() + from.lpNorm<1>() + box.extent.sum();
      if (cross(side[i], from) + reach < -kRound * size) return true;
    }
    return is_beyond(box.axis, box.center, box.extent.x()) || is_beyond(other, box.center, box.extent.y());
  }

  bool is_beyond(const Plane& axis, const Plane& center, double extent) const {
    const double a = axis.dot(corner[0] - center);
    const double b = axis.dot(corner[1] - center);
    const double c = axis.dot(corner[2] - center);
    return std::min({a, b, c}) > extent + kRound || std::max({a, b, c}) < -extent - kRound;
  }

  bool holds(const Point& p, const Point& normal) const {
    if (p == point[0] || p == point[1] || p == point[2]) return false;
    const auto height = [&](const Point& from, const Point& to) {
      return normal.dot((to - from).cross(p - from));
    };
    return height(point[0], point[1]) > 0 && height(point[1], point[2]) > 0 &&
           height(point[2], point[0]) >= 0;
  }
};

/// Nodes of a tree that are still to be visited.
struct CornerTree::Search {
  const Tree& tree;
  std::array<Index, 64> pending = {0};  // a tree is as deep as the number of sites has bits
  std::size_t count = 1;
  std::uint64_t steps = 0;  // boxes and corners tested so far
};

CornerTree::CornerTree(std::span<const Point> positions, const Point& normal,
                       std::span<const std::size_t> corners)
    : positions_(positions), normal_(normal), across_(normal.unitOrthogonal()), up_(normal.cross(across_)) {
  std::vector<std::size_t> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t i, std::size_t k) {
    const Point &p = positions[i], &q = positions[k];
    return p == q ? i < k : std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  std::vector<std::size_t> first(positions.size(),
                                 positions.size());  // per corner: the first one at its place
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool is_same = i > 0 && positions[sorted[i]] == positions[sorted[i - 1]];
    first[sorted[i]] = is_same ? first[sorted[i - 1]] : sorted[i];
  }
  site_of_.assign(positions.size(), kNone);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (first[i] == positions.size()) continue;
    if (first[i] == i) {
      site_of_[i] = static_cast<Index>(sites_.size());
      const Plane place(across_.dot(positions[i]), up_.dot(positions[i]));
      sites_.push_back({place, static_cast<Index>(i), 0, {}});
    }
    site_of_[i] = site_of_[first[i]];
    ++sites_[site_of_[i]].count;
  }
  build();
}

/// Makes the trees of the sites that have corners left.
void CornerTree::build() {
  left_ = 0;
  for (std::size_t k = 0; k < trees_.size(); ++k) {
    Tree& tree = trees_[k];
    tree.order.clear();
    for (Index s = 0; s < sites_.size(); ++s)
      if (sites_[s].count > 0) tree.order.push_back(s);
    left_ = tree.order.size();
    tree.nodes.clear();
    if (left_ > 0) build_node(k, kNone, 0, static_cast<Index>(left_));
  }
}

void CornerTree::build_node(std::size_t tree, Index parent, Index first, Index last) {
  auto& [order, nodes] = trees_[tree];
  const auto self = static_cast<Index>(nodes.size());
  Node& node = nodes.emplace_back();
  node.parent = parent;
  node.first = first;
  node.last = last;
  node.count = last - first;
  fit_box(node, std::span(order).subspan(first, last - first));
  if (last - first <= kLeaf) {
    for (Index i = first; i < last; ++i) sites_[order[i]].leaf[tree] = self;
    return;
  }
  const Index middle = first + (last - first) / 2;
  if (tree == 0) {
    const Plane axis = node.axis;
    const auto less = [&](Index i, Index k) { return axis.dot(sites_[i].place) < axis.dot(sites_[k].place); };
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, less);
  }
  build_node(tree, self, first, middle);
  nodes[self].right = static_cast<Index>(nodes.size());
  build_node(tree, self, middle, last);
}

/// Turns the box so that its first axis is the one along which the sites spread most.
void CornerTree::fit_box(Node& node, std::span<const Index> sites) const {
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
  for (std::size_t k = 0; k < trees_.size(); ++k)
    for (Index n = site.leaf[k]; n != kNone; n = trees_[k].nodes[n].parent) --trees_[k].nodes[n].count;
  --left_;
  if (2 * left_ < trees_[0].order.size() && trees_[0].order.size() > 8 * std::size_t{kLeaf})
    build();  // tighter boxes
}

bool CornerTree::any_in(std::size_t a, std::size_t b, std::size_t c, std::uint64_t& tests) {
  if (left_ == 0) return false;
  const auto in_plane = [&](std::size_t i) {
    return Plane(across_.dot(positions_[i]), up_.dot(positions_[i]));
  };
  const Triangle2 triangle{{positions_[a], positions_[b], positions_[c]},
                           {in_plane(a), in_plane(b), in_plane(c)}};
  std::array<Search, 2> searches = {Search{trees_[better_]}, Search{trees_[1 - better_]}};
  std::uint64_t steps = kFirstSteps;
  Outcome outcome = advance(searches[0], triangle, steps);
  while (outcome == Outcome::unfinished) {
    outcome = advance(searches[1], triangle, steps);
    if (outcome != Outcome::unfinished)
      better_ = 1 - better_;
    else
      outcome = advance(searches[0], triangle, steps *= 2);
  }
  tests += searches[0].steps + searches[1].steps;
  return outcome == Outcome::found;
}

/// Continues the search until it has made `steps` steps in total.
CornerTree::Outcome CornerTree::advance(Search& search, const Triangle2& triangle,
                                        std::uint64_t steps) const {
  const auto& [order, nodes] = search.tree;
  while (search.count > 0) {
    if (search.steps >= steps) return Outcome::unfinished;
    const Index n = search.pending[--search.count];
    const Node& node = nodes[n];
    if (node.count == 0) continue;
    ++search.steps;
    if (triangle.is_apart(node)) continue;
    if (node.right != kNone) {
      search.pending[search.count++] = node.right;
      search.pending[search.count++] = n + 1;
      continue;
    }
    for (Index i = node.first; i < node.last; ++i) {
      const Site& site = sites_[order[i]];
      if (site.count == 0) continue;
      ++search.steps;
      if (triangle.holds(positions_[site.corner], normal_)) return Outcome::found;
    }
  }
  return Outcome::nothing;
}

}  // namespace morsel::core
