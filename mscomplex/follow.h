#pragma once
/// Path compression along pointers, in linear time: used for arcs and for segments.

#include <atomic>
#include <span>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// Gives `start`, and every element of its path, the label at the path's end, and returns it. `label` is
/// kNone except at ends and where a path was followed before; next(i) is the element after i. May run on many
/// threads at once over one `label`: what is written depends on the paths alone, and each thread writes an
/// element at most once.
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

/// Marks the label at a path's end for follow_all(). Labels and elements are below 2³¹: a mesh has fewer
/// cells.
inline constexpr core::Index kPathEnd = 0x8000'0000u;

/// Replaces each element of `path` by the label at its path's end. An element holds the next one on its path,
/// or its label and kPathEnd. O(n), parallel, the same for every number of threads; a single load a step,
/// since paths may be long and each load waits for the one before.
inline void follow_all(std::span<core::Index> path) {
  const auto at = [&](core::Index i) { return std::atomic_ref<core::Index>(path[i]); };
  core::parallel_for_each(path.size(), [&](std::size_t start) {
    const auto first = static_cast<core::Index>(start);
    core::Index found = at(first).load(std::memory_order_relaxed);
    if ((found & kPathEnd) != 0) return;
    while ((found & kPathEnd) == 0) found = at(found).load(std::memory_order_relaxed);
    core::Index i = first;
    for (core::Index next; ((next = at(i).load(std::memory_order_relaxed)) & kPathEnd) == 0; i = next)
      at(i).store(found, std::memory_order_relaxed);
  });
  core::parallel_for_each(path.size(), [&](std::size_t i) { path[i] &= ~kPathEnd; });
}

}  // namespace morsel::mscomplex
