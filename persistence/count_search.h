#pragma once
/// How many pairs to cancel for a wanted number of critical points. For the module's own use.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/canceller.h"

namespace morsel::persistence::detail {

/// Each pair removes an extremum and one of a saddle's multiplicity; whether a saddle vertex disappears with
/// it depends on where the multiple saddles of the cancelled field are, which is known only after cancelling.
/// So the search starts from an estimate and tries numbers of pairs around it.
class CountSearch {
 public:
  /// `wanted`: the number of critical points. Runs the search: 2²² / n tries, but at least 12, of O(n) each.
  CountSearch(const Canceller& canceller, std::size_t wanted, const core::Progress& progress);

  /// The pairs whose cancelling leaves the most critical points that are not above the wanted number,
  /// or else the fewest above; of several numbers with one result the smallest that was tried.
  std::span<const PersistencePair> cancelled() const { return diagram_.finite_pairs().first(best_); }
  std::size_t reached() const { return static_cast<std::size_t>(totals_.at(best_)); }
  const core::ScalarField& field() const { return *field_; }
  /// The largest persistence of a cancelled pair; 0 if there is none.
  double largest_cancelled() const { return best_ == 0 ? 0 : diagram_.pairs[best_ - 1].persistence(); }
  /// Why another number than the wanted one was reached; empty if it was reached.
  std::string note() const;

 private:
  std::size_t nearest_estimate(long off) const;
  long measure(std::size_t cancelled);
  bool is_nearer(std::size_t a, std::size_t b) const;
  bool is_done() const;

  const Canceller& canceller_;
  Diagram diagram_;  // with sorted pairs
  long wanted_;
  std::vector<long> estimate_;          // per number of cancelled pairs, strictly falling
  std::map<std::size_t, long> totals_;  // counted, per number of cancelled pairs
  long smallest_off_ = 0;               // of counted minus estimated totals
  long largest_off_ = 0;
  std::size_t best_ = 0;
  std::optional<core::ScalarField> field_;  // of best_
  std::size_t tries_left_;
};

}  // namespace morsel::persistence::detail
