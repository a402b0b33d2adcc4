#include "morsel/tools/study/comparison.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/specification.h"
#include "morsel/mscomplex/quad_regions.h"

namespace morsel::tools {
namespace {

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
  std::vector<core::Specification> steps = core::parse_chain(specification, "the method");
  for (const RowCount& count : plan.counts[row]) set_count(steps[count.step], totals[count.row]);
  return make_row(steps, specification, plan.registry);
}

/// For each critical point of a row, the vertex to report it at.
std::vector<core::Index> places_of(const morse::CriticalPoints& points,
                                   const std::vector<core::Index>& origins, bool snap) {
  std::vector<core::Index> places(origins.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = snap && origins[i] != core::kNone ? origins[i] : points.points[i].vertex;
  return places;
}

/// Moves the row's own chosen points to where its critical points are reported.
void move_to_places(MadePoints& made, const morse::CriticalPoints& points,
                    const std::vector<core::Index>& places) {
  for (std::size_t i = 0; i < made.places.size(); ++i) {
    if (made.chosen.points[i].source != 0) continue;
    const auto at =
        std::ranges::lower_bound(points.points, made.places[i], {}, &morse::CriticalPoint::vertex);
    made.places[i] = places[static_cast<std::size_t>(at - points.points.begin())];
  }
}

/// Without the matching.
ChosenOutcome by_vertex(MadePoints made) {
  std::vector<std::pair<morse::CriticalPoint, core::Index>> sorted;
  for (std::size_t i = 0; i < made.places.size(); ++i)
    sorted.emplace_back(made.chosen.points[i].candidate.point, made.places[i]);
  std::ranges::sort(sorted, {}, [](const auto& entry) { return entry.first.vertex; });
  std::vector<morse::CriticalPoint> points;
  ChosenOutcome chosen;
  for (const auto& [point, place] : sorted) {
    points.push_back(point);
    chosen.places.push_back(place);
  }
  chosen.points = morse::counts_of(points);
  chosen.points.points = std::move(points);
  chosen.made = std::move(made);
  return chosen;
}

/// Chooses points of each row.
class RowPoints {
 public:
  /// Refers to the plan and the mesh.
  RowPoints(const PointsPlan& plan, const core::LoadedMesh& loaded, double radius)
      : maker_(plan, loaded), mesh_(loaded.mesh), radius_(radius) {}

  ChosenOutcome choose(const PointsField& from, const morse::CriticalPoints& points,
                       const std::vector<core::Index>& places, const core::Progress& progress) {
    MadePoints made = maker_.make(from, progress);
    move_to_places(made, points, places);
    ChosenOutcome chosen = by_vertex(std::move(made));
    if (!first_) first_ = chosen.points;
    chosen.compared_to_first = match_critical_points(mesh_, *first_, chosen.points, radius_);
    return chosen;
  }

 private:
  PointMaker maker_;
  const core::TriangleMesh& mesh_;
  double radius_;
  std::optional<morse::CriticalPoints> first_;
};

}  // namespace

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
    std::vector<core::Specification> steps = core::parse_chain(method, "the method");
    plan.counts.push_back(row_counts(steps, plan.chains));
    for (const RowCount& count : plan.counts.back()) set_count(steps[count.step], 1);  // to be replaced
    plan.chains.push_back(make_row(steps, method, registry));
  }
  if (request.points) plan.points = prepare(*request.points, registry);
  return plan;
}

void run_comparison(const core::LoadedMesh& loaded, const ComparisonPlan& plan,
                    const std::vector<ComparisonSink*>& sinks, const core::Progress& progress) {
  const auto shared = std::make_shared<const FieldOutcome>(evaluate_field(loaded, plan.function, progress));
  const FieldOutcome& input = *shared;
  for (ComparisonSink* sink : sinks) sink->keep_field(shared);
  const double radius = matching_radius(loaded.mesh);
  const morse::CriticalPointTracker at_input(std::shared_ptr<const core::ScalarField>(shared, &input.field),
                                             radius, progress.unreported());
  std::optional<morse::CriticalPoints> first;
  std::vector<std::size_t> totals;  // of the rows so far
  std::optional<RowPoints> row_points;
  if (plan.points) row_points.emplace(*plan.points, loaded, radius);
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
    std::vector<core::Index> places = places_of(measurement.critical_points, origins, plan.snap);
    const auto outcome = std::make_shared<MethodOutcome>(MethodOutcome{
        chain.specification, chain.name, std::move(made.steps), std::move(made.field), input.field.extent(),
        std::move(made.target), std::move(measurement), std::move(origins), std::move(places),
        std::move(matching), std::move(timings), chain.quantity()});
    if (row_points) {
      const Stopwatch points_watch;
      outcome->chosen = row_points->choose({input.name, outcome->field, outcome->steps},
                                           outcome->measurement.critical_points, outcome->places, progress);
      outcome->timings.emplace_back("points", points_watch.seconds());
    }
    for (ComparisonSink* sink : sinks) sink->keep_method(outcome);
  }
}

}  // namespace morsel::tools
