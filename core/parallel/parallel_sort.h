#pragma once
/// Sorting with all threads.

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "morsel/core/parallel/parallel.h"

namespace morsel::core {

/// Sorts [first, last). `less` must be a strict total order (no two elements equivalent), so that the result
/// is the same for every number of threads. Random-access iterators; O(n log n).
template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
  if (thread_count() == 1 || static_cast<std::size_t>(std::distance(first, last)) < kGrain) {
    std::sort(first, last, less);
    return;
  }
  detail::run_in_arena([&] { tbb::parallel_sort(first, last, less); });
}

}  // namespace morsel::core
