#include "morsel/persistence/cancellation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/link.h"
#include "morsel/core/parallel.h"
#include "morsel/persistence/pairing.h"
#include "morsel/persistence/plateaus.h"
#include "morsel/persistence/sweep.h"

namespace morsel::persistence {
namespace {

using core::kNone;
using core::ScalarField;
using detail::Direction;
using detail::Role;
using detail::Sweep;

/// Minima, saddle vertices and maxima.
std::size_t critical_count(const ScalarField& field) {
  const auto rank = field.ranks();
  return core::parallel_reduce(
      0, rank.size(), core::kGrain, std::size_t{0},
      [&](std::size_t first, std::size_t last) {
        std::size_t count = 0;
        for (auto v = static_cast<Index>(first); v < last; ++v) {
          const core::LinkPart lower = core::link_part(
              field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return rank[u] < rank[v]; },
              [](Index) {});
          if (lower.runs != 1) ++count;  // none: an extremum; several: a saddle
        }
        return count;
      },
      [](std::size_t sum, std::size_t part) { return sum + part; });
}

/// Cancels any number of pairs of one field.
///
/// Values are handled as levels: 0, 1, … for the distinct values of f in ascending order. Flooding and
/// carving only ever give a vertex the value of another.
class Canceller {
 public:
  Canceller(const ScalarField& f, const core::Progress& progress)
      : f_(f),
        mesh_(f.mesh()),
        progress_(progress),
        up_(detail::sweep(mesh_, f.ranks(), Direction::up, progress)),
        down_(detail::sweep(mesh_, f.ranks(), Direction::down, progress)),
        diagram_(detail::pair_sweeps(f, up_, down_)),
        level_(mesh_.vertex_count()) {
    for (const Index v : f.order()) {
      if (value_of_level_.empty() || value_of_level_.back() < f.value(v))
        value_of_level_.push_back(f.value(v));
      level_[v] = static_cast<Index>(value_of_level_.size() - 1);
    }
  }

  const Diagram& diagram() const { return diagram_; }

  /// The field without the first `cancelled` pairs of the diagram.
  ScalarField run(std::size_t cancelled) const {
    if (cancelled == 0) return f_;
    progress_.throw_if_cancelled();
    const std::vector<Role> roles = survivors(cancelled);
    std::vector<Index> level = level_;
    // Flooding leaves f's down sweep valid only if it changes nothing.
    if (flood(roles, level)) {
      std::vector<Index> offsets;
      const std::vector<Index> order = detail::sort_by_level(f_, level, level_count(), offsets);
      std::vector<Index> rank(order.size());
      for (Index i = 0; i < order.size(); ++i) rank[order[i]] = i;
      carve(detail::sweep(mesh_, rank, Direction::down, progress_), roles, level);
    } else {
      carve(down_, roles, level);
    }
    progress_.throw_if_cancelled();
    std::vector<Index> rank = detail::order_plateaus(f_, level, level_count(), roles);
    std::vector<double> values(f_.values().begin(), f_.values().end());
    for (Index v = 0; v < values.size(); ++v)
      if (level[v] != level_[v]) values[v] = value_of_level_[level[v]];
    return {mesh_, std::move(values), std::move(rank)};
  }

 private:
  Index level_count() const { return static_cast<Index>(value_of_level_.size()); }

  std::vector<Role> survivors(std::size_t cancelled) const {
    std::vector<Role> roles(mesh_.vertex_count(), Role::regular);
    for (const EssentialExtrema& extrema : diagram_.essential_extrema) {
      roles[extrema.minimum] = Role::minimum;
      if (!extrema.top_is_cap) roles[extrema.top] = Role::maximum;
    }
    for (const PersistencePair& pair : diagram_.finite_pairs().subspan(cancelled))
      roles[pair.extremum] = pair.kind == PairKind::minimum_saddle ? Role::minimum : Role::maximum;
    return roles;
  }

  /// Raises the basins of the minima that go; returns whether any vertex changed.
  bool flood(const std::vector<Role>& roles, std::vector<Index>& level) const {
    std::vector<bool> kept(up_.basin_count());
    for (Index b = 0; b < up_.basin_count(); ++b) kept[b] = roles[up_.extremum[b]] == Role::minimum;
    const std::vector<Index> overflow = detail::overflow_saddles(up_, kept);
    bool changed = false;
    for (Index v = 0; v < level.size(); ++v) {
      const Index saddle = overflow[up_.basin[v]];
      if (saddle == kNone || level[v] >= level_[saddle]) continue;
      level[v] = level_[saddle];
      changed = true;
    }
    return changed;
  }

  /// Lowers the basins of the maxima that go; `down` is a sweep over `level`.
  void carve(const Sweep& down, const std::vector<Role>& roles, std::vector<Index>& level) const {
    std::vector<bool> kept(down.basin_count());
    for (Index b = 0; b < down.basin_count(); ++b)
      kept[b] = down.is_cap(b) || roles[down.extremum[b]] == Role::maximum;
    const std::vector<Index> overflow = detail::overflow_saddles(down, kept);
    // Saddles may be carved themselves: their levels are read before.
    std::vector<Index> bottom(overflow.size(), level_count());
    for (Index b = 0; b < down.basin_count(); ++b)
      if (overflow[b] != kNone) bottom[b] = level[overflow[b]];
    for (Index v = 0; v < level.size(); ++v) level[v] = std::min(level[v], bottom[down.basin[v]]);
  }

  const ScalarField& f_;
  const core::TriangleMesh& mesh_;
  const core::Progress& progress_;
  Sweep up_;
  Sweep down_;
  Diagram diagram_;
  std::vector<Index> level_;            // per vertex, of f
  std::vector<double> value_of_level_;  // ascending
};

/// Finds the number of pairs to cancel for a wanted number of critical points.
class CountSearch {
 public:
  CountSearch(const Canceller& canceller, std::size_t wanted, std::size_t vertices)
      : canceller_(canceller),
        wanted_(static_cast<long>(wanted)),
        estimate_(estimates(canceller.diagram())),
        // A try costs O(n): small meshes can afford to try everything.
        tries_left_(std::max<std::size_t>(24, (std::size_t{1} << 22) / vertices)) {}

  /// Returns the number of pairs to cancel.
  std::size_t run(const core::Progress& progress) {
    // Follow the estimate, corrected by how far the last one was off, until it stays where it is.
    for (std::size_t k = nearest_estimate(0); !done() && !totals_.contains(k);) {
      progress.update("cancelling to a count", 0.5);
      k = nearest_estimate(measure(k) - estimate_[k]);
    }
    // Then outwards from there, as long as the correction that would be needed is of the size of those seen.
    const std::size_t center = best_;
    for (std::size_t step = 1; !done(); ++step) {
      bool promising = false;
      for (const std::size_t k : {center - step, center + step}) {
        if (k >= estimate_.size()) continue;  // also what wrapped below 0
        const long needed = wanted_ - estimate_[k];
        if (needed < smallest_off_ - slack() || needed > largest_off_ + slack()) continue;
        promising = true;
        if (!done() && !totals_.contains(k)) {
          progress.update("cancelling to a count", 0.5);
          measure(k);
        }
      }
      if (!promising) break;
    }
    return best_;
  }

  std::size_t reached() const { return static_cast<std::size_t>(totals_.at(best_)); }

  std::string note() const {
    if (totals_.at(best_) == wanted_) return {};
    std::string text = "no number of cancelled pairs was found that leaves " + std::to_string(wanted_) +
                       " critical points: ";
    const auto below = totals_.find(best_ + 1);
    const auto above = best_ == 0 ? totals_.end() : totals_.find(best_ - 1);
    const auto outcome = [](const auto& entry) {
      return std::to_string(entry->first) + " leave " + std::to_string(entry->second);
    };
    text += outcome(totals_.find(best_));
    if (above != totals_.end()) text += ", " + outcome(above);
    if (below != totals_.end()) text += ", " + outcome(below);
    if (best_ == 0 && wanted_ > totals_.at(best_)) text += ", and cancelling adds none";
    if (best_ + 1 == estimate_.size() && wanted_ < totals_.at(best_))
      text += ", and what is left is essential or paired with a boundary";
    return text;
  }

 private:
  /// Critical points after cancelling 0, 1, … pairs if every saddle stayed where it is: it counts as long as
  /// a pair or an essential class is left of its multiplicity. Exact for 0; falls with every pair.
  static std::vector<long> estimates(const Diagram& diagram) {
    const auto pairs = diagram.finite_pairs();
    std::vector<Index> saddles;
    for (const PersistencePair& pair : diagram.cap_pairs()) saddles.push_back(pair.saddle);
    for (const EssentialSaddle& saddle : diagram.essential_saddles) saddles.push_back(saddle.vertex);
    Index last = 0;
    for (const PersistencePair& pair : diagram.pairs) last = std::max(last, pair.saddle);
    for (const Index v : saddles) last = std::max(last, v);
    std::vector<bool> seen(std::size_t{last} + 1, false);
    long total = 0;
    const auto add_saddle = [&](Index v) {
      total += seen[v] ? 0 : 1;
      seen[v] = true;
    };
    for (const Index v : saddles) add_saddle(v);
    for (const EssentialExtrema& extrema : diagram.essential_extrema) total += extrema.top_is_cap ? 1 : 2;
    std::vector<long> result(pairs.size() + 1);
    result[pairs.size()] = total;
    for (std::size_t k = pairs.size(); k-- > 0;) {
      add_saddle(pairs[k].saddle);
      result[k] = ++total;  // the extremum
    }
    return result;
  }

  /// The number of pairs whose estimate, off by `off`, comes closest to what is wanted.
  std::size_t nearest_estimate(long off) const {
    const auto above_or_at = [&](long estimate) { return estimate + off > wanted_; };
    const auto first_not_above = std::partition_point(estimate_.begin(), estimate_.end(), above_or_at);
    if (first_not_above == estimate_.end()) return estimate_.size() - 1;
    const auto k = static_cast<std::size_t>(first_not_above - estimate_.begin());
    if (k > 0 && estimate_[k - 1] + off - wanted_ < wanted_ - estimate_[k] - off) return k - 1;
    return k;
  }

  long measure(std::size_t k) {
    const auto total = static_cast<long>(critical_count(canceller_.run(k)));
    totals_[k] = total;
    smallest_off_ = std::min(smallest_off_, total - estimate_[k]);
    largest_off_ = std::max(largest_off_, total - estimate_[k]);
    if (totals_.size() == 1 || is_nearer(k, best_)) best_ = k;
    if (tries_left_ > 0) --tries_left_;
    return total;
  }

  /// Nearer to what is wanted; of two equally near numbers the lower; for one number, fewer cancelled pairs.
  bool is_nearer(std::size_t a, std::size_t b) const {
    const long distance_a = std::abs(totals_.at(a) - wanted_);
    const long distance_b = std::abs(totals_.at(b) - wanted_);
    if (distance_a != distance_b) return distance_a < distance_b;
    if (totals_.at(a) != totals_.at(b)) return totals_.at(a) < totals_.at(b);
    return a < b;
  }

  bool done() const { return tries_left_ == 0 || (!totals_.empty() && totals_.at(best_) == wanted_); }
  long slack() const { return 2 + largest_off_ - smallest_off_; }

  const Canceller& canceller_;
  long wanted_;
  std::vector<long> estimate_;          // per number of cancelled pairs
  std::map<std::size_t, long> totals_;  // what was measured
  long smallest_off_ = 0;               // of measured less estimated totals
  long largest_off_ = 0;
  std::size_t best_ = 0;
  std::size_t tries_left_;
};

}  // namespace

CancellationResult cancel(const ScalarField& f, const CancellationOptions& options,
                          const core::Progress& progress) {
  const double threshold = options.threshold.on(f);
  if (options.count == std::size_t{0})
    throw core::InvalidArgument("the number of critical points to cancel down to must be at least 1, not 0");
  progress.update("persistence pairs", 0);
  const Canceller canceller(f, progress);
  const Diagram& diagram = canceller.diagram();
  progress.update("cancellation", 0.5);
  std::size_t cancelled = diagram.finite_count - diagram.count_above(threshold);
  std::string note;
  if (options.count) {
    CountSearch search(canceller, *options.count, f.mesh().vertex_count());
    cancelled = search.run(progress);
    note = search.note();
  }
  CancellationResult result{canceller.run(cancelled), cancelled, 0, 0, std::move(note)};
  if (cancelled > 0) result.largest_cancelled = diagram.pairs[cancelled - 1].persistence();
  result.reached_count = critical_count(result.field);
  progress.update("cancellation", 1);
  return result;
}

}  // namespace morsel::persistence
