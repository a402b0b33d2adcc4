#pragma once
/// Disjoint sets (Tarjan 1975), with path halving.

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

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
  /// Returns whether they were apart.
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
    while (parent_[a] != a) {  // compress
      const Index up = parent_[a];
      const bool step = odd_[a];
      parent_[a] = root;
      odd_[a] = odd;
      odd ^= step;
      a = up;
    }
    return {root, result};
  }
  /// Says that a and b have different (or equal) parities; returns false if that contradicts what is known.
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
