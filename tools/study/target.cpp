#include "morsel/tools/study/target.h"

#include <algorithm>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/unfolding.h"
#include "morsel/persistence/cancellation.h"

namespace morsel::tools {
namespace {

/// Unfolds multiple saddles of `field` until the wanted number is reached. A field in which they are too few
/// stays as it is.
void unfold(core::ScalarField& field, TargetOutcome& outcome) {
  if (outcome.reached >= outcome.wanted) return;
  const morse::CriticalPoints points = morse::classify(field);
  if (points.saddle_multiplicity - points.saddles < outcome.wanted - outcome.reached) return;
  std::vector<std::pair<double, core::Index>> saddles;  // by the change they need
  for (const morse::CriticalPoint& point : points.points)
    if (point.multiplicity > 1)
      if (const auto unfolded = morse::unfold_saddle(field, point.vertex))
        saddles.emplace_back(unfolded->change, point.vertex);
  std::sort(saddles.begin(), saddles.end());
  for (const auto& [change, vertex] : saddles)
    while (outcome.reached < outcome.wanted) {
      std::optional<morse::Unfolding> unfolded = morse::unfold_saddle(field, vertex);
      if (!unfolded) break;
      field = std::move(unfolded->field);
      outcome.unfolded.push_back(vertex);
      outcome.largest_unfolding = std::max(outcome.largest_unfolding, unfolded->change);
      ++outcome.reached;
    }
}

}  // namespace

std::string early_end(const TargetOutcome& outcome) {
  if (!outcome.left_by_next || outcome.iterations == 0) return {};
  return "ended early, with a field of " + std::to_string(outcome.before_cancelling) +
         " critical points; the next iteration leaves " + std::to_string(*outcome.left_by_next);
}

void check_target(std::optional<std::size_t> target) {
  if (target && *target == 0)
    throw core::InvalidArgument("a target of 0 critical points cannot be reached: every field has a minimum");
}

TargetSearch::TargetSearch(const core::ScalarField& start, std::size_t wanted, bool cancels_pairs,
                           const core::Progress& progress)
    : start_(start),
      start_total_(morse::classify(start, progress).total()),
      wanted_(wanted),
      cancels_pairs_(cancels_pairs),
      progress_(progress),
      current_(start) {}

void TargetSearch::restart() {
  current_ = start_;
  total_ = 0;
  most_ = 0;
  iterations_ = 0;
  left_by_next_.reset();
}

bool TargetSearch::offer(const core::ScalarField& field) {
  if (!wants_more()) return false;
  const std::size_t total = morse::classify(field, progress_).total();
  if (total < wanted_ && total_ > wanted_) {
    left_by_next_ = total;
    return false;
  }
  current_ = field;
  total_ = total;
  most_ = std::max(most_, total);
  ++iterations_;
  return wants_more();
}

std::string TargetSearch::too_few() const {
  std::string text = "the method's own field has " + std::to_string(total_) +
                     " critical points, fewer than " + std::to_string(wanted_);
  if (most_ > total_) text += "; its iterations leave " + std::to_string(most_) + " at most";
  return text;
}

TargetSearch::Result TargetSearch::finish() const {
  const bool is_enough = total_ >= wanted_;
  const bool from_start = !is_enough && cancels_pairs_ && start_total_ >= wanted_;
  core::ScalarField smoothed = from_start ? start_ : current_;
  TargetOutcome outcome;
  outcome.wanted = wanted_;
  outcome.iterations = from_start ? 0 : iterations_;
  outcome.left_by_next = from_start ? total_ : left_by_next_;
  outcome.before_cancelling = from_start ? start_total_ : total_;
  outcome.reached = outcome.before_cancelling;
  core::ScalarField field = smoothed;
  std::string missed = too_few();
  if (is_enough || from_start) {
    persistence::CancellationOptions options;
    options.count = wanted_;
    persistence::CancellationResult cancelled = persistence::cancel(smoothed, options, progress_);
    outcome.reached = cancelled.reached_count;
    outcome.cancelled = std::move(cancelled.pairs);
    outcome.largest_cancelled = cancelled.largest_cancelled;
    field = std::move(cancelled.field);
    missed = std::move(cancelled.note);
    const long euler = smoothed.mesh().euler_characteristic();
    if ((euler - static_cast<long>(wanted_)) % 2 != 0)
      missed += "; with simple saddles totals are " + std::string(euler % 2 != 0 ? "odd" : "even") +
                " on this mesh, as is its Euler characteristic";
  }
  unfold(field, outcome);
  if (outcome.reached != wanted_) {
    outcome.note = std::move(missed);
    if (!outcome.unfolded.empty())
      outcome.note += "; with " + std::to_string(outcome.unfolded.size()) +
                      " multiple saddles unfolded there are " + std::to_string(outcome.reached);
  }
  return {std::move(smoothed), std::move(field), std::move(outcome)};
}

}  // namespace morsel::tools
