#include "morsel/morse/smoothing/denoise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/field/link.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/connected_ball.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

/// The balls over which a step averages.
struct Balls {
  double radius;
  bool limited;  ///< to the SurfaceSmoothing::kMostInBall nearest vertices
};

/// Calls visit(v, ball) for every vertex, in parallel.
template <class Visit>
void for_each_ball(const TriangleMesh& mesh, const Balls& sizes, const core::Progress& progress,
                   const Visit& visit) {
  const ConnectedBalls balls(mesh);
  std::optional<core::PointSearch> search;
  if (sizes.limited) search.emplace(mesh.positions());
  core::parallel_for(0, mesh.vertex_count(), balls.grain(), [&](std::size_t first, std::size_t last) {
    ConnectedBalls::Walk walk(balls);
    std::vector<Index> ball;
    for (std::size_t i = first; i < last; ++i) {
      if (i % 64 == 0) progress.throw_if_cancelled();
      const auto v = static_cast<Index>(i);
      const double radius =
          search ? std::min(sizes.radius, search->reach(mesh.position(v), SurfaceSmoothing::kMostInBall))
                 : sizes.radius;
      walk.within(v, radius, ball);
      visit(v, ball);
    }
  });
}

/// Whether balls hold more than that many vertices on average. Stops counting as soon as that is certain.
bool hold_more(const TriangleMesh& mesh, double radius, std::size_t most, const core::Progress& progress) {
  const ConnectedBalls balls(mesh);
  const std::uint64_t limit = std::uint64_t{most} * mesh.vertex_count();
  std::atomic<std::uint64_t> sum = 0;
  core::parallel_for(0, mesh.vertex_count(), balls.grain(), [&](std::size_t first, std::size_t last) {
    ConnectedBalls::Walk walk(balls);
    std::vector<Index> ball;
    for (std::size_t v = first; v < last && sum.load(std::memory_order_relaxed) <= limit; ++v) {
      if (v % 64 == 0) progress.throw_if_cancelled();
      walk.within(static_cast<Index>(v), radius, ball);
      sum.fetch_add(ball.size(), std::memory_order_relaxed);
    }
  });
  return sum > limit;
}

/// The median over the vertices of the standard deviation of n · (x − v) in their balls; of two middle ones
/// the lower.
double typical_deviation(const TriangleMesh& mesh, const Balls& balls, const core::Progress& progress) {
  const std::vector<Point> normals = vertex_normals(mesh);
  std::vector<double> deviation(mesh.vertex_count());
  for_each_ball(mesh, balls, progress, [&](Index v, const std::vector<Index>& ball) {
    const auto height = [&](Index x) { return normals[v].dot(mesh.position(x) - mesh.position(v)); };
    const auto count = static_cast<double>(ball.size());
    double mean = 0;
    for (const Index x : ball) mean += height(x) / count;
    double square = 0;
    for (const Index x : ball) square += (height(x) - mean) * (height(x) - mean) / count;
    deviation[v] = std::sqrt(square);
  });
  const auto middle = deviation.begin() + static_cast<std::ptrdiff_t>((deviation.size() - 1) / 2);
  std::nth_element(deviation.begin(), middle, deviation.end());
  return *middle;
}

}  // namespace

SurfaceSmoothing::SurfaceSmoothing(TriangleMesh mesh, const BilateralDenoising& options,
                                   const core::Progress& progress)
    : surface_(std::move(mesh)) {
  for (const auto& [name, length] : {std::pair("sigma-c", options.sigma_c), {"sigma-s", options.sigma_s}})
    if (length && !is_positive(length->value))
      throw core::InvalidArgument(std::string(name) + " must be finite and above 0, not " +
                                  core::to_string(*length));
  const UnitSized unit = unit_sized(surface_);
  const double edge = core::mean_edge_length(unit.mesh);
  const double scaled_sigma_c =
      options.sigma_c ? std::ldexp(options.sigma_c->on(surface_), -unit.exponent) : edge;
  if (!(scaled_sigma_c > 0))
    throw core::BadInput("sigma-c comes to 0 on this mesh, whose vertices all coincide");
  limits_balls_ = !options.sigma_c && hold_more(unit.mesh, 2 * scaled_sigma_c, kMostInBall, progress);
  const double scaled_sigma_s =
      options.sigma_s ? std::ldexp(options.sigma_s->on(surface_), -unit.exponent)
                      : typical_deviation(unit.mesh, {2 * scaled_sigma_c, limits_balls_}, progress);
  sigma_c_ = std::ldexp(scaled_sigma_c, unit.exponent);
  sigma_s_ = std::ldexp(scaled_sigma_s, unit.exponent);
}

SurfaceSmoothing::SurfaceSmoothing(TriangleMesh mesh, const LaplacianDenoising& options)
    : surface_(std::move(mesh)), laplacian_(options) {
  if (!(options.lambda > 0 && options.lambda <= 1))
    throw core::InvalidArgument("lambda must be above 0 and at most 1, not " +
                                core::shortest(options.lambda));
}

void SurfaceSmoothing::step(const core::Progress& progress) {
  surface_ = surface_.with_positions(laplacian_ ? laplacian_positions() : bilateral_positions(progress));
}

std::vector<Point> SurfaceSmoothing::bilateral_positions(const core::Progress& progress) const {
  std::vector<Point> positions(surface_.positions().begin(), surface_.positions().end());
  if (sigma_s_ == 0) return positions;
  const UnitSized unit = unit_sized(surface_);
  const std::vector<Point> normals = vertex_normals(unit.mesh);
  for_each_ball(surface_, {2 * sigma_c_, limits_balls_}, progress,
                [&](Index v, const std::vector<Index>& ball) {
                  const Point& n = normals[v];
                  const Point& p = surface_.position(v);
                  double sum = 0;
                  double total = 0;
                  for (const Index x : ball) {
                    const Point d = surface_.position(x) - p;
                    const double h = n.dot(d / sigma_s_);
                    const double weight = std::exp(-((d / sigma_c_).squaredNorm() + h * h) / 2);
                    sum += weight * h;
                    total += weight;
                  }
                  positions[v] = p + n * (sum / total * sigma_s_);  // v itself counts 1
                });
  return positions;
}

std::vector<Point> SurfaceSmoothing::laplacian_positions() const {
  const UnitSized unit = unit_sized(surface_);
  const std::vector<double> weight = edge_weights(unit.mesh, laplacian_->weights);
  std::vector<Point> positions(surface_.positions().begin(), surface_.positions().end());
  core::parallel_for_each(positions.size(), [&](std::size_t i) {
    const auto v = static_cast<Index>(i);
    if (surface_.is_boundary_vertex(v)) return;
    const Point& p = surface_.position(v);
    Point sum = Point::Zero();
    double total = 0;
    surface_.for_each_outgoing(v, [&](Index h) {
      const double w = weight[surface_.edge(h)];
      sum += w * (surface_.position(surface_.target(h)) - p);
      total += w;
    });
    if (total > 0) positions[i] = p + laplacian_->lambda * (sum / total);
  });
  return positions;
}

}  // namespace morsel::morse
