#include "morsel/mscomplex/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/require.h"
#include "morsel/persistence/elder_rule.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

/// The `count` numbers from `first` on, by ascending ranks; of equal ones the smaller first.
template <class RankOf>
std::vector<Index> by_rank(Index first, Index count, const RankOf& rank_of) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), first);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::pair(rank_of(a), a) < std::pair(rank_of(b), b); });
  return order;
}

/// The inverse of a permutation of consecutive nodes, numbered from `first`, by offset from it.
std::vector<Index> places(std::span<const Index> nodes, Index first) {
  std::vector<Index> place(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i] - first] = static_cast<Index>(i);
  return place;
}

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

/// The elder rule on the complex alone, not the pairs of persistence::pair_extrema(), since these do not
/// distinguish the saddles at one vertex: minima and descending arcs are as connected below any saddle
/// as the sublevel set is, and so are tops and ascending arcs from above.
void PersistenceHierarchy::pair_up(const core::ScalarField& field) {
  const auto saddles = complex_.gradient().saddles();
  const auto node_vertex = [&](Index node) { return complex_.node(node).vertex; };
  const auto node_rank = [&](Index node) { return field.rank(node_vertex(node)); };
  const auto sweep = [&](Index kind, std::span<const Index> order, Index first,
                         std::span<const Index> by_age) {
    const std::vector<Index> age = places(by_age, first);
    std::vector<persistence::Merge> merges;
    merges.reserve(order.size());
    for (const Index s : order)
      merges.push_back(
          {s, age[complex_.arc_end(4 * s + kind) - first], age[complex_.arc_end(4 * s + 2 + kind) - first]});
    const auto is_same_vertex = [&](Index s, Index t) { return saddles[s].vertex == saddles[t].vertex; };
    for (const auto& [youngest, s] :
         persistence::apply_elder_rule(static_cast<Index>(age.size()), merges, is_same_vertex)) {
      const Index node = by_age[youngest];
      if (complex_.kind(node) == NodeKind::cap) continue;  // at infinite persistence
      const double difference = field.value(saddles[s].vertex) - field.value(node_vertex(node));
      cancellations_.push_back({4 * s + kind, node, kNone, std::abs(difference)});
    }
  };

  const Index first_top = complex_.maximum_node(0);
  std::vector<Index> order =
      by_rank(0, complex_.saddle_count(), [&](Index s) { return field.rank(saddles[s].vertex); });
  cancellations_.reserve(order.size());
  sweep(0, order, 0, by_rank(0, complex_.minimum_count(), node_rank));
  std::reverse(order.begin(), order.end());
  sweep(1, order, first_top,
        persistence::tops_by_age(by_rank(first_top, complex_.maximum_count(), node_rank),
                                 complex_.cap_node(0), complex_.cap_count()));
  persistence::sort_by_persistence(std::span(cancellations_),
                                   [](const Cancellation& c) { return c.persistence; });
}

/// Finds at which side of its saddle each extremum is when it is cancelled, and which one is at the other
/// side.
void PersistenceHierarchy::cancel_all() {
  gone_.assign(complex_.node_count(), kNone);
  cancelled_minima_.assign(1, 0);
  cancelled_minima_.reserve(cancellations_.size() + 1);
  Index level = 0;
  for (Cancellation& c : cancellations_) {
    const auto end = [&](Index arc) {
      return node_of(history_.current_representative(extremum_of(complex_.arc_end(arc))));
    };
    Index other = c.arc + 2;
    if (end(c.arc) != c.extremum) std::swap(c.arc, other);
    c.survivor = end(other);
    history_.unite(extremum_of(c.extremum), extremum_of(c.survivor));
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

/// By bisection: holds(level) must be monotonic: once true it stays true. The last level if it never holds.
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
