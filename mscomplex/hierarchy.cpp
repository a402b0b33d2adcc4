#include "morsel/mscomplex/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/union_find.h"
#include "morsel/core/require.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

/// A saddle and the extremum that ends at it in one of the two sweeps.
struct Pair {
  double persistence;
  Index sweep;     // 0 up, 1 down
  Index time;      // of the saddle's vertex in that sweep
  Index youth;     // of the extremum: the smaller, the younger
  Index saddle;    // number, not node
  Index extremum;  // node
  auto key() const { return std::tuple(persistence, sweep, time, youth); }
};

/// Extrema by age: `order[a]` is the a-th eldest, and `age` the other way round.
struct Ages {
  explicit Ages(std::vector<Index> eldest_first) : order(std::move(eldest_first)), age(order.size()) {
    for (std::size_t a = 0; a < order.size(); ++a) age[order[a]] = static_cast<Index>(a);
  }
  std::vector<Index> order;
  std::vector<Index> age;
};

}  // namespace

PersistenceHierarchy::PersistenceHierarchy(const core::ScalarField& field, MorseSmaleComplex complex,
                                           const core::Progress& progress)
    : complex_(std::move(complex)), history_(complex_.node_count() - complex_.saddle_count()) {
  if (!complex_.mesh().is_same(field.mesh()))
    throw core::InvalidArgument("the complex is on another mesh than the field: compute it from this field");
  progress.update("hierarchy", 0);
  pair_up(field);
  progress.update("hierarchy", 0.5);
  cancel_all();
  progress.update("hierarchy", 1);
}

/// The elder rule (Edelsbrunner, Letscher, Zomorodian 2002) on the complex alone: its minima and descending
/// arcs are as connected below any saddle as the sublevel set is, and so are tops and ascending arcs from
/// above.
void PersistenceHierarchy::pair_up(const core::ScalarField& field) {
  const auto rank = field.ranks();
  const auto saddles = complex_.gradient().saddles();
  const Index minima = complex_.minimum_count();
  const Index tops = complex_.maximum_count() + complex_.cap_count();
  const Index first_top = complex_.maximum_node(0);
  const auto rank_of = [&](Index node) { return rank[complex_.node(node).vertex]; };

  std::vector<Index> by_rank(saddles.size());
  std::iota(by_rank.begin(), by_rank.end(), Index{0});
  std::sort(by_rank.begin(), by_rank.end(), [&](Index a, Index b) {
    return std::pair(rank[saddles[a].vertex], a) < std::pair(rank[saddles[b].vertex], b);
  });
  std::vector<Index> lowest_first(minima);
  std::iota(lowest_first.begin(), lowest_first.end(), Index{0});
  std::sort(lowest_first.begin(), lowest_first.end(),
            [&](Index a, Index b) { return rank_of(a) < rank_of(b); });
  std::vector<Index> highest_first(tops);  // caps lie above all maxima, later ones above earlier ones
  std::iota(highest_first.begin(), highest_first.end(), Index{0});
  std::sort(highest_first.begin(), highest_first.end(), [&](Index a, Index b) {
    const auto height = [&](Index top) {
      return top < complex_.maximum_count() ? std::uint64_t{rank_of(first_top + top)}
                                            : (std::uint64_t{1} << 32) + top;
    };
    return height(a) > height(b);
  });

  std::vector<Pair> pairs;
  const auto sweep = [&](Index kind, const std::vector<Index>& order, const Ages& ages, Index first_node,
                         auto&& time_of) {
    core::UnionFind sets(static_cast<Index>(ages.order.size()));
    for (const Index s : order) {
      const Index a = sets.find(ages.age[complex_.arc_end(4 * s + kind) - first_node]);
      const Index b = sets.find(ages.age[complex_.arc_end(4 * s + 2 + kind) - first_node]);
      if (!sets.unite(a, b)) continue;
      const Index younger = std::max(a, b);
      const Index node = first_node + ages.order[younger];
      if (complex_.kind(node) == NodeKind::cap) continue;  // at infinite persistence
      const double persistence =
          std::abs(field.value(saddles[s].vertex) - field.value(complex_.node(node).vertex));
      pairs.push_back({persistence, kind, time_of(rank[saddles[s].vertex]), ~younger, s, node});
    }
  };
  sweep(0, by_rank, Ages(std::move(lowest_first)), 0, [](Index r) { return r; });
  std::reverse(by_rank.begin(), by_rank.end());
  sweep(1, by_rank, Ages(std::move(highest_first)), first_top, [](Index r) { return ~r; });
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.key() < b.key(); });
  cancellations_.reserve(pairs.size());
  for (const Pair& pair : pairs)
    cancellations_.push_back({4 * pair.saddle + pair.sweep, pair.extremum, kNone, pair.persistence});
}

/// Finds at which side of its saddle each extremum is when its turn comes, and who is at the other one.
void PersistenceHierarchy::cancel_all() {
  gone_.assign(complex_.node_count(), kNone);
  cancelled_minima_.assign(1, 0);
  cancelled_minima_.reserve(cancellations_.size() + 1);
  Index level = 0;
  for (Cancellation& c : cancellations_) {
    const auto end = [&](Index arc) {
      return node_of(history_.speaker_now(extremum_of(complex_.arc_end(arc))));
    };
    Index other = c.arc + 2;
    if (end(c.arc) != c.extremum) std::swap(c.arc, other);
    c.survivor = end(other);
    history_.take_over(extremum_of(c.extremum), extremum_of(c.survivor));
    ++level;
    gone_[c.extremum] = level;
    gone_[saddle_of(c)] = level;
    cancelled_minima_.push_back(cancelled_minima_.back() +
                                (complex_.kind(c.extremum) == NodeKind::minimum ? 1 : 0));
  }
  history_.finish();
}

Index PersistenceHierarchy::level_above(double threshold) const {
  const auto above = std::partition_point(cancellations_.begin(), cancellations_.end(),
                                          [&](const Cancellation& c) { return c.persistence <= threshold; });
  return static_cast<Index>(above - cancellations_.begin());
}

Index PersistenceHierarchy::level_with(std::size_t count) const {
  const std::size_t all = complex_.node_count() - complex_.cap_count();
  if (all <= count) return 0;
  return static_cast<Index>(std::min<std::size_t>((all - count + 1) / 2, levels()));
}

/// By bisection: holds(level) must not cease to hold further on. The last level if it holds nowhere.
template <class Holds>
Index PersistenceHierarchy::first_level_where(const Holds& holds) const {
  Index low = 0;
  Index high = levels();
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (holds(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

Index PersistenceHierarchy::level_with_minima(Index count) const {
  return first_level_where([&](Index level) { return minimum_count(level) <= count; });
}

Index PersistenceHierarchy::level_with_maxima(Index count) const {
  return first_level_where([&](Index level) { return maximum_count(level) <= count; });
}

DiscreteGradient PersistenceHierarchy::gradient(Index level) const {
  std::vector<Index> arcs;
  arcs.reserve(level);
  for (Index i = 0; i < level; ++i) arcs.push_back(cancellations_[i].arc);
  return complex_.gradient().with_reversed(arcs);
}

void PersistenceHierarchy::validate() const {
  constexpr core::Require require("PersistenceHierarchy::validate");
  std::vector<Index> end(complex_.arc_count());
  for (Index a = 0; a < complex_.arc_count(); ++a) end[a] = complex_.arc_end(a);
  for (Index level = 0;; ++level) {
    for (Index a = 0; a < complex_.arc_count(); ++a)
      if (is_alive(complex_.arc_saddle(a), level))
        require(end[a] == arc_end(a, level), "end of an arc that is alive, arc", a);
    Index alive = 0;
    for (Index n = 0; n < complex_.node_count(); ++n) alive += is_alive(n, level) ? 1 : 0;
    require(alive == minimum_count(level) + saddle_count(level) + maximum_count(level) + complex_.cap_count(),
            "number of nodes at level", level);
    if (level == levels()) break;
    const Cancellation& c = cancellations_[level];
    require(level == 0 || cancellations_[level - 1].persistence <= c.persistence, "order of persistence at",
            level);
    require(is_alive(saddle_of(c), level) && is_alive(c.extremum, level) && is_alive(c.survivor, level),
            "cancels what is gone, at level", level);
    require(complex_.kind(c.extremum) != NodeKind::cap, "cancels a cap at level", level);
    const Index other = c.arc % 4 < 2 ? c.arc + 2 : c.arc - 2;
    require(end[c.arc] == c.extremum && end[other] == c.survivor && c.extremum != c.survivor,
            "ends of the arcs that are cancelled at level", level);
    for (Index& e : end)
      if (e == c.extremum) e = c.survivor;
  }
}

}  // namespace morsel::mscomplex
