#include "morsel/persistence/count_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "morsel/core/field/classification.h"

namespace morsel::persistence::detail {
namespace {

/// Critical points after cancelling 0, 1, … pairs if every saddle stayed where it is: it counts as long as a
/// pair or an essential class is left of its multiplicity. Exact for 0 pairs.
std::vector<long> estimates(const Diagram& diagram, Index vertex_count) {
  std::vector<bool> seen(vertex_count, false);
  long total = 0;
  const auto add_saddle = [&](Index v) {
    total += seen[v] ? 0 : 1;
    seen[v] = true;
  };
  for (const PersistencePair& pair : diagram.cap_pairs()) add_saddle(pair.saddle);
  for (const EssentialSaddle& saddle : diagram.essential_saddles) add_saddle(saddle.vertex);
  for (const EssentialExtrema& extrema : diagram.essential_extrema) total += extrema.top_is_cap ? 1 : 2;
  const auto pairs = diagram.finite_pairs();
  std::vector<long> result(pairs.size() + 1);
  result[pairs.size()] = total;
  for (std::size_t k = pairs.size(); k-- > 0;) {
    add_saddle(pairs[k].saddle);
    result[k] = ++total;  // the extremum
  }
  return result;
}

Diagram sorted(Diagram diagram) {
  sort_pairs(diagram);
  return diagram;
}

}  // namespace

CountSearch::CountSearch(const Canceller& canceller, std::size_t wanted, const core::Progress& progress)
    : canceller_(canceller),
      diagram_(sorted(canceller.diagram())),
      wanted_(static_cast<long>(std::min<std::size_t>(wanted, std::numeric_limits<long>::max() / 2))),
      estimate_(estimates(diagram_, canceller.field().mesh().vertex_count())),
      tries_left_(
          std::max<std::size_t>(12, (std::size_t{1} << 22) / canceller.field().mesh().vertex_count())) {
  const auto all_tries = static_cast<double>(tries_left_);
  const auto tell = [&] {
    progress.update("cancelling to a count", 1 - static_cast<double>(tries_left_) / all_tries);
  };
  // Follow the estimate, corrected by how far the last one was off, until it stays where it is.
  for (std::size_t k = nearest_estimate(0); !is_done() && !totals_.contains(k);) {
    tell();
    k = nearest_estimate(measure(k) - estimate_[k]);
  }
  // Then search outwards from there, as long as the correction needed is within those observed.
  const std::size_t center = best_;
  for (std::size_t step = 1; !is_done(); ++step) {
    bool promising = false;
    for (const std::size_t k : {center - step, center + step}) {
      if (k >= estimate_.size()) continue;  // also where it wrapped below 0
      const long needed = wanted_ - estimate_[k];
      const long slack = 2 + largest_off_ - smallest_off_;
      if (needed < smallest_off_ - slack || needed > largest_off_ + slack) continue;
      promising = true;
      if (is_done() || totals_.contains(k)) continue;
      tell();
      measure(k);
    }
    if (!promising) break;
  }
}

std::string CountSearch::note() const {
  if (totals_.at(best_) == wanted_) return {};
  std::string text = "no number of cancelled pairs was found that leaves " + std::to_string(wanted_) +
                     " critical points: " + std::to_string(totals_.at(best_)) + " are left after " +
                     std::to_string(best_) + " pairs";
  for (const std::size_t k : {best_ - 1, best_ + 1})
    if (const auto entry = totals_.find(k); entry != totals_.end())
      text += ", " + std::to_string(entry->second) + " after " + std::to_string(k);
  if (best_ == 0 && wanted_ > totals_.at(best_)) text += "; cancelling adds none";
  if (best_ + 1 == estimate_.size() && wanted_ < totals_.at(best_))
    text += "; they are essential or paired with a boundary";
  return text;
}

/// The smallest number of pairs whose estimate, corrected by `off`, is not above the wanted number.
std::size_t CountSearch::nearest_estimate(long off) const {
  const auto first_not_above = std::partition_point(estimate_.begin(), estimate_.end(),
                                                    [&](long estimate) { return estimate + off > wanted_; });
  if (first_not_above == estimate_.end()) return estimate_.size() - 1;
  return static_cast<std::size_t>(first_not_above - estimate_.begin());
}

long CountSearch::measure(std::size_t cancelled) {
  core::ScalarField field = canceller_.run(diagram_.finite_pairs().subspan(cancelled));
  const auto total = static_cast<long>(core::critical_count(field));
  totals_[cancelled] = total;
  smallest_off_ = std::min(smallest_off_, total - estimate_[cancelled]);
  largest_off_ = std::max(largest_off_, total - estimate_[cancelled]);
  if (!field_ || is_nearer(cancelled, best_)) {
    best_ = cancelled;
    field_ = std::move(field);
  }
  --tries_left_;
  return total;
}

bool CountSearch::is_nearer(std::size_t a, std::size_t b) const {
  const long total_a = totals_.at(a);
  const long total_b = totals_.at(b);
  const bool low_a = total_a <= wanted_;
  if (low_a != (total_b <= wanted_)) return low_a;
  if (total_a != total_b) return low_a ? total_a > total_b : total_a < total_b;
  return a < b;
}

bool CountSearch::is_done() const {
  return tries_left_ == 0 || (!totals_.empty() && totals_.at(best_) == wanted_);
}

}  // namespace morsel::persistence::detail
