#include "morsel/morse/functions/curvature_functions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/diffused_curvature.h"
#include "morsel/morse/functions/discrete_curvature.h"
#include "morsel/morse/functions/quadric_curvature.h"
#include "morsel/morse/operators/low_pass.h"
#include "morsel/morse/operators/normals.h"

namespace morsel::morse {
namespace {

using core::ScalarField;
using core::TriangleMesh;

/// A function of the two principal curvatures of a vertex.
using Combination = std::vector<double> (*)(const PrincipalCurvatures&);
/// A curvature that is computed directly, not from the principal ones.
using Direct = ScalarField (*)(const TriangleMesh&, const core::Progress&);

template <class Term>
std::vector<double> combine(const PrincipalCurvatures& k, const Term& term) {
  std::vector<double> values(k.k1.size());
  core::parallel_for_each(values.size(), [&](std::size_t v) { values[v] = term(k.k1[v], k.k2[v]); });
  return values;
}

std::vector<double> largest(const PrincipalCurvatures& k) { return k.k1; }
std::vector<double> least(const PrincipalCurvatures& k) { return k.k2; }
std::vector<double> mean(const PrincipalCurvatures& k) {
  return combine(k, [](double k1, double k2) { return (k1 + k2) / 2; });
}
std::vector<double> product(const PrincipalCurvatures& k) {
  return combine(k, [](double k1, double k2) { return k1 * k2; });
}

/// Of the angle defect.
std::vector<std::string> rim_warnings(const TriangleMesh& mesh) {
  std::size_t rim = 0;
  for (core::Index v = 0; v < mesh.vertex_count(); ++v) rim += mesh.is_boundary_vertex(v) ? 1 : 0;
  if (rim == 0) return {};
  return {
      "at " + std::to_string(rim) +
      " boundary vertices the angle defect is the turning of the boundary over an area, not a curvature of "
      "the surface; estimator=quadric measures that"};
}

enum class Way : std::uint8_t { one_ring, quadric, diffused, spread };

/// From one-rings (directly or by Taubin's tensor), from fitted quadrics or diffused.
class Curvature final : public core::MorseFunction {
 public:
  /// Without `direct`, one-rings are Taubin's. `reach`: the quadrics' radius, or the scale of diffusion, or
  /// the spread, with which `fairing` goes.
  Curvature(Combination combination, Direct direct, Way way, core::Length scale, core::Length reach,
            core::Length fairing, core::Parameters parameters)
      : combination_(combination),
        direct_(direct),
        way_(way),
        scale_(scale),
        reach_(reach),
        fairing_(fairing),
        parameters_(std::move(parameters)) {}

  core::FunctionResult evaluate(const TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters parameters = parameters_;
    if (!(scale_.value > 0)) {
      ScalarField field = on_surface(mesh, mesh, context, parameters);
      return {std::move(field), std::move(parameters), warnings(mesh)};
    }
    parameters.emplace_back("scale", scale_.on(mesh));
    const TriangleMesh smoothed = low_pass(mesh, scale_, context.progress);
    const ScalarField field = on_surface(smoothed, mesh, context, parameters);
    return {{mesh, {field.values().begin(), field.values().end()}}, std::move(parameters), warnings(mesh)};
  }

 private:
  std::vector<std::string> warnings(const TriangleMesh& mesh) const {
    if (direct_ == gaussian_curvature && way_ == Way::one_ring) return rim_warnings(mesh);
    if (combination_ == product || combination_ == curvedness) return {};  // the same from either side
    return orientation_warnings(mesh);
  }

  /// Of `surface`; a length in other units is that on `mesh`. Adds to the parameters.
  ScalarField on_surface(const TriangleMesh& surface, const TriangleMesh& mesh,
                         const core::FunctionContext& context, core::Parameters& parameters) const {
    switch (way_) {
      case Way::quadric: {
        const double radius = reach_on(mesh, "radius");
        const QuadricCurvatures fitted = quadric_curvatures(surface, radius, context.progress);
        parameters.emplace_back("radius", radius);
        parameters.emplace_back("widened_vertices", static_cast<std::int64_t>(fitted.widened));
        parameters.emplace_back("unfitted_vertices", static_cast<std::int64_t>(fitted.unfitted));
        return {surface, combination_(fitted.curvatures)};
      }
      case Way::diffused: {
        const double diffusion = reach_on(mesh, "diffusion");
        parameters.emplace_back("diffusion", diffusion);
        return diffused_mean_curvature(surface, diffusion, context.progress);
      }
      case Way::spread: {
        const double spread = reach_on(mesh, "spread");
        const double fairing = fairing_.on(mesh);
        check_extent(mesh, "fairing", fairing_, fairing);
        parameters.emplace_back("fairing", fairing);
        parameters.emplace_back("spread", spread);
        return diffused_gaussian_curvature(surface, fairing, spread, context.progress);
      }
      case Way::one_ring:
        break;
    }
    if (direct_ != nullptr) return direct_(surface, context.progress);
    return {surface, combination_(principal_curvatures(surface, context.progress))};
  }

  double reach_on(const TriangleMesh& mesh, const char* key) const {
    const double reach = reach_.on(mesh);
    if (!(reach > 0))
      throw core::BadInput(comes_to(key, reach_, reach) + " on this mesh, whose vertices all coincide");
    if (way_ == Way::diffused || way_ == Way::spread) check_extent(mesh, key, reach_, reach);
    return reach;
  }

  /// Throws if a length is more than the surface is wide.
  static void check_extent(const TriangleMesh& mesh, const char* key, const core::Length& given,
                           double length) {
    const double diagonal = mesh.bounding_box().diagonal();
    if (length > diagonal)
      throw core::BadInput(comes_to(key, given, length) + " on this mesh, more than the diagonal of its " +
                           "bounding box, " + core::shortest(diagonal) + ": nothing would be left of it");
  }

  static std::string comes_to(const char* key, const core::Length& given, double length) {
    return key + (" = " + core::to_string(given)) + " comes to " + core::shortest(length);
  }

  Combination combination_;
  Direct direct_;
  Way way_;
  core::Length scale_;
  core::Length reach_;
  core::Length fairing_;
  core::Parameters parameters_;
};

/// The default, which smooths away noise that would falsify a diffused curvature's Laplacian.
constexpr core::Length kScaleOfDiffused = core::Length::edges(0.6);

struct Estimator {
  std::string_view name;
  Direct direct;
  Way way = Way::one_ring;
};

constexpr Estimator kQuadric = {"quadric", nullptr, Way::quadric};

/// The first estimator is the default.
std::unique_ptr<core::MorseFunction> make(core::ParameterReader& reader, Combination combination,
                                          const std::vector<Estimator>& estimators,
                                          core::Parameters parameters = {}) {
  std::vector<std::string_view> names;
  bool can_diffuse = false;
  bool can_spread = false;
  for (const Estimator& estimator : estimators) {
    names.push_back(estimator.name);
    if (estimator.way == Way::diffused) can_diffuse = true;
    if (estimator.way == Way::spread) can_spread = true;
  }
  std::string about = "how it is measured; quadric: fitted within a radius, for noisy surfaces";
  if (can_diffuse)
    about += "; diffused: along the surface, for surfaces that are noisy or sampled otherwise, with scale=" +
             core::to_string(kScaleOfDiffused) + " unless given";
  if (can_spread)
    about +=
        "; diffused: of the surface faired, then spread along it, highest at tips that people would mark";
  const std::string chosen = reader.choice("estimator", names.front(), names, about);
  const Estimator& estimator =
      *std::ranges::find_if(estimators, [&](const Estimator& e) { return e.name == chosen; });
  const core::Length scale =
      read_scale(reader, estimator.way == Way::diffused ? kScaleOfDiffused : core::Length::absolute(0));
  core::Length reach;
  const auto read_reach = [&](Way way, const char* key, core::Length default_length, const char* what) {
    const core::Length length = reader.length(key, default_length, core::kPositive, what);
    const std::string_view owner = std::ranges::find(estimators, way, &Estimator::way)->name;
    if (estimator.way == way)
      reach = length;
    else if (reader.given(key))
      throw core::InvalidArgument(reader.owner() + ":" + key + " is for estimator=" + std::string(owner) +
                                  ", not for estimator=" + chosen);
  };
  read_reach(Way::quadric, "radius", core::Length::root_areas(0.015),
             "how far a fitted quadric reaches, with estimator=quadric");
  if (can_diffuse)
    read_reach(Way::diffused, "diffusion", core::Length::root_areas(0.036),
               "with estimator=diffused: waves of 2 pi times this keep nearly half their height");
  core::Length fairing;
  if (can_spread) {
    read_reach(Way::spread, "spread", core::Length::percent(20),
               "with estimator=diffused: how far one step of heat spreads the curvature");
    fairing = reader.length("fairing", core::Length::percent(0.8), core::kNonNegative,
                            "with estimator=diffused: waves of 2 pi times this keep half their height first");
    if (estimator.way != Way::spread && reader.given("fairing"))
      throw core::InvalidArgument(reader.owner() +
                                  ":fairing is for estimator=diffused, not for estimator=" + chosen);
  }
  parameters.emplace_back("estimator", chosen);
  return std::make_unique<Curvature>(combination, estimator.direct, estimator.way, scale, reach, fairing,
                                     std::move(parameters));
}

}  // namespace

std::vector<double> curvedness(const PrincipalCurvatures& curvatures) {
  return combine(curvatures, [](double k1, double k2) { return std::hypot(k1, k2) * std::sqrt(0.5); });
}

std::vector<double> shape_index(const PrincipalCurvatures& curvatures) {
  return combine(curvatures,
                 [](double k1, double k2) { return 2 / M_PI * std::atan2(k1 + k2, std::abs(k1 - k2)); });
}

std::unique_ptr<core::MorseFunction> make_mean_curvature(core::ParameterReader& reader) {
  return make(reader, mean,
              {{"taubin", mean_curvature},
               {"cotangent", cotangent_mean_curvature},
               {"diffused", nullptr, Way::diffused},
               kQuadric});
}

std::unique_ptr<core::MorseFunction> make_gaussian_curvature(core::ParameterReader& reader) {
  return make(reader, product,
              {{"defect", gaussian_curvature}, {"diffused", nullptr, Way::spread}, kQuadric});
}

std::unique_ptr<core::MorseFunction> make_principal_curvature(core::ParameterReader& reader) {
  const std::string which =
      reader.choice("which", "max", {"max", "min"}, "the larger or the smaller one, signs counted");
  return make(reader, which == "max" ? largest : least, {kQuadric, {"taubin", nullptr}}, {{"which", which}});
}

std::unique_ptr<core::MorseFunction> make_curvedness(core::ParameterReader& reader) {
  return make(reader, curvedness, {kQuadric, {"taubin", nullptr}});
}

std::unique_ptr<core::MorseFunction> make_shape_index(core::ParameterReader& reader) {
  return make(reader, shape_index, {kQuadric, {"taubin", nullptr}});
}

}  // namespace morsel::morse
