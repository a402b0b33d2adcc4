#pragma once
/// Sorting by whole numbers.

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/partition.h"

namespace morsel::core {

/// Sorts by key(item), an unsigned whole number below 2^bits; items of equal keys keep their order. By
/// digits, from the last one: O(bits · n) time and a copy of the items; for few items by comparisons.
/// Parallel, the same for every number of threads.
template <class T, class Allocator, class Key>
void radix_sort(std::vector<T, Allocator>& items, unsigned bits, const Key& key) {
  constexpr unsigned kDigit = 11;
  constexpr std::size_t kFew = 256;
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  if (items.size() < kFew) {
    std::stable_sort(items.begin(), items.end(), [&](const T& a, const T& b) { return key(a) < key(b); });
    return;
  }
  // Digits in which all keys agree are left out.
  using Number = decltype(key(items.front()));
  const Number some = key(items.front());
  const Number differing = parallel_reduce(
      0, items.size(), kChunk, Number{0},
      [&](std::size_t first, std::size_t last) {
        Number found{0};
        for (std::size_t i = first; i < last; ++i) found |= key(items[i]) ^ some;
        return found;
      },
      [](Number a, Number b) { return a | b; });
  for (unsigned shift = 0; shift < bits; shift += kDigit) {
    const unsigned width = std::min(kDigit, bits - shift);
    const std::size_t mask = (std::size_t{1} << width) - 1;
    if ((static_cast<std::size_t>(differing >> shift) & mask) == 0) continue;
    FlatArray<T> sorted =
        partition<T>(items.size(), mask + 1, kChunk,
                     [&](std::size_t first, std::size_t last, const auto& emit) {
                       for (std::size_t i = first; i < last; ++i)
                         emit(static_cast<std::size_t>(key(items[i]) >> shift) & mask, items[i]);
                     })
            .items;
    if constexpr (std::is_same_v<Allocator, FlatAllocator<T>>) {
      items = std::move(sorted);
    } else {
      items.assign(sorted.begin(), sorted.end());
    }
  }
}

}  // namespace morsel::core
