#include "morsel/mscomplex/merge_history.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

MergeHistory::MergeHistory(Index elements)
    : parent_(elements, kNone), link_level_(elements, kNone), size_(elements, 1), current_(elements) {
  std::iota(current_.begin(), current_.end(), Index{0});
}

Index MergeHistory::root(Index element, Index level) const {
  while (link_level_[element] < level) element = parent_[element];  // kNone, at roots, is above every level
  return element;
}

void MergeHistory::unite(Index gone, Index survivor) {
  Index below = root(gone, levels_);
  Index above = root(survivor, levels_);
  if (size_[below] > size_[above]) std::swap(below, above);
  parent_[below] = above;
  link_level_[below] = levels_;
  size_[above] += size_[below];
  if (current_[above] != survivor) changes_.push_back({above, levels_, survivor});
  current_[above] = survivor;
  ++levels_;
}

void MergeHistory::finish() {
  std::vector<Change> by_level = std::exchange(changes_, {});
  first_.assign(parent_.size() + 1, 0);
  for (const Change& change : by_level) ++first_[change.root + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  changes_.resize(by_level.size());
  std::vector<Index> place(first_.begin(), first_.end() - 1);
  for (const Change& change : by_level) changes_[place[change.root]++] = change;
  size_ = {};
}

Index MergeHistory::representative(Index element, Index level) const {
  const Index r = root(element, level);
  const auto begin = changes_.begin() + first_[r];
  const auto end = changes_.begin() + first_[r + 1];
  const auto later = std::partition_point(begin, end, [&](const Change& c) { return c.level < level; });
  return later == begin ? r : std::prev(later)->representative;
}

}  // namespace morsel::mscomplex
