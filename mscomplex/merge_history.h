#pragma once
/// Disjoint sets with all their past states: a partially persistent union-find.

#include <cstddef>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// Disjoint sets of the elements 0 … n − 1 under a sequence of unions; representative() returns the
/// representative of an element after the first `level` unions, for any level, in O(log n). Union by size, so
/// that paths to roots are short; links and changes of representative carry their level ("partially
/// persistent union-find"). Memory: 16 bytes an element and 8 a union. Filled once; then safe to read from
/// any number of threads.
class MergeHistory {
 public:
  explicit MergeHistory(core::Index elements);

  /// The next union: of the sets of two different representatives; that of both is now `survivor`.
  void unite(core::Index gone, core::Index survivor);
  /// To be called after the last unite() and before representative().
  void finish();

  core::Index levels() const { return levels_; }
  /// The representative of `element` after the first `level` unions.
  core::Index representative(core::Index element, core::Index level) const;
  /// The representative of `element` now; also before finish().
  core::Index current_representative(core::Index element) const { return current_[root(element, levels_)]; }

 private:
  struct Change {
    core::Index root;
    core::Index level;
    core::Index representative;
  };
  core::Index root(core::Index element, core::Index level) const;

  core::Index levels_ = 0;
  std::vector<core::Index> parent_;      // kNone at roots
  std::vector<core::Index> link_level_;  // the union that linked an element to its parent
  std::vector<core::Index> size_;        // while filling
  std::vector<core::Index> current_;     // per root: the representative now
  std::vector<Change> changes_;          // by root, then by level, once finished
  std::vector<core::Index> first_;       // per element, and the end: where its changes begin
};

}  // namespace morsel::mscomplex
