#include "morsel/tools/comparison/comparison.h"

#include <optional>

#include "morsel/persistence/cancellation.h"

namespace morsel::tools {

FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress) {
  const Stopwatch watch;
  core::FunctionResult result = function.function->evaluate(loaded.mesh, {&loaded.source, progress});
  return {function.name, std::move(result.field), std::move(result.parameters), watch.seconds()};
}

core::ScalarField apply_chain(const MethodChain& chain, const core::LoadedMesh& loaded,
                              const NamedFunction& function, const core::ScalarField& field,
                              const core::Progress& progress, std::vector<StepOutcome>* steps) {
  core::MethodContext context;
  context.progress = progress;
  context.morse_function = [&](const core::TriangleMesh& mesh) {
    return function.function->evaluate(mesh, {&loaded.source, progress}).field;
  };
  context.persistent_extrema = [&](const core::ScalarField& on, std::size_t count) {
    return persistence::persistent_extrema(persistence::pair_extrema(on, progress), count);
  };
  context.cancel = [&](const core::ScalarField& on, double threshold) {
    return persistence::cancel(on, {persistence::Threshold::absolute(threshold), {}}, progress).field;
  };
  core::ScalarField current = field;
  for (const MethodStep& step : chain.steps) {
    core::MethodResult result = step.method->apply(current, context);
    current = std::move(result.field);
    if (steps != nullptr)
      steps->push_back({step.name, std::move(result.parameters), std::move(result.details)});
  }
  return current;
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

void run_comparison(const core::LoadedMesh& loaded, const NamedFunction& function,
                    const std::vector<MethodChain>& chains, const std::vector<ComparisonSink*>& sinks,
                    const core::Progress& progress) {
  const FieldOutcome input = evaluate_field(loaded, function, progress);
  for (ComparisonSink* sink : sinks) sink->field(input);
  std::optional<morse::CriticalPoints> first;
  for (const MethodChain& chain : chains) {
    for (ComparisonSink* sink : sinks) sink->begin_method(chain.name);
    const Stopwatch watch;
    std::vector<StepOutcome> steps;
    core::ScalarField field = apply_chain(chain, loaded, function, input.field, progress, &steps);
    Timings timings = {{"method", watch.seconds()}};
    Measurement measurement = measure(field, timings, progress);
    if (!first) first = measurement.critical_points;
    Matching matching =
        match_critical_points(loaded.mesh, *first, measurement.critical_points, matching_radius(loaded.mesh));
    const MethodOutcome outcome{
        chain.specification,    chain.name,          std::move(steps),  std::move(field),
        std::move(measurement), std::move(matching), std::move(timings)};
    for (ComparisonSink* sink : sinks) sink->method(outcome);
  }
}

}  // namespace morsel::tools
