#pragma once
/// Disjoint sets that remember every state they were in.

#include <cstddef>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// Elements 0 … n − 1, of which one after the other is taken over by another; who speaks for an element after
/// the first `level` take-overs is told for any level, in O(log n), without going there. Union by size, so
/// that ways up are short; links and changes of speaker carry the level at which they came ("partially
/// persistent union-find"). Memory: 16 bytes an element and 8 a take-over. Filled once; then safe to read
/// from any number of threads.
class MergeHistory {
 public:
  explicit MergeHistory(core::Index elements);

  /// The next take-over: what `gone` speaks for is from now on spoken for by `survivor`. Both must speak for
  /// themselves now, and differ.
  void take_over(core::Index gone, core::Index survivor);
  /// After the last take_over(), before speaker() of the past is asked.
  void finish();

  core::Index levels() const { return levels_; }
  /// Who speaks for `element` after the first `level` take-overs.
  core::Index speaker(core::Index element, core::Index level) const;
  /// Who speaks for `element` now; also before finish().
  core::Index speaker_now(core::Index element) const { return current_[root(element, levels_)]; }

 private:
  struct Change {
    core::Index root;
    core::Index level;
    core::Index speaker;
  };
  core::Index root(core::Index element, core::Index level) const;

  core::Index levels_ = 0;
  std::vector<core::Index> parent_;      // kNone at roots
  std::vector<core::Index> link_level_;  // the take-over that linked an element to its parent
  std::vector<core::Index> size_;        // while filling
  std::vector<core::Index> current_;     // per root: who speaks now
  std::vector<Change> changes_;          // by root, then by level, once finished
  std::vector<core::Index> first_;       // per element, and one: where its changes begin
};

}  // namespace morsel::mscomplex
