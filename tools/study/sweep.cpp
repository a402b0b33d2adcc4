#include "morsel/tools/study/sweep.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/rethrow.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/critical_points.h"
#include "morsel/persistence/pairing.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {
namespace {

using core::ScalarField;

/// Numbers of combinations.
using Members = std::vector<std::size_t>;

/// The members with equal texts, in the order of their first ones.
template <class Text>
std::vector<Members> grouped_by(const Members& members, const Text& text) {
  std::vector<Members> groups;
  std::map<std::string, std::size_t> places;
  for (const std::size_t member : members) {
    const auto [place, is_new] = places.emplace(text(member), groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(member);
  }
  return groups;
}

core::Specification without_iterations(core::Specification step) {
  std::erase_if(step.given, [](const auto& entry) { return entry.first == core::kIterationsKey; });
  return step;
}

std::optional<int> iterations_of(const core::Specification& step) {
  for (const auto& [key, raw] : step.given)
    if (key == core::kIterationsKey)
      return static_cast<int>(core::parse_integer(core::unescape(raw), step.name + ":" + key));
  return std::nullopt;
}

/// A stopwatch that can be paused.
class HeldWatch {
 public:
  double seconds() const { return watch_.seconds() - held_; }
  template <class Work>
  void hold(const Work& work) {
    const Stopwatch pause;
    work();
    held_ += pause.seconds();
  }

 private:
  Stopwatch watch_;
  double held_ = 0;
};

class SweepRun {
 public:
  SweepRun(const core::LoadedMesh& loaded, const SweepPlan& plan, const SweepOptions& options,
           const core::Progress& progress)
      : loaded_(loaded), plan_(plan), options_(options), progress_(progress), silent_(progress.unreported()) {
    rows_.resize(plan.combinations.size());
    for (std::size_t i = 0; i < options.known.size(); ++i)
      if (options.known[i]) {
        rows_[i] = *options.known[i];
        ++done_;
      }
  }

  std::vector<SweepRow> run() {
    Members members;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (options_.known.empty() || !options_.known[i]) members.push_back(i);
    const auto field_text = [&](std::size_t i) { return to_string(plan_.combinations[i].field); };
    for (const Members& group : grouped_by(members, field_text)) {
      show_progress();
      const NamedFunction function = plan_.registry.make_function(field_text(group.front()));
      const FieldOutcome field =
          named(group.front(), [&] { return evaluate_field(loaded_, function, silent_); });
      function_ = &function;
      field_ = &field;
      descend(field.field, group, 0);
    }
    return std::move(rows_);
  }

 private:
  /// The parts of a row before it is complete.
  struct Draft {
    SweepRow row;
    std::vector<double> seconds;  // of each step
  };

  /// The step and those after it, on `input`.
  void descend(const ScalarField& input, const Members& members, std::size_t step) {
    if (step == plan_.combinations[members.front()].steps.size()) {
      measure(input, members.front());
      return;
    }
    const auto specification = [&](std::size_t i) -> const core::Specification& {
      return plan_.combinations[i].steps[step];
    };
    const auto readable = [&](std::size_t i) {
      return iterations_of(specification(i)) &&
             make_step(specification(i)).steps.front().method->traits().iterates_are_results;
    };
    const auto text = [&](std::size_t i) {
      return to_string(readable(i) ? without_iterations(specification(i)) : specification(i));
    };
    for (const Members& group : grouped_by(members, text))
      readable(group.front()) ? read_out(input, group, step) : apply(input, group, step);
  }

  MethodChain make_step(const core::Specification& step) const {
    return plan_.registry.make_method(to_string(step));
  }

  void apply(const ScalarField& input, const Members& members, std::size_t step) {
    show_progress();
    const core::Specification& specification = plan_.combinations[members.front()].steps[step];
    const MethodChain chain = make_step(specification);
    const HeldWatch watch;
    core::MethodResult result = named(members.front(), [&] {
      return chain.steps.front().method->apply(input, method_context(loaded_, *function_, silent_));
    });
    const StepOutcome outcome = outcome_of(chain.name, result);
    for (const std::size_t i : members) finish_step(i, step, outcome, watch.seconds());
    descend(result.field, members, step + 1);
  }

  /// One run with the largest number of iterations.
  void read_out(const ScalarField& input, const Members& members, std::size_t step) {
    std::map<int, Members> by_iterations;
    const auto specification = [&](std::size_t i) { return plan_.combinations[i].steps[step]; };
    for (const std::size_t i : members) by_iterations[*iterations_of(specification(i))].push_back(i);
    show_progress();
    const std::size_t longest = by_iterations.rbegin()->second.front();
    const MethodChain chain = make_step(specification(longest));
    HeldWatch watch;
    std::map<int, double> seconds;
    const auto read = [&](int iterations, const ScalarField& field) {
      seconds[iterations] = watch.seconds();
      watch.hold([&] { descend(field, by_iterations.at(iterations), step + 1); });
    };
    ++open_runs_;
    core::MethodContext context = method_context(loaded_, *function_, silent_);
    context.on_iteration = {[&](int iteration, const ScalarField& field) {
                              read(iteration, field);
                              return true;
                            },
                            [&](int iteration) { return by_iterations.contains(iteration); }};
    core::MethodResult result =
        named(longest, [&] { return chain.steps.front().method->apply(input, context); });
    StepOutcome outcome = outcome_of(chain.name, result);
    const std::int64_t run = result.end ? result.end->iterations_run : 0;
    for (const auto& [iterations, group] : by_iterations) {
      // A method reports iteration 0 only if it is not its own input; and it may have ended by itself.
      if (!seconds.contains(iterations)) read(iterations, iterations == 0 && run > 0 ? input : result.field);
      set_iterations(outcome.parameters, iterations);
      if (outcome.end) outcome.end->iterations_run = std::min<std::int64_t>(iterations, run);
      for (const std::size_t i : group) finish_step(i, step, outcome, seconds.at(iterations));
    }
    --open_runs_;
    emit();
  }

  static StepOutcome outcome_of(const std::string& name, core::MethodResult& result) {
    StepOutcome outcome{name, std::move(result.parameters), {}, {}};
    outcome.end = result.end;
    outcome.sigma = result.sigma;
    return outcome;
  }

  static void set_iterations(core::Parameters& parameters, int iterations) {
    for (auto& [key, value] : parameters)
      if (key == core::kIterationsKey) value = std::int64_t{iterations};
  }

  /// Steps are finished in any order: within an open run, later steps before the run's own.
  void finish_step(std::size_t i, std::size_t step, const StepOutcome& outcome, double seconds) {
    Draft& draft = drafts_[i];
    draft.row.steps.resize(plan_.combinations[i].steps.size());
    draft.seconds.resize(draft.row.steps.size());
    draft.row.steps[step] = outcome;
    draft.seconds[step] = seconds;
  }

  void measure(const ScalarField& field, std::size_t i) {
    const Stopwatch watch;
    SweepRow& row = drafts_[i].row;
    row.min = field.min();
    row.max = field.max();
    row.critical_points = morse::classify(field, silent_);
    row.critical_points.points = {};
    row.persistence = summary_of(persistence::pair_extrema(field, silent_), field_->field.extent());
    row.seconds.measuring = watch.seconds();
    emit();
  }

  /// Emits the complete rows, unless a run is open whose parameters are not known yet.
  void emit() {
    if (open_runs_ > 0) return;
    for (auto& [i, draft] : drafts_) {
      SweepRow& row = rows_[i] = std::move(draft.row);
      row.field = summary_of(*field_);
      for (const StepOutcome& step : row.steps)
        if (step.end) row.iterations_run = row.iterations_run.value_or(0) + step.end->iterations_run;
      row.seconds.field = field_->seconds;
      row.seconds.method = std::reduce(draft.seconds.begin(), draft.seconds.end());
      ++done_;
      if (options_.on_row) options_.on_row(i, row);
    }
    drafts_.clear();
  }

  /// Calls `work`; its errors name the combination, unless work nested in it has named its own.
  template <class Work>
  std::invoke_result_t<const Work&> named(std::size_t i, const Work& work) {
    const Combination& combination = plan_.combinations[i];
    try {
      return work();
    } catch (const core::Error& error) {
      if (error.kind() == core::ErrorKind::cancelled || std::exchange(error_is_named_, true)) throw;
      core::rethrow_at(error, to_string(combination.field) + ", " + to_string(combination.steps));
    }
  }

  void show_progress() const {
    progress_.update("sweep", static_cast<double>(done_) / static_cast<double>(rows_.size()));
  }

  const core::LoadedMesh& loaded_;
  const SweepPlan& plan_;
  const SweepOptions& options_;
  const core::Progress& progress_;
  core::Progress silent_;  // for a combination: progress is reported by the sweep
  std::vector<SweepRow> rows_;
  std::map<std::size_t, Draft> drafts_;
  int open_runs_ = 0;
  bool error_is_named_ = false;
  std::size_t done_ = 0;
  const NamedFunction* function_ = nullptr;
  const FieldOutcome* field_ = nullptr;
};

}  // namespace

std::string SweepRow::method_name() const {
  std::string name;
  for (const StepOutcome& step : steps) name += (name.empty() ? "" : "+") + step.name;
  return name;
}

std::vector<SweepRow> run_sweep(const core::LoadedMesh& loaded, const SweepPlan& plan,
                                const SweepOptions& options, const core::Progress& progress) {
  return SweepRun(loaded, plan, options, progress).run();
}

}  // namespace morsel::tools
