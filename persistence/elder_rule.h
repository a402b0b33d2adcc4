#pragma once
/// The elder rule (Edelsbrunner, Letscher, Zomorodian 2002): where two components of a union-find sweep
/// meet, the one with the younger extremum ends. Also the order in which cancellation takes the resulting
/// pairs.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/radix_sort.h"
#include "morsel/core/parallel/union_find.h"
#include "morsel/core/types.h"

namespace morsel::persistence {

using core::Index;

/// Two basins that meet at a saddle, if nothing joined them before. Basins are numbered by the age of their
/// extrema, from the eldest: minima by ascending rank, maxima and caps in the order of tops_by_age().
struct Merge {
  Index saddle;
  Index a;
  Index b;
};

/// A basin that ends at a saddle, where its component meets an elder one.
struct Death {
  Index basin;
  Index saddle;
};

/// The extrema of a sweep from above, from the eldest: the caps, which lie above every vertex, from that of
/// the last loop to that of the first, which is `first_cap`; then the maxima, given by ascending rank.
inline std::vector<Index> tops_by_age(std::span<const Index> maxima, Index first_cap, Index cap_count) {
  std::vector<Index> tops;
  tops.reserve(cap_count + maxima.size());
  for (Index cap = cap_count; cap-- > 0;) tops.push_back(first_cap + cap);
  tops.insert(tops.end(), maxima.rbegin(), maxima.rend());
  return tops;
}

/// Of merges in the order of the sweep, keeps those that join components, as merges of the eldest basins of
/// these; returns the deaths, in the order of the sweep, at one vertex the youngest first.
/// is_same_vertex(saddle, other) returns whether two saddles of merges are at one vertex. O(s α(s)).
template <class IsSameVertex>
std::vector<Death> apply_elder_rule(Index basins, std::vector<Merge>& merges,
                                    const IsSameVertex& is_same_vertex) {
  core::UnionFind components(basins);  // roots are the eldest
  std::size_t kept = 0;
  std::vector<Death> deaths;
  for (const Merge& merge : merges) {
    const Index a = components.find(merge.a);
    const Index b = components.find(merge.b);
    if (a == b) continue;
    components.unite(a, b);
    merges[kept++] = {merge.saddle, a, b};
    deaths.push_back({std::max(a, b), merge.saddle});
    for (std::size_t i = deaths.size() - 1;
         i > 0 && deaths[i - 1].basin < deaths[i].basin && is_same_vertex(deaths[i - 1].saddle, merge.saddle);
         --i)
      std::swap(deaths[i - 1], deaths[i]);
  }
  merges.resize(kept);
  merges.shrink_to_fit();
  return deaths;
}

/// Sorts pairs, those of minima before those of maxima and each in the order of apply_elder_rule(), into the
/// order in which cancellation takes them: by ascending persistence, stably. O(s).
template <class Pair, class Persistence>
void sort_by_persistence(std::span<Pair> pairs, const Persistence& persistence_of) {
  struct Key {
    std::uint64_t persistence;  // the bits of numbers of at least 0, which are ordered as the numbers
    Index position;
  };
  core::FlatArray<Key> keys(pairs.size());
  core::parallel_for_each(keys.size(), [&](std::size_t i) {
    const double persistence = persistence_of(pairs[i]) + 0.0;  // no −0
    keys[i] = {std::bit_cast<std::uint64_t>(persistence), static_cast<Index>(i)};
  });
  core::radix_sort(keys, 64, [](const Key& key) { return key.persistence; });
  const std::vector<Pair> given(pairs.begin(), pairs.end());
  core::parallel_for_each(keys.size(), [&](std::size_t i) { pairs[i] = given[keys[i].position]; });
}

}  // namespace morsel::persistence
