#pragma once
/// Disjoint sets (Tarjan 1975), with path halving.

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// Disjoint sets of 0 … n − 1. The root of a set is its smallest element, so that results do not depend on
/// the order of unions; find is amortised O(log n).
class UnionFind {
 public:
  explicit UnionFind(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index a) {
    while (parent_[a] != a) {
      parent_[a] = parent_[parent_[a]];
      a = parent_[a];
    }
    return a;
  }
  /// Returns false if they are in the same set already.
  bool unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    return true;
  }

 private:
  std::vector<Index> parent_;
};

/// Disjoint sets that any number of threads may unite at a time, without locks (Jayanti, Tarjan 2016, linking
/// by index). The root of a set is its smallest element, so that the same sets and roots come out in any
/// order of unions.
class ConcurrentUnionFind {
 public:
  explicit ConcurrentUnionFind(Index n) : parent_(n) {
    parallel_for_each(n, [&](std::size_t i) { parent_[i] = static_cast<Index>(i); });
  }
  /// The root, or, with unions under way in other threads, what was the root at some time during the call.
  Index find(Index a) {
    for (;;) {
      const Index up = load(a);
      if (up == a) return a;
      const Index above = load(up);
      // Path halving may overwrite a shorter path that another thread stored; either parent is an ancestor.
      if (above != up) std::atomic_ref(parent_[a]).store(above, std::memory_order_relaxed);
      a = above;
    }
  }
  void unite(Index a, Index b) {
    if (load(a) == load(b)) return;  // most often, once sets are large
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (b < a) std::swap(a, b);
      Index root = b;  // links only a root, and only below a smaller one: no cycle can form
      if (std::atomic_ref(parent_[b]).compare_exchange_strong(root, a, std::memory_order_relaxed)) return;
    }
  }

 private:
  Index load(Index a) { return std::atomic_ref(parent_[a]).load(std::memory_order_relaxed); }
  FlatArray<Index> parent_;
};

/// Disjoint sets whose elements carry a parity relative to their root: for two-colourings such as
/// orientations.
class ParityUnionFind {
 public:
  explicit ParityUnionFind(Index n) : parent_(n), odd_(n, false) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The root and whether a's parity differs from the root's.
  std::pair<Index, bool> find(Index a) {
    Index root = a;
    bool odd = false;
    while (parent_[root] != root) {
      odd ^= odd_[root];
      root = parent_[root];
    }
    const bool result = odd;
    while (parent_[a] != a) {  // path compression
      const Index up = parent_[a];
      const bool step = odd_[a];
      parent_[a] = root;
      odd_[a] = odd;
      odd ^= step;
      a = up;
    }
    return {root, result};
  }
  /// Unites a and b with different (or equal) parities; returns false if that contradicts earlier unions.
  bool unite(Index a, Index b, bool different) {
    const auto [root_a, odd_a] = find(a);
    const auto [root_b, odd_b] = find(b);
    if (root_a == root_b) return (odd_a != odd_b) == different;
    const Index low = std::min(root_a, root_b);
    const Index high = std::max(root_a, root_b);
    parent_[high] = low;
    odd_[high] = (odd_a != odd_b) != different;
    return true;
  }

 private:
  std::vector<Index> parent_;
  std::vector<bool> odd_;
};

}  // namespace morsel::core
