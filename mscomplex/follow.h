#pragma once
/// Following pointers to their ends in linear time: used for arcs and for segments.

#include <atomic>
#include <span>

#include "morsel/core/parallel/parallel.h"
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

/// Marks the label at a way's end for follow_all(). Labels and elements are below 2³¹: a mesh has fewer
/// cells.
inline constexpr core::Index kWayEnd = 0x8000'0000u;

/// Replaces each element of `way` by the label at its way's end. An element holds the next one on its way, or
/// its label and kWayEnd. O(n), parallel, the same for every number of threads; a single load a step, for
/// ways may be long and each load waits for the one before.
inline void follow_all(std::span<core::Index> way) {
  const auto at = [&](core::Index i) { return std::atomic_ref<core::Index>(way[i]); };
  core::parallel_for_each(way.size(), [&](std::size_t start) {
    const auto first = static_cast<core::Index>(start);
    core::Index found = at(first).load(std::memory_order_relaxed);
    if ((found & kWayEnd) != 0) return;
    while ((found & kWayEnd) == 0) found = at(found).load(std::memory_order_relaxed);
    core::Index i = first;
    for (core::Index next; ((next = at(i).load(std::memory_order_relaxed)) & kWayEnd) == 0; i = next)
      at(i).store(found, std::memory_order_relaxed);
  });
  core::parallel_for_each(way.size(), [&](std::size_t i) { way[i] &= ~kWayEnd; });
}

}  // namespace morsel::mscomplex
