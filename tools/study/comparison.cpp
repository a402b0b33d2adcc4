#include "morsel/tools/study/comparison.h"

#include <memory>
#include <optional>

#include "morsel/core/error.h"

namespace morsel::tools {
FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress) {
  const Stopwatch watch;
  core::FunctionResult result = function.function->evaluate(loaded.mesh, {&loaded.source, progress});
  return {function.name,   std::move(result.field), std::move(result.parameters),
          watch.seconds(), function.files,          function.unit};
}

Measurement measure(const core::ScalarField& field, Timings& timings, const core::Progress& progress) {
  const auto timed = [&](const char* step, const auto& run) {
    const Stopwatch watch;
    auto result = run();
    timings.emplace_back(step, watch.seconds());
    return result;
  };
  auto points = timed("critical_points", [&] { return morse::classify(field, progress); });
  auto diagram = timed("persistence", [&] { return persistence::pair_extrema(field, progress); });
  auto gradient = timed("gradient", [&] { return mscomplex::DiscreteGradient(field, progress); });
  auto complex =
      timed("complex", [&] { return mscomplex::MorseSmaleComplex(field, std::move(gradient), progress); });
  auto segments =
      timed("segmentation", [&] { return mscomplex::segment(field, complex.gradient(), progress); });
  return {std::move(points), std::move(diagram), std::move(complex), std::move(segments)};
}

ComparisonPlan prepare(const ComparisonRequest& request, const Registry& registry) {
  check_target(request.target);
  ComparisonPlan plan{registry.make_function(request.field), {}, request.target, request.snap};
  for (const std::string& method : request.methods) plan.chains.push_back(registry.make_method(method));
  return plan;
}

void run_comparison(const core::LoadedMesh& loaded, const ComparisonPlan& plan,
                    const std::vector<ComparisonSink*>& sinks, const core::Progress& progress) {
  const auto shared = std::make_shared<const FieldOutcome>(evaluate_field(loaded, plan.function, progress));
  const FieldOutcome& input = *shared;
  for (ComparisonSink* sink : sinks) sink->field(input);
  const double radius = matching_radius(loaded.mesh);
  const morse::CriticalPointTracker at_input(std::shared_ptr<const core::ScalarField>(shared, &input.field),
                                             radius, progress.unreported());
  std::optional<morse::CriticalPoints> first;
  for (const MethodChain& chain : plan.chains) {
    for (ComparisonSink* sink : sinks) sink->begin_method(chain.name);
    const Stopwatch watch;
    std::optional<morse::CriticalPointTracker> tracker = at_input;
    ChainOutcome made =
        apply_chain(chain, loaded, plan.function, input.field, {plan.target, true, &*tracker}, progress);
    std::vector<core::Index> origins(tracker->origins().begin(), tracker->origins().end());
    tracker.reset();  // its field is not needed while the result is measured
    Timings timings = {{"method", watch.seconds()}};
    Measurement measurement = measure(made.field, timings, progress);
    if (!first) first = measurement.critical_points;
    Matching matching = match_critical_points(loaded.mesh, *first, measurement.critical_points, radius);
    std::vector<core::Index> places(origins.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] =
          plan.snap && origins[i] != core::kNone ? origins[i] : measurement.critical_points.points[i].vertex;
    const MethodOutcome outcome{chain.specification,    chain.name,
                                std::move(made.steps),  std::move(made.field),
                                std::move(made.target), std::move(measurement),
                                std::move(origins),     std::move(places),
                                std::move(matching),    std::move(timings),
                                chain.quantity()};
    for (ComparisonSink* sink : sinks) sink->method(outcome);
  }
}

}  // namespace morsel::tools
