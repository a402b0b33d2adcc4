#include "morsel/morse/functions/curvature_functions.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/length.h"
#include "morsel/core/parallel.h"
#include "morsel/morse/functions/discrete_curvature.h"
#include "morsel/morse/functions/quadric_curvature.h"
#include "morsel/morse/operators/low_pass.h"

namespace morsel::morse {
namespace {

using core::ScalarField;
using core::TriangleMesh;

/// What is made of the two curvatures of a vertex.
using Combination = std::vector<double> (*)(const PrincipalCurvatures&);
/// A curvature that has a way of its own, without the principal ones.
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

/// From fitted quadrics, by Taubin's tensor, or in the curvature's own way.
class Curvature final : public core::MorseFunction {
 public:
  /// Without `direct`, an estimator other than quadric is Taubin's.
  Curvature(Combination combination, Direct direct, core::Length scale, core::Length radius,
            core::Parameters parameters, bool quadric)
      : combination_(combination),
        direct_(direct),
        scale_(scale),
        radius_(radius),
        parameters_(std::move(parameters)),
        quadric_(quadric) {}

  core::FunctionResult evaluate(const TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters parameters = parameters_;
    if (!(scale_.value > 0)) {
      ScalarField field = on_surface(mesh, mesh, context, parameters);
      return {std::move(field), std::move(parameters)};
    }
    parameters.emplace_back("scale", scale_.on(mesh));
    const TriangleMesh smoothed = low_pass(mesh, scale_, context.progress);
    const ScalarField field = on_surface(smoothed, mesh, context, parameters);
    return {{mesh, {field.values().begin(), field.values().end()}}, std::move(parameters)};
  }

 private:
  /// Of `surface`; a radius in other units is that on `mesh`. Adds to the parameters.
  ScalarField on_surface(const TriangleMesh& surface, const TriangleMesh& mesh,
                         const core::FunctionContext& context, core::Parameters& parameters) const {
    if (!quadric_) {
      if (direct_ != nullptr) return direct_(surface, context.progress);
      return {surface, combination_(principal_curvatures(surface, context.progress))};
    }
    const double radius = radius_.on(mesh);
    if (!(radius > 0))
      throw core::BadInput("radius = " + core::to_string(radius_) + " comes to " + core::shortest(radius) +
                           " on this mesh, whose vertices all coincide");
    const QuadricCurvatures fitted = quadric_curvatures(surface, radius, context.progress);
    parameters.emplace_back("radius", radius);
    parameters.emplace_back("widened_vertices", static_cast<std::int64_t>(fitted.widened));
    parameters.emplace_back("unfitted_vertices", static_cast<std::int64_t>(fitted.unfitted));
    return {surface, combination_(fitted.curvatures)};
  }

  Combination combination_;
  Direct direct_;
  core::Length scale_;
  core::Length radius_;
  core::Parameters parameters_;
  bool quadric_;
};

struct Estimator {
  std::string_view name;
  Direct direct;
};

/// The first estimator is the default; quadric is one besides these.
std::unique_ptr<core::MorseFunction> make(core::ParameterReader& reader, Combination combination,
                                          const std::vector<Estimator>& estimators,
                                          core::Parameters parameters = {}) {
  std::vector<std::string_view> names;
  names.reserve(estimators.size() + 1);
  for (const Estimator& estimator : estimators) names.push_back(estimator.name);
  names.emplace_back("quadric");
  std::string listed;
  for (const std::string_view name : names)
    listed += std::string(listed.empty() ? "" : " or ") + std::string(name);
  const core::Length scale = read_scale(reader, core::Length::absolute(0));
  const std::string chosen = reader.choice("estimator", names.front(), names,
                                           listed + " (fitted within a radius, for noisy surfaces)");
  const core::Length radius = reader.length("radius", core::Length::epsilons(5), core::kPositive,
                                            "how far a fitted quadric reaches, with estimator=quadric");
  const bool quadric = chosen == "quadric";
  if (!quadric && reader.given("radius"))
    throw core::InvalidArgument(reader.owner() +
                                ":radius is for estimator=quadric, not for estimator=" + chosen);
  Direct direct = nullptr;
  for (const Estimator& estimator : estimators)
    if (estimator.name == chosen) direct = estimator.direct;
  parameters.emplace_back("estimator", chosen);
  return std::make_unique<Curvature>(combination, direct, scale, radius, std::move(parameters), quadric);
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
  return make(reader, mean, {{"taubin", mean_curvature}, {"cotangent", cotangent_mean_curvature}});
}

std::unique_ptr<core::MorseFunction> make_gaussian_curvature(core::ParameterReader& reader) {
  return make(reader, product, {{"defect", gaussian_curvature}});
}

std::unique_ptr<core::MorseFunction> make_principal_curvature(core::ParameterReader& reader) {
  const std::string which =
      reader.choice("which", "max", {"max", "min"}, "the larger or the smaller one, signs counted");
  return make(reader, which == "max" ? largest : least, {{"taubin", nullptr}}, {{"which", which}});
}

std::unique_ptr<core::MorseFunction> make_curvedness(core::ParameterReader& reader) {
  return make(reader, curvedness, {{"taubin", nullptr}});
}

std::unique_ptr<core::MorseFunction> make_shape_index(core::ParameterReader& reader) {
  return make(reader, shape_index, {{"taubin", nullptr}});
}

}  // namespace morsel::morse
