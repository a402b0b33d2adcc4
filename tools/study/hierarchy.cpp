#include "morsel/tools/study/hierarchy.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/study/iteration_levels.h"
#include "morsel/tools/study/persistence_levels.h"

namespace morsel::tools {
namespace {

using core::InvalidArgument;

constexpr std::int64_t kMostIterations = 1'000'000;
constexpr std::int64_t kLargestCount = std::int64_t{1} << 40;

[[noreturn]] void refuse_list(const std::string& what, const std::string& text) {
  throw InvalidArgument("the " + what + " are a list such as 1,5,10, not \"" + text + "\"");
}

[[noreturn]] void refuse_repeated(const std::string& what, const std::string& text, const std::string& item) {
  throw InvalidArgument("the " + what + " " + text + " have " + item + " twice");
}

/// The texts that commas separate, each read by `parse`; throws if one is there twice.
template <class Parse>
auto parse_list(const std::string& text, const std::string& what, const Parse& parse) {
  std::vector<decltype(parse(text))> items;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t comma = std::min(text.find(',', first), text.size());
    const std::string item = text.substr(first, comma - first);
    if (item.empty()) refuse_list(what, text);
    items.push_back(parse(item));
    if (std::ranges::count(items, items.back()) > 1) refuse_repeated(what, text, item);
    first = comma + 1;
  }
  return items;
}

std::int64_t parse_whole(const std::string& text, const std::string& what, std::int64_t min,
                         std::int64_t max) {
  const std::int64_t number = core::parse_integer(text, what);
  if (number < min || number > max)
    throw InvalidArgument(what + " must be a whole number from " + std::to_string(min) + " to " +
                          std::to_string(max) + ", not " + text);
  return number;
}

std::vector<int> parse_iterations(const std::string& text) {
  std::vector<int> iterations = parse_list(text, "levels", [](const std::string& item) {
    return static_cast<int>(parse_whole(item, "a level by iteration", 0, kMostIterations));
  });
  std::ranges::sort(iterations);
  return iterations;
}

std::vector<persistence::Threshold> parse_thresholds(const std::string& text) {
  return parse_list(text, "levels", [](const std::string& item) {
    return persistence::parse_threshold(item, "a level by persistence");
  });
}

std::vector<std::size_t> parse_counts(const std::string& text) {
  return parse_list(text, "counts", [](const std::string& item) {
    return static_cast<std::size_t>(parse_whole(item, "a count of critical cells", 1, kLargestCount));
  });
}

/// As make_field(), with the levels that the method passes through.
std::pair<MadeField, std::vector<LevelSeed>> make_iterations(const HierarchyPlan& plan,
                                                             const core::LoadedMesh& loaded,
                                                             const core::Progress& progress) {
  FieldOutcome input = evaluate_field(loaded, plan.field.function, progress);
  const Stopwatch watch;
  IterationLevels levels =
      iteration_levels(plan.field.chain, loaded, plan.field.function, input.field, plan.iterations, progress);
  MadeField made{std::move(input), std::move(levels.outcome), watch.seconds()};
  return {std::move(made), std::move(levels.seeds)};
}

}  // namespace

std::string_view to_string(HierarchyKind kind) {
  return kind == HierarchyKind::iteration ? "iteration" : "persistence";
}

HierarchyRequest with_defaults(HierarchyRequest request) {
  const bool by_iteration = request.kind == HierarchyKind::iteration;
  if (request.field.method.empty()) request.field.method = by_iteration ? "salient" : "conventional";
  if (request.levels.empty() && (by_iteration || request.counts.empty()))
    request.levels = by_iteration ? "1,5,10" : "0.1%,1%,5%";
  return request;
}

HierarchyPlan prepare(const HierarchyRequest& given, const Registry& registry) {
  const bool by_iteration = given.kind == HierarchyKind::iteration;
  if (by_iteration && !given.counts.empty())
    throw InvalidArgument("counts go with levels by persistence, not by iteration");
  if (by_iteration && given.field.target)
    throw InvalidArgument(
        "a target ends a method at that many critical points, so that levels by iteration would be missing: "
        "it "
        "goes with levels by persistence");
  if (!given.levels.empty() && !given.counts.empty())
    throw InvalidArgument("levels by persistence are given as levels or as counts, not as both");
  HierarchyRequest request = with_defaults(given);
  HierarchyPlan plan{{}, request.kind, {}, {}, {}};
  if (by_iteration) {
    plan.iterations = parse_iterations(request.levels);
    request.field.method = with_iterations(request.field.method, plan.iterations.back(), registry);
  } else if (request.counts.empty()) {
    plan.thresholds = parse_thresholds(request.levels);
  } else {
    plan.counts = parse_counts(request.counts);
  }
  plan.field = prepare(request.field, registry);
  return plan;
}

void run_hierarchy(const core::LoadedMesh& loaded, const HierarchyPlan& plan,
                   const std::vector<HierarchySink*>& sinks, const core::Progress& progress) {
  const auto begin = [&](const HierarchyBasis& basis) {
    for (HierarchySink* sink : sinks) sink->begin(basis);
  };
  std::vector<LevelSeed> seeds;
  if (plan.kind == HierarchyKind::iteration) {
    auto [made, found] = make_iterations(plan, loaded, progress);
    begin({made, nullptr, 0});
    seeds = std::move(found);
  } else {
    const MadeField made = make_field(plan.field, loaded, progress);
    const Stopwatch watch;
    const FieldHierarchy from{std::make_shared<core::ScalarField>(made.field()),
                              std::make_shared<mscomplex::PersistenceHierarchy>(made.field(), progress)};
    begin({made, from.hierarchy.get(), watch.seconds()});
    seeds =
        plan.counts.empty() ? levels_by_threshold(from, plan.thresholds) : levels_by_count(from, plan.counts);
  }
  build_levels(
      std::move(seeds),
      [&](const Level& level) {
        for (HierarchySink* sink : sinks) sink->level(level);
      },
      progress);
}

}  // namespace morsel::tools
