#include "morsel/tools/study/target.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/smoothing/keep_order.h"
#include "morsel/morse/unfolding.h"
#include "morsel/persistence/cancellation.h"

namespace morsel::tools {
namespace {

constexpr int kHalvings = 12;
constexpr double kLeastRemainder = -40;  // as a power of two

core::ScalarField blended(const core::ScalarField& from, const core::ScalarField& to, double share) {
  if (share == 0) return from;
  if (share == 1) return to;
  std::vector<double> values(from.values().size());
  core::parallel_for_each(
      values.size(), [&](std::size_t v) { values[v] = std::lerp(from.values()[v], to.values()[v], share); });
  return morse::keep_order(from, std::move(values));
}

/// Unfolds multiple saddles of `field` until the wanted number is reached or none is left.
void unfold(core::ScalarField& field, TargetOutcome& outcome) {
  std::vector<std::pair<double, core::Index>> saddles;  // by the change they need
  if (outcome.reached < outcome.wanted)
    for (const morse::CriticalPoint& point : morse::classify(field).points)
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

void check_target(std::optional<std::size_t> target) {
  if (target && *target == 0)
    throw core::InvalidArgument("a target of 0 critical points cannot be reached: every field has a minimum");
}

TargetSearch::TargetSearch(const core::ScalarField& start, std::size_t wanted, bool blends,
                           const core::Progress& progress)
    : start_(start), wanted_(wanted), blends_(blends), progress_(progress), reached_(start) {
  restart();
}

void TargetSearch::restart() {
  reached_ = start_;
  beyond_.reset();
  total_ = morse::classify(start_, progress_).total();
  iterations_ = 0;
}

bool TargetSearch::offer(const core::ScalarField& field) {
  if (!wants_more()) return false;
  const std::size_t total = morse::classify(field, progress_).total();
  if (total < wanted_) {
    beyond_ = field;
    return false;
  }
  reached_ = field;
  total_ = total;
  ++iterations_;
  return wants_more();
}

/// The largest share found that leaves enough critical points.
double TargetSearch::furthest_blend() const {
  // The logarithm of the remaining share of the field before is halved: a little noise makes many critical
  // points.
  double enough = 0;
  double too_few = kLeastRemainder;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (enough + too_few) / 2;
    const core::ScalarField field = blended(reached_, *beyond_, 1 - std::exp2(middle));
    (morse::classify(field, progress_).total() >= wanted_ ? enough : too_few) = middle;
  }
  return 1 - std::exp2(enough);
}

TargetSearch::Result TargetSearch::finish() const {
  const bool blends = beyond_ && blends_ && total_ > wanted_;
  const double share = blends ? furthest_blend() : 0;
  core::ScalarField smoothed = blends ? blended(reached_, *beyond_, share) : reached_;
  persistence::CancellationOptions options;
  options.count = wanted_;
  persistence::CancellationResult cancelled = persistence::cancel(smoothed, options, progress_);
  TargetOutcome outcome;
  outcome.wanted = wanted_;
  outcome.reached = cancelled.reached_count;
  outcome.iterations = iterations_;
  outcome.blend = share;
  outcome.before_cancelling = blends ? morse::classify(smoothed, progress_).total() : total_;
  outcome.cancelled = std::move(cancelled.pairs);
  outcome.largest_cancelled = cancelled.largest_cancelled;
  unfold(cancelled.field, outcome);
  if (outcome.reached != wanted_) {
    outcome.note = std::move(cancelled.note);
    const long euler = smoothed.mesh().euler_characteristic();
    if ((euler - static_cast<long>(wanted_)) % 2 != 0)
      outcome.note += "; with simple saddles totals are " + std::string(euler % 2 != 0 ? "odd" : "even") +
                      " on this mesh, as is its Euler characteristic";
  }
  return {std::move(smoothed), std::move(cancelled.field), std::move(outcome)};
}

}  // namespace morsel::tools
