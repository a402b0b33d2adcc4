#include "morsel/tools/study/iteration_levels.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/tracking.h"
#include "morsel/persistence/pairing.h"
#include "morsel/tools/study/matching.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::InvalidArgument;
using core::ScalarField;

std::string iterative_methods(const Registry& registry) {
  std::string names;
  for (const MethodEntry& entry : registry.methods())
    if (registry.traits_of_method(entry.name).iterates) names += (names.empty() ? "" : ", ") + entry.name;
  return names;
}

/// Keeps the fields of some iterations, and follows critical points from each to the one before.
class LevelCollector {
 public:
  LevelCollector(const std::vector<int>& levels, double reach, const core::Progress& progress)
      : levels_(levels), reach_(reach), progress_(progress) {}

  /// In the order of the method; false if no more are wanted.
  bool take(int iteration, const ScalarField& field) {
    if (iteration <= reached_) restart();
    reached_ = iteration;
    if (tracker_) tracker_->advance(field);
    if (kept_.size() < levels_.size() && levels_[kept_.size()] == iteration) keep(field);
    return kept_.size() < levels_.size();
  }

  int reached() const { return reached_; }
  bool is_complete() const { return kept_.size() == levels_.size(); }
  const ScalarField& last_field() const { return *kept_.back().field; }

  std::vector<LevelSeed> finish() {
    std::vector<LevelSeed> seeds;
    seeds.reserve(kept_.size());
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      Kept& kept = kept_[i];
      const std::vector<double> persistence = persistence::vertex_persistence(
          persistence::pair_extrema(*kept.field, progress_), kept.field->mesh().vertex_count());
      std::vector<double> of_points;
      of_points.reserve(kept.points.points.size());
      for (const morse::CriticalPoint& point : kept.points.points)
        of_points.push_back(persistence[point.vertex]);
      const auto gradient = [field = kept.field, progress = progress_] {
        return mscomplex::DiscreteGradient(*field, progress);
      };
      seeds.push_back({{.asked = std::to_string(levels_[i]), .iteration = levels_[i]},
                       kept.field,
                       std::move(kept.points),
                       std::move(of_points),
                       std::move(kept.parents),
                       gradient});
    }
    return seeds;
  }

 private:
  struct Kept {
    std::shared_ptr<const ScalarField> field;
    morse::CriticalPoints points;
    std::vector<Index> parents;
  };

  void keep(const ScalarField& field) {
    auto shared = std::make_shared<const ScalarField>(field);
    std::vector<Index> parents;
    if (tracker_) parents.assign(tracker_->origins().begin(), tracker_->origins().end());
    tracker_.emplace(shared, reach_, progress_);
    parents.resize(tracker_->points().points.size(), core::kNone);
    kept_.push_back({std::move(shared), tracker_->points(), std::move(parents)});
  }

  /// The method starts again: what was made of its input stays.
  void restart() {
    const bool input_is_kept = !levels_.empty() && levels_.front() == 0;
    kept_.resize(std::min<std::size_t>(kept_.size(), input_is_kept ? 1 : 0));
    tracker_.reset();
    if (!kept_.empty()) tracker_.emplace(kept_.front().field, reach_, progress_);
  }

  const std::vector<int>& levels_;
  double reach_;
  core::Progress progress_;
  std::vector<Kept> kept_;
  std::optional<morse::CriticalPointTracker> tracker_;  // from the last level that was kept
  int reached_ = -1;
};

}  // namespace

std::string with_iterations(const std::string& method, int needed, const Registry& registry) {
  const bool iterates = registry.make_method(method).steps.back().method->traits().iterates;
  const std::vector<core::Specification> chain = core::parse_chain(method, "the method");
  const core::Specification& last = chain.back();
  if (!iterates)
    throw InvalidArgument(last.name + " has no iterations that could be levels; the methods that have: " +
                          iterative_methods(registry));
  for (const auto& [key, value] : last.given) {
    if (key != core::kIterationsKey) continue;
    if (core::parse_integer(core::unescape(value), last.name + ":" + key) < needed)
      throw InvalidArgument(last.name + " is given " + value + " iterations, so that level " +
                            std::to_string(needed) + " is never reached: give it more or leave them out");
    return method;
  }
  return method + (last.given.empty() ? ":" : ",") + "iterations=" + std::to_string(needed);
}

IterationLevels iteration_levels(const MethodChain& chain, const core::LoadedMesh& loaded,
                                 const NamedFunction& function, const ScalarField& input,
                                 const std::vector<int>& levels, const core::Progress& progress) {
  LevelCollector collector(levels, matching_radius(loaded.mesh), progress);
  ChainOptions options;
  options.count_iterations = true;
  options.on_iteration = [&](int iteration, const ScalarField& field) {
    const bool wants_more = collector.take(iteration, field);
    return wants_more || iteration == 0;  // the method is run even where its input is the only level
  };
  ChainOutcome outcome = apply_chain(chain, loaded, function, input, options, progress);
  const std::string& name = chain.steps.back().name;
  if (!collector.is_complete()) {
    const std::optional<core::IterationEnd>& end = outcome.steps.back().end;
    throw InvalidArgument(name + " ended after " + std::to_string(collector.reached()) + " iterations" +
                          (end ? " (" + end->stopped_by + ")" : "") + ", so that level " +
                          std::to_string(levels.back()) + " was not reached");
  }
  const ScalarField& last = collector.last_field();
  if (!std::ranges::equal(outcome.field.values(), last.values()) ||
      !std::ranges::equal(outcome.field.ranks(), last.ranks()))
    throw InvalidArgument(
        name +
        " returns another field than that of its last iteration, so that its iterations are no levels");
  return {std::move(outcome), collector.finish()};
}

}  // namespace morsel::tools
