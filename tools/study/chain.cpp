#include "morsel/tools/study/chain.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/pairing.h"

namespace morsel::tools {
namespace {

bool is_same(const core::ScalarField& a, const core::ScalarField& b) {
  return std::ranges::equal(a.values(), b.values()) && std::ranges::equal(a.ranks(), b.ranks());
}

/// Observes one step: passes its fields to the tracker and to the search for the wanted number.
class StepWatcher {
 public:
  /// Either may be null. `result_only`: the search is shown the step's result alone.
  StepWatcher(morse::CriticalPointTracker* tracker, TargetSearch* search, bool result_only)
      : tracker_(tracker), search_(search), result_only_(result_only) {}

  bool wanted() const { return tracker_ != nullptr || search_ != nullptr; }

  bool iteration(int number, const core::ScalarField& field) {
    if (number <= last_) restart();
    last_ = number;
    if (!result_only_) return pass(field);
    if (tracker_ != nullptr) tracker_->advance(field);
    return true;
  }

  /// The step's result, unless it is the field of its last iteration.
  void finish(const core::ScalarField& field) {
    if (!wanted() || ended_) return;
    const core::ScalarField& last = tracker_ != nullptr ? tracker_->field() : search_->current();
    const bool known = passed_ || search_ == nullptr;
    if (!(known && is_same(last, field))) pass(field);
  }

 private:
  void restart() {
    ended_ = false;
    passed_ = false;
    if (tracker_ != nullptr && at_start_)
      *tracker_ = *at_start_;
    else if (tracker_ != nullptr)
      at_start_ = *tracker_;
    if (search_ != nullptr) search_->restart();
  }

  bool pass(const core::ScalarField& field) {
    const bool go_on = search_ == nullptr || search_->offer(field);
    if (search_ != nullptr && search_->is_beyond()) {
      ended_ = true;
      return false;
    }
    if (tracker_ != nullptr) tracker_->advance(field);
    passed_ = true;
    ended_ = !go_on;
    return go_on;
  }

  morse::CriticalPointTracker* tracker_;
  TargetSearch* search_;
  bool result_only_;
  std::optional<morse::CriticalPointTracker> at_start_;  // once the first iteration is seen
  int last_ = std::numeric_limits<int>::max();  // the last reported number; a smaller one is a new start
  bool passed_ = false;                         // a field that the method may end with
  bool ended_ = false;
};

/// The outcome of a last step that the caller ends at its input: it is not run.
void end_at_input(const MethodStep& step, std::optional<TargetSearch>& search,
                  morse::CriticalPointTracker* tracker, ChainOutcome& outcome) {
  outcome.steps.push_back({step.name, {}, {}, {}, core::IterationEnd{0, "caller"}});
  if (!search) return;
  search->offer(outcome.field);
  TargetSearch::Result found = search->finish();
  outcome.field = std::move(found.field);
  outcome.target = std::move(found.outcome);
  outcome.target->iterations = 0;
  if (tracker != nullptr) tracker->advance(outcome.field);
}

}  // namespace

core::MethodContext method_context(const core::LoadedMesh& loaded, const NamedFunction& function,
                                   const core::Progress& progress) {
  core::MethodContext context;
  context.progress = progress;
  context.morse_function = [&, silent = progress.unreported()](const core::TriangleMesh& mesh) {
    return function.function->evaluate(mesh, {&loaded.source, silent}).field;
  };
  return context;
}

ChainOutcome apply_chain(const MethodChain& chain, const core::LoadedMesh& loaded,
                         const NamedFunction& function, const core::ScalarField& field,
                         const ChainOptions& options, const core::Progress& progress) {
  core::MethodContext context = method_context(loaded, function, progress);
  context.count_iterations = options.count_iterations;
  ChainOutcome outcome{field, {}, {}};
  for (const MethodStep& step : chain.steps) {
    const bool is_last = &step == &chain.steps.back();
    const core::IterationCallback callback = is_last ? options.on_iteration : core::IterationCallback();
    std::optional<TargetSearch> search;
    if (options.target && is_last)
      search.emplace(outcome.field, *options.target, step.method->traits().cancels_pairs, progress);
    std::optional<morse::CriticalPointTracker> at_input;
    if (search && options.tracker != nullptr) at_input = *options.tracker;
    StepWatcher watcher(options.tracker, search ? &*search : nullptr, step.method->traits().returns_other);
    context.on_iteration = callback;
    if (watcher.wanted())
      context.on_iteration = [&](int number, const core::ScalarField& passed) {
        const bool go_on = watcher.iteration(number, passed);
        return callback(number, passed) && go_on;
      };
    if (!callback(0, outcome.field)) {
      end_at_input(step, search, options.tracker, outcome);
      break;
    }
    core::MethodResult result = step.method->apply(outcome.field, context);
    watcher.finish(result.field);
    outcome.steps.push_back(
        {step.name, std::move(result.parameters), std::move(result.details), std::move(result.iterations)});
    outcome.steps.back().end = std::move(result.end);
    outcome.steps.back().sigma = result.sigma;
    outcome.steps.back().warnings = std::move(result.warnings);
    if (!search) {
      outcome.field = std::move(result.field);
      continue;
    }
    TargetSearch::Result found = search->finish();
    if (at_input) {
      if (found.outcome.iterations == 0) *options.tracker = *at_input;
      options.tracker->advance(found.smoothed);
      options.tracker->advance(found.field);
    }
    outcome.field = std::move(found.field);
    outcome.target = std::move(found.outcome);
  }
  return outcome;
}

}  // namespace morsel::tools
