#include "morsel/tools/render/best_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/saliency.h"

namespace morsel::tools::render {
namespace {

using core::Index;
using core::Point;

constexpr std::size_t kLookedAt = 5000;
constexpr double kLowest = -10;  // degrees: views are mostly from above
constexpr double kHighest = 50;

struct Seen {
  Vec3 point;
  Vec3 normal;
  double weight;
};

struct Angles {
  double azimuth;
  double elevation;
};

double shown(const std::vector<Seen>& seen, const Rays& rays, const Point& toward) {
  const Vec3 direction = toward.cast<float>();
  double sum = 0;
  for (const Seen& s : seen) {
    const float cosine = s.normal.dot(direction);
    if (cosine > 0 && !rays.any(s.point + 1e-4f * s.normal, direction, 1e-4f, kFar))
      sum += s.weight * double{cosine};
  }
  return sum;
}

}  // namespace

View best_view(const Body& body, const Rays& rays, std::span<const double> weights, UpAxis up,
               const core::Progress& progress) {
  const core::TriangleMesh& mesh = body.mesh;
  if (weights.size() != mesh.vertex_count())
    throw core::InvalidArgument("a view needs a weight for each vertex");
  std::vector<double> area(mesh.vertex_count(), 0);
  for (const core::Triangle& t : mesh.triangles()) {
    const Point& a = mesh.position(t[0]);
    const double part = (mesh.position(t[1]) - a).cross(mesh.position(t[2]) - a).norm() / 6;
    for (const Index v : t) area[v] += part;
  }
  const std::size_t stride = (mesh.vertex_count() + kLookedAt - 1) / kLookedAt;
  std::vector<Seen> seen;
  for (std::size_t v = 0; v < mesh.vertex_count(); v += stride)
    seen.push_back({mesh.position(static_cast<Index>(v)).cast<float>(), body.normals[v].cast<float>(),
                    weights[v] * area[v]});

  const auto best_of = [&](const std::vector<Angles>& candidates) {
    std::vector<double> score(candidates.size());
    core::parallel_for(0, candidates.size(), 1, [&](std::size_t i, std::size_t) {
      score[i] = shown(seen, rays, view_at(candidates[i].azimuth, candidates[i].elevation, up).toward);
    });
    return candidates[static_cast<std::size_t>(std::max_element(score.begin(), score.end()) - score.begin())];
  };

  progress.update("best view", 0);
  std::vector<Angles> candidates;
  constexpr int kCandidates = 300;
  const double low = std::sin(kLowest * std::numbers::pi / 180);
  const double high = std::sin(kHighest * std::numbers::pi / 180);
  for (int i = 0; i < kCandidates; ++i) {  // a Fibonacci spiral
    const double rise = low + (high - low) * (i + 0.5) / kCandidates;
    candidates.push_back(
        {std::remainder(i * 360 * (std::numbers::phi - 1), 360), std::asin(rise) * 180 / std::numbers::pi});
  }
  Angles best = best_of(candidates);
  for (double step = 6; step > 0.4; step /= 2) {
    progress.update("best view", 0.7);
    candidates.assign(1, best);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const double elevation = std::clamp(best.elevation + j * step, kLowest, kHighest);
        candidates.push_back(
            {best.azimuth + i * step / std::cos(elevation * std::numbers::pi / 180), elevation});
      }
    best = best_of(candidates);
  }
  return view_at(best.azimuth, best.elevation, up);
}

std::vector<double> view_weights(const Body& body, const core::Progress& progress) {
  const core::ScalarField field =
      morse::saliency(morse::mean_curvature(body.mesh, progress), {}, progress).field;
  if (!(field.max() > 0)) return std::vector<double>(field.values().size(), 1);
  return {field.values().begin(), field.values().end()};
}

}  // namespace morsel::tools::render
