/// Denoising as a method that is chosen by name.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <variant>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/morse/smoothing/denoise.h"
#include "morsel/morse/smoothing/iteration.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

/// How far the vertices of a surface are from where they were.
struct Displacement {
  double largest = 0;
  double sum = 0;
};

Displacement displacement(const TriangleMesh& before, const TriangleMesh& after) {
  return core::parallel_reduce(
      0, before.vertex_count(), core::kGrain, Displacement(),
      [&](std::size_t first, std::size_t last) {
        Displacement part;
        for (std::size_t i = first; i < last; ++i) {
          const auto v = static_cast<Index>(i);
          const double distance = (after.position(v) - before.position(v)).stableNorm();
          part.largest = std::max(part.largest, distance);
          part.sum += distance;
        }
        return part;
      },
      [](const Displacement& a, const Displacement& b) {
        return Displacement{std::max(a.largest, b.largest), a.sum + b.sum};
      });
}

/// Six times the volume that a closed surface encloses.
double volume(const TriangleMesh& mesh) {
  const Point origin = mesh.position(0);
  return core::parallel_reduce(
      0, mesh.triangle_count(), core::kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) {
          const core::Triangle& t = mesh.triangle(static_cast<Index>(i));
          part += (mesh.position(t[0]) - origin)
                      .dot((mesh.position(t[1]) - origin).cross(mesh.position(t[2]) - origin));
        }
        return part;
      },
      [](double a, double b) { return a + b; });
}

class Denoise final : public core::Method {
 public:
  using Kind = std::variant<BilateralDenoising, LaplacianDenoising>;
  Denoise(const Kind& kind, const StopCriteria& criteria) : kind_(kind), criteria_(criteria) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    if (!context.morse_function)
      throw core::InvalidArgument(
          "denoise evaluates the Morse function on the smoothed surface, but this field has none");
    IterationControl control(input, criteria_, context);
    const TriangleMesh& mesh = input.mesh();
    SurfaceSmoothing smoothing =
        std::holds_alternative<BilateralDenoising>(kind_)
            ? SurfaceSmoothing(mesh, std::get<BilateralDenoising>(kind_), context.progress)
            : SurfaceSmoothing(mesh, std::get<LaplacianDenoising>(kind_));
    int iteration = 0;
    while (control.more()) {
      context.progress.update("denoising", static_cast<double>(iteration) / criteria_.iterations);
      ++iteration;
      try {
        smoothing.step(context.progress.unreported());
        if (!control.needs_field()) {
          control.skip();
          continue;
        }
        const core::ScalarField field = context.morse_function(smoothing.surface());
        control.record({field.values().begin(), field.values().end()});
      } catch (const core::BadInput& error) {
        throw core::BadInput("on the surface after " + std::to_string(iteration) +
                             " iterations of denoising: " + error.what());
      }
    }
    context.progress.update("denoising", 1);
    core::Parameters told = details(input, control.field(), smoothing.surface());
    if (smoothing.limits_balls())
      told.emplace_back("most_in_ball", static_cast<std::int64_t>(SurfaceSmoothing::kMostInBall));
    return control.result(parameters(smoothing), std::move(told));
  }

  core::MethodTraits traits() const override {
    return {.reevaluates_function = true, .iterates = true, .iterates_are_results = true};
  }

 private:
  core::Parameters parameters(const SurfaceSmoothing& smoothing) const {
    if (const auto* laplacian = std::get_if<LaplacianDenoising>(&kind_))
      return {{"kind", "laplacian"},
              {"lambda", laplacian->lambda},
              {"weights", std::string(to_string(laplacian->weights))}};
    return {{"kind", "bilateral"}, {"sigma_c", smoothing.sigma_c()}, {"sigma_s", smoothing.sigma_s()}};
  }

  static core::Parameters details(const core::ScalarField& input, const core::ScalarField& output,
                                  const TriangleMesh& surface) {
    const TriangleMesh& mesh = input.mesh();
    const Displacement moved = displacement(mesh, surface);
    core::Parameters details = {{"largest_displacement", moved.largest},
                                {"mean_displacement", moved.sum / static_cast<double>(mesh.vertex_count())}};
    if (mesh.is_closed()) {
      const UnitSized unit = unit_sized(mesh);
      std::vector<Point> positions(mesh.vertex_count());
      for (std::size_t v = 0; v < positions.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
          positions[v][axis] = std::ldexp(surface.position(static_cast<Index>(v))[axis], -unit.exponent);
      const double before = volume(unit.mesh);
      const double after = volume(mesh.with_positions(std::move(positions)));
      if (std::abs(before) > 0) details.emplace_back("volume_change", (after - before) / before);
    }
    if (moved.largest > 0 &&
        std::equal(input.values().begin(), input.values().end(), output.values().begin()))
      details.emplace_back("unchanged_because",
                           "the Morse function does not depend on where the vertices lie");
    return details;
  }

  Kind kind_;
  StopCriteria criteria_;
};

/// A length, or none for the word that is the default.
std::optional<core::Length> read_length(core::ParameterReader& reader, const char* key, const char* word,
                                        const char* description) {
  const std::string text = reader.text(key, word, description);
  if (text == word) return std::nullopt;
  const std::string what = reader.owner() + ":" + key;
  const core::Length length = core::parse_length(text, what);
  if (!(length.value > 0)) throw core::InvalidArgument(what + " must be above 0, not " + text);
  return length;
}

}  // namespace

std::unique_ptr<core::Method> make_denoise(core::ParameterReader& reader) {
  const StopCriteria criteria = read_stop_criteria(reader, 5);
  const bool bilateral =
      reader.choice("kind", "bilateral", {"bilateral", "laplacian"},
                    "bilateral keeps edges (Fleishman et al. 2003), laplacian shrinks") == "bilateral";
  BilateralDenoising first;
  first.sigma_c = read_length(reader, "sigma-c", "edge",
                              "bilateral: standard deviation of the weight of distances, a length or the "
                              "mean edge's");
  first.sigma_s = read_length(reader, "sigma-s", "auto",
                              "bilateral: standard deviation of the weight of heights, a length or as in "
                              "the median neighbourhood");
  LaplacianDenoising second;
  second.lambda = reader.number("lambda", second.lambda, {0, true, 1},
                                "laplacian: how far vertices go to the mean of their neighbours");
  const std::string weights =
      reader.choice("weights", "uniform", {"uniform", "clamped", "cotangent"},
                    "laplacian: of the neighbours; clamped are cotangents kept above 0");
  if (weights != "uniform")
    second.weights = weights == "clamped" ? EdgeWeights::clamped : EdgeWeights::cotangent;
  for (const char* key : {"sigma-c", "sigma-s"})
    if (!bilateral && reader.given(key))
      throw core::InvalidArgument(reader.owner() + ":" + key + " is for kind=bilateral");
  for (const char* key : {"lambda", "weights"})
    if (bilateral && reader.given(key))
      throw core::InvalidArgument(reader.owner() + ":" + key + " is for kind=laplacian");
  return std::make_unique<Denoise>(bilateral ? Denoise::Kind(first) : Denoise::Kind(second), criteria);
}

}  // namespace morsel::morse
