#pragma once
/// Following pointers to their ends in linear time: used for arcs and for segments.

#include <atomic>
#include <span>

#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// Gives `start`, and everything on its way, the label at the way's end. `label` is kNone but at ends and
/// where a way was followed before; next(i) is the element after i. May run on many threads at once over one
/// `label`: what is written depends on the ways alone, and each thread writes an element at most once.
template <class Next>
core::Index follow(std::span<core::Index> label, core::Index start, const Next& next) {
  const auto at = [&](core::Index i) { return std::atomic_ref<core::Index>(label[i]); };
  core::Index i = start;
  core::Index found = at(i).load(std::memory_order_relaxed);
  while (found == core::kNone) {
    i = next(i);
    found = at(i).load(std::memory_order_relaxed);
  }
  const core::Index end = i;
  for (i = start; i != end && at(i).load(std::memory_order_relaxed) == core::kNone; i = next(i))
    at(i).store(found, std::memory_order_relaxed);
  return found;
}

}  // namespace morsel::mscomplex
