#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/molecule/solid.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;

constexpr double kTurn = 2 * std::numbers::pi;

/// A point counts as inside a ball if it is by more than this share of Å: points on several spheres are on
/// all of them.
constexpr double kTolerance = 1e-9;

/// Neighbours of all balls together, 4 bytes each: this number, or so many for each ball. In proteins an atom
/// has about 60 that a probe of 1.4 Å can touch together with it.
constexpr std::size_t kMostNeighbors = std::size_t{1} << 26;
constexpr std::size_t kMostOfEach = 256;

/// Once a circle has so many covered intervals, and then twice as many, and so on, it may be covered already:
/// where atoms are dense, a few of the nearest ones do it.
constexpr std::size_t kFirstLook = 8;

/// A piece of the circle where two spheres meet that lies in no ball.
struct Arc {
  Point center;
  Point x, y, axis;  // orthonormal; angles go from x to y
  double radius;
  double first, last;  // angles, 0 ≤ first < last ≤ 2π
  Point ends[2];

  /// Of `place` to the nearest point of the arc.
  double distance(const Point& place) const {
    const Point w = place - center;
    const double u = w.dot(x), v = w.dot(y);
    double angle = std::atan2(v, u);
    if (angle < 0) angle += kTurn;
    if (angle >= first && angle <= last) return std::hypot(w.dot(axis), std::hypot(u, v) - radius);
    return std::sqrt(std::min((place - ends[0]).squaredNorm(), (place - ends[1]).squaredNorm()));
  }
};

/// Angles of a circle, as pairs of a first and a last one.
using Intervals = std::vector<std::pair<double, double>>;

/// The free parts of [0, 2π] between the covered ones, which are sorted.
Intervals complement(const Intervals& covered) {
  Intervals free;
  double end = 0;
  for (const auto& [first, last] : covered) {
    if (first > end) free.emplace_back(end, first);
    end = std::max(end, last);
  }
  if (end < kTurn) free.emplace_back(end, kTurn);
  return free;
}

/// The surface that the probe's center may reach consists of parts of the spheres with the probe's radius
/// added, which meet in arcs, which meet in points. From inside, its nearest point is the radial projection
/// on the sphere whose surface is nearest outwards, if no other ball covers that point; else it is on an arc
/// or at an end of one.
class ExcludedSolid final : public Solid {
 public:
  ExcludedSolid(std::vector<Ball> balls, double probe, double depth)
      : balls_(std::move(balls)), probe_(probe), depth_(depth) {
    std::vector<Point> centers;
    centers.reserve(balls_.size());
    for (Ball& ball : balls_) {
      ball.radius += probe;
      largest_ = std::max(largest_, ball.radius);
      centers.push_back(ball.center);
    }
    const core::PointSearch search(centers);
    const std::size_t most = std::max(kMostNeighbors, kMostOfEach * balls_.size());
    std::atomic<std::size_t> found = 0;
    neighbors_.resize(balls_.size());
    arcs_.resize(balls_.size());
    core::parallel_for(0, balls_.size(), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        core::throw_if_stopped();
        find_neighbors(static_cast<Index>(i), search);
        if (found += neighbors_[i].size(); found > most) refuse(most);
      }
    });
    core::parallel_for(0, balls_.size(), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        sort_neighbors(static_cast<Index>(i));
        for (const Index j : neighbors_[i]) {
          core::throw_if_stopped();
          if (j > i) find_arcs(static_cast<Index>(i), j);
        }
      }
    });
  }

  double reach() const override { return largest_; }
  double influence() const override { return largest_ + probe_ + depth_; }

  void evaluate(std::span<const Point> places, std::span<const Index> balls,
                std::span<double> values) const override {
    for (std::size_t k = 0; k < places.size(); ++k) {
      core::throw_if_stopped();
      values[k] = probe_ - distance_to_accessible(places[k], balls, probe_ + depth_);
    }
  }

 private:
  [[noreturn]] void refuse(std::size_t most) const {
    throw core::BadInput(
        "a probe of " + core::shortest(probe_) + " Å can touch more than " + std::to_string(most / 2) +
        " pairs of these " + std::to_string(balls_.size()) +
        " atoms, too many for a solvent-excluded surface; a smaller probe or the kind gaussian would do, "
        "unless the atoms lie one in another");
  }

  void find_neighbors(Index i, const core::PointSearch& search) {
    std::vector<Index>& found = neighbors_[i];
    search.within(balls_[i].center, balls_[i].radius + largest_, found);
    std::erase_if(found, [&](Index j) {
      return j == i ||
             square(i, j) >= (balls_[i].radius + balls_[j].radius) * (balls_[i].radius + balls_[j].radius);
    });
  }

  /// The nearest first: these are the likeliest to cover what the ball does.
  void sort_neighbors(Index i) {
    std::ranges::stable_sort(neighbors_[i], {}, [&](Index j) { return square(i, j); });
  }

  double square(Index i, Index j) const { return (balls_[i].center - balls_[j].center).squaredNorm(); }

  void find_arcs(Index i, Index j) {
    const Ball& a = balls_[i];
    const Ball& b = balls_[j];
    Arc arc;
    const double distance = (b.center - a.center).norm();
    if (!(distance > kTolerance)) return;  // no circle, or one and the same sphere
    arc.axis = (b.center - a.center) / distance;
    const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
    const double square_radius = a.radius * a.radius - along * along;
    if (!(square_radius > 0)) return;
    arc.radius = std::sqrt(square_radius);
    arc.center = a.center + along * arc.axis;
    int least = 0;
    arc.axis.cwiseAbs().minCoeff(&least);
    arc.x = arc.axis.cross(Point::Unit(least)).normalized();
    arc.y = arc.axis.cross(arc.x);

    Intervals covered;
    std::size_t looked_at = kFirstLook;
    for (const Index k : neighbors_[i]) {
      if (k != j && covers(balls_[k], arc, covered)) return;
      if (covered.size() < looked_at) continue;
      std::sort(covered.begin(), covered.end());
      if (complement(covered).empty()) return;
      looked_at = 2 * covered.size();
    }
    std::sort(covered.begin(), covered.end());
    for (const auto& [first, last] : complement(covered)) {
      arc.first = first;
      arc.last = last;
      for (int end = 0; end < 2; ++end) {
        const double angle = end == 0 ? first : last;
        arc.ends[end] = arc.center + arc.radius * (std::cos(angle) * arc.x + std::sin(angle) * arc.y);
      }
      arcs_[i].push_back(arc);
    }
  }

  /// Adds what the ball covers of the circle; whether that is all of it. A point of the circle at angle t is
  /// inside where u cos t + v sin t < level.
  static bool covers(const Ball& ball, const Arc& circle, Intervals& covered) {
    const Point w = circle.center - ball.center;
    const double u = 2 * circle.radius * w.dot(circle.x);
    const double v = 2 * circle.radius * w.dot(circle.y);
    const double inner = ball.radius - kTolerance;
    const double level = inner * inner - w.squaredNorm() - circle.radius * circle.radius;
    const double amplitude = std::hypot(u, v);
    if (level > amplitude) return true;
    if (level <= -amplitude) return false;
    const double half = std::acos(std::clamp(level / amplitude, -1.0, 1.0));
    double first = std::atan2(v, u) + half;
    while (first < 0) first += kTurn;
    while (first >= kTurn) first -= kTurn;
    const double last = first + kTurn - 2 * half;
    covered.emplace_back(first, std::min(last, kTurn));
    if (last > kTurn) covered.emplace_back(0, last - kTurn);
    return false;
  }

  bool is_covered(const Point& point, Index by_neighbor_of) const {
    return std::any_of(neighbors_[by_neighbor_of].begin(), neighbors_[by_neighbor_of].end(), [&](Index j) {
      const double inner = balls_[j].radius - kTolerance;
      return (point - balls_[j].center).squaredNorm() < inner * inner;
    });
  }

  /// 0 outside all balls; `most` where it is more.
  double distance_to_accessible(const Point& place, std::span<const Index> balls, double most) const {
    double deepest = 0;
    Index around = core::kNone;
    for (const Index i : balls) {
      const double square = (place - balls_[i].center).squaredNorm();
      if (square >= balls_[i].radius * balls_[i].radius) continue;
      const double depth = balls_[i].radius - std::sqrt(square);
      if (around != core::kNone && depth <= deepest) continue;
      deepest = depth;
      around = i;
    }
    if (around == core::kNone) return 0;
    if (deepest >= most) return most;  // the distance is at least that out of one ball
    const Point outwards = place - balls_[around].center;
    const double length = outwards.norm();
    if (length > 0 &&
        !is_covered(balls_[around].center + outwards * (balls_[around].radius / length), around))
      return deepest;
    double least = most;
    for (const Index i : balls) {
      if (arcs_[i].empty()) continue;
      if (std::abs((place - balls_[i].center).norm() - balls_[i].radius) >= least) continue;
      for (const Arc& arc : arcs_[i]) least = std::min(least, arc.distance(place));
    }
    return least;
  }

  std::vector<Ball> balls_;  // grown by the probe
  double probe_;
  double depth_;
  double largest_ = 0;
  std::vector<std::vector<Index>> neighbors_;  // per ball: those that overlap it
  std::vector<std::vector<Arc>> arcs_;         // per ball: those with balls of larger numbers
};

}  // namespace

std::unique_ptr<Solid> excluded_solid(std::vector<Ball> balls, double probe, double depth) {
  return std::make_unique<ExcludedSolid>(std::move(balls), probe, depth);
}

}  // namespace morsel::tools
