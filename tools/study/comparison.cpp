#include "morsel/tools/study/comparison.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/specification.h"
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

constexpr std::string_view kCount = "count";

void set_count(core::Specification& step, std::size_t count) {
  for (auto& [key, raw] : step.given)
    if (key == kCount) raw = std::to_string(count);
}

/// The earlier row that is called so: by its whole specification, else by its methods' names.
std::size_t find_row(const std::string& name, const std::string& owner,
                     const std::vector<MethodChain>& earlier) {
  std::vector<std::string> rows;
  for (const MethodChain& chain : earlier) rows.push_back(chain.specification);
  const auto refused = [&](const std::string& why) {
    return core::InvalidArgument(owner +
                                 ":count must be a whole number or the name of an earlier method, not \"" +
                                 name + "\": " + why);
  };
  std::optional<std::size_t> found;
  for (std::size_t row = 0; row < rows.size() && !found; ++row)
    if (rows[row] == name) found = row;
  if (found) return *found;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (earlier[row].name != name) continue;
    if (found) throw refused("it could be " + rows[*found] + " or " + rows[row]);
    found = row;
  }
  if (!found)
    throw refused(rows.empty() ? "there is no method before it"
                               : "before it there are " + core::listed(rows));
  return *found;
}

std::vector<RowCount> row_counts(const std::vector<core::Specification>& steps,
                                 const std::vector<MethodChain>& earlier) {
  std::vector<RowCount> counts;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (const std::optional<std::string> name = named_row(steps[i]))
      counts.push_back({i, find_row(*name, steps[i].name, earlier)});
  return counts;
}

MethodChain make_row(const std::vector<core::Specification>& steps, const std::string& specification,
                     const Registry& registry) {
  MethodChain chain = registry.make_method(core::to_string(steps));
  chain.specification = specification;
  return chain;
}

/// A row's chain with the counts of earlier rows, whose critical points are `totals`.
MethodChain counted_row(const ComparisonPlan& plan, std::size_t row, const std::vector<std::size_t>& totals) {
  const std::string& specification = plan.chains[row].specification;
  std::vector<core::Specification> steps = core::parse_chain(specification, "--method");
  for (const RowCount& count : plan.counts[row]) set_count(steps[count.step], totals[count.row]);
  return make_row(steps, specification, plan.registry);
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

std::optional<std::string> named_row(const core::Specification& step) {
  for (const auto& [key, raw] : step.given) {
    if (key != kCount) continue;
    const std::string text = core::unescape(raw);
    const bool is_name =
        !text.empty() && text != "none" && text.find_first_not_of("0123456789+-.") != std::string::npos;
    return is_name ? std::optional(text) : std::nullopt;
  }
  return std::nullopt;
}

ComparisonPlan prepare(const ComparisonRequest& request, const Registry& registry) {
  check_target(request.target);
  ComparisonPlan plan{registry.make_function(request.field), {}, request.target, request.snap, {}, registry};
  for (const std::string& method : request.methods) {
    std::vector<core::Specification> steps = core::parse_chain(method, "--method");
    plan.counts.push_back(row_counts(steps, plan.chains));
    for (const RowCount& count : plan.counts.back()) set_count(steps[count.step], 1);  // to be replaced
    plan.chains.push_back(make_row(steps, method, registry));
  }
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
  std::vector<std::size_t> totals;  // of the rows so far
  for (std::size_t row = 0; row < plan.chains.size(); ++row) {
    const MethodChain chain = counted_row(plan, row, totals);
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
    totals.push_back(measurement.critical_points.total());
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
