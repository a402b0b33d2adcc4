#include "morsel/core/mesh/neighbors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <string>

#include "morsel/core/error.h"

namespace morsel::core {
namespace detail {

/// The points as nanoflann's data set, scaled by a power of two so that squares stay in range. Such a
/// scaling changes no digit (unless the points span 300 orders of magnitude), so distances compare as the
/// unscaled ones would.
struct Cloud {
  std::vector<Point> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, Index>;

}  // namespace detail
namespace {

using detail::Cloud;

/// Takes what nanoflann finds within a slightly wider radius (its own test is strict, and on squared
/// distances) and keeps what is within the true one.
class Sphere {
 public:
  Sphere(const Cloud& cloud, const Point& center, double radius, std::vector<Index>& found)
      : cloud_(cloud),
        center_(center),
        radius_(radius),
        // The smallest normal number keeps a radius of 0 from excluding the center itself.
        worst_(radius * radius * (1 + 1e-9) + std::numeric_limits<double>::min()),
        found_(found) {}

  bool addPoint(double /*squared*/, Index i) {
    if ((cloud_.points[i] - center_).norm() <= radius_) found_.push_back(i);
    return true;
  }
  double worstDist() const { return worst_; }
  bool full() const { return true; }
  std::size_t size() const { return found_.size(); }

 private:
  const Cloud& cloud_;
  const Point& center_;
  double radius_;
  double worst_;
  std::vector<Index>& found_;
};

/// Keeps the smallest distances, a given number of them.
class Nearest {
 public:
  Nearest(const Cloud& cloud, const Point& center, std::size_t count)
      : cloud_(cloud), center_(center), count_(count) {}

  bool addPoint(double /*squared*/, Index i) {
    const double distance = (cloud_.points[i] - center_).norm();
    if (full() && distance >= distances_.front()) return true;
    if (full()) {
      std::pop_heap(distances_.begin(), distances_.end());
      distances_.pop_back();
    }
    distances_.push_back(distance);
    std::push_heap(distances_.begin(), distances_.end());
    return true;
  }
  double worstDist() const {
    // A little more, as in Sphere.
    return full() ? distances_.front() * distances_.front() * (1 + 1e-9) + std::numeric_limits<double>::min()
                  : std::numeric_limits<double>::infinity();
  }
  bool full() const { return distances_.size() == count_; }
  std::size_t size() const { return distances_.size(); }
  double largest() const { return distances_.front(); }

 private:
  const Cloud& cloud_;
  const Point& center_;
  std::size_t count_;
  std::vector<double> distances_;  // a heap, the largest first
};

Cloud scaled(std::span<const Point> points, int exponent) {
  Cloud cloud;
  cloud.points.assign(points.begin(), points.end());
  const double factor = std::ldexp(1.0, -exponent);
  for (Point& p : cloud.points) p *= factor;
  return cloud;
}

/// The power of two that the largest coordinate has, or nearly so where its inverse would not be a number.
int exponent_of(std::span<const Point> points) {
  if (points.size() >= kNone)
    throw InvalidArgument("a point search takes fewer than " + std::to_string(kNone) + " points, not " +
                          std::to_string(points.size()));
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw InvalidArgument("point " + std::to_string(i) + " of a point search is not finite");
    largest = std::max(largest, points[i].cwiseAbs().maxCoeff());
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::clamp(exponent, -1000, 1000);
}

}  // namespace

struct PointSearch::Tree {
  explicit Tree(std::span<const Point> points)
      : exponent(exponent_of(points)), cloud(scaled(points, exponent)), index(3, cloud) {}

  int exponent;
  detail::Cloud cloud;
  detail::KdTree index;
};

PointSearch::PointSearch(std::span<const Point> points) : tree_(std::make_shared<const Tree>(points)) {}

void PointSearch::within(const Point& center, double radius, std::vector<Index>& found) const {
  found.clear();
  if (!(radius >= 0) || tree_->cloud.points.empty()) return;
  const double factor = std::ldexp(1.0, -tree_->exponent);
  const Point scaled_center = center * factor;
  Sphere sphere(tree_->cloud, scaled_center, radius * factor, found);
  tree_->index.findNeighbors(sphere, scaled_center.data(), nanoflann::SearchParams());
  std::sort(found.begin(), found.end());
}

double PointSearch::reach(const Point& center, std::size_t count) const {
  if (count == 0) throw InvalidArgument("there is no zeroth nearest point");
  if (tree_->cloud.points.size() < count) return std::numeric_limits<double>::infinity();
  const double factor = std::ldexp(1.0, -tree_->exponent);
  const Point scaled_center = center * factor;
  Nearest nearest(tree_->cloud, scaled_center, count);
  tree_->index.findNeighbors(nearest, scaled_center.data(), nanoflann::SearchParams());
  return std::ldexp(nearest.largest(), tree_->exponent);
}

}  // namespace morsel::core
