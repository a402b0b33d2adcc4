#include "morsel/tools/study/comparison.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/mscomplex/quad_regions.h"

namespace morsel::tools {
namespace {

std::vector<FieldFile> files_of(const NamedFunction& function, const core::Parameters& parameters) {
  std::vector<FieldFile> files;
  for (const auto& [key, value] : parameters)
    if (!function.file_key.empty() && key == function.file_key)
      files.push_back({key, std::get<std::string>(value)});
  return files;
}

/// Says so if most critical points come from the order of vertex numbers alone; else empty.
std::string plateau_warning(const core::ScalarField& field, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const auto is_flat = [&](core::Index e) {
    const auto [a, b] = mesh.edge_vertices(e);
    return field.value(a) == field.value(b);
  };
  std::vector<bool> tied(mesh.vertex_count(), false);
  bool any = false;
  for (core::Index e = 0; e < mesh.edge_count(); ++e) {
    if (!is_flat(e)) continue;
    const auto [a, b] = mesh.edge_vertices(e);
    tied[a] = tied[b] = any = true;
  }
  if (!any) return {};
  const std::vector<morse::CriticalPoint> points = morse::classify(field, progress).points;
  const auto by_number = static_cast<std::size_t>(
      std::ranges::count_if(points, [&](const morse::CriticalPoint& point) { return tied[point.vertex]; }));
  if (field.extent() == 0)
    return "the field is constant: its " + std::to_string(points.size()) +
           " critical points come from the order of vertex numbers alone";
  if (2 * by_number <= points.size()) return {};
  return std::to_string(by_number) + " of the field's " + std::to_string(points.size()) +
         " critical points have a neighbour of the same value: they come from the order of vertex numbers";
}

}  // namespace

FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress) {
  const Stopwatch watch;
  core::FunctionResult result = function.function->evaluate(loaded.mesh, {&loaded.source, progress});
  std::vector<FieldFile> files = files_of(function, result.parameters);
  std::vector<std::string> warnings = std::move(result.warnings);
  if (std::string text = plateau_warning(result.field, progress.unreported()); !text.empty())
    warnings.push_back(std::move(text));
  return {function.name,   std::move(result.field), std::move(result.parameters),
          watch.seconds(), std::move(files),        std::move(warnings)};
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
  core::Index cells = 0;
  auto segments = timed("segmentation", [&] {
    cells = mscomplex::cell_count(field, complex);
    return mscomplex::segment(field, complex.gradient(), progress);
  });
  return {std::move(points), std::move(diagram), std::move(complex), std::move(segments), cells};
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
    const MethodOutcome outcome{chain.specification,    chain.name,           std::move(made.steps),
                                std::move(made.field),  input.field.extent(), std::move(made.target),
                                std::move(measurement), std::move(origins),   std::move(places),
                                std::move(matching),    std::move(timings)};
    for (ComparisonSink* sink : sinks) sink->method(outcome);
  }
}

}  // namespace morsel::tools
