#pragma once
/// Sorting by whole numbers. For the module's own use.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::persistence::detail {

/// Sorts by key(item), a whole number below 2^bits; items of equal keys keep their order. By digits, from the
/// last one: O(bits · n), and a copy of the items.
template <class T, class Key>
void radix_sort(std::vector<T>& items, unsigned bits, const Key& key) {
  constexpr unsigned kDigit = 11;
  constexpr std::size_t kFew = 256;
  if (items.size() < kFew) {
    std::stable_sort(items.begin(), items.end(), [&](const T& a, const T& b) { return key(a) < key(b); });
    return;
  }
  std::vector<T> sorted(items.size());
  for (unsigned shift = 0; shift < bits; shift += kDigit) {
    const auto digit = [&](const T& item) {
      return static_cast<std::size_t>(key(item) >> shift) & ((std::size_t{1} << kDigit) - 1);
    };
    std::array<core::Index, std::size_t{1} << kDigit> place = {};
    for (const T& item : items) ++place[digit(item)];
    if (place[digit(items.front())] == items.size()) continue;
    core::Index sum = 0;
    for (core::Index& p : place) {
      const core::Index count = p;
      p = sum;
      sum += count;
    }
    for (const T& item : items) sorted[place[digit(item)]++] = item;
    items.swap(sorted);
  }
}

}  // namespace morsel::persistence::detail
