#pragma once
/// An ordered set of small whole numbers.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace morsel::core {

/// A set of numbers below a bound, as a tree of bits whose nodes have 64 children: everything takes O(log
/// bound).
class IndexSet {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};

  explicit IndexSet(std::size_t bound) {
    do {
      bound = (bound + 63) / 64;
      levels_.emplace_back(bound, 0);
    } while (bound > 1);
  }

  void insert(std::size_t i) {
    for (std::vector<std::uint64_t>& words : levels_) {
      words[i / 64] |= std::uint64_t{1} << i % 64;
      i /= 64;
    }
  }

  void erase(std::size_t i) {
    for (std::vector<std::uint64_t>& words : levels_) {
      words[i / 64] &= ~(std::uint64_t{1} << i % 64);
      if (words[i / 64] != 0) return;
      i /= 64;
    }
  }

  bool contains(std::size_t i) const { return (levels_[0][i / 64] >> i % 64 & 1) != 0; }

  /// The smallest one that is at least i; kNone if there is none.
  std::size_t next(std::size_t i) const {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const std::size_t word = i / 64;
      if (word >= levels_[level].size()) return kNone;
      const std::uint64_t later = levels_[level][word] & ~std::uint64_t{0} << i % 64;
      if (later == 0) {
        i = word + 1;
        continue;
      }
      i = 64 * word + static_cast<std::size_t>(std::countr_zero(later));
      while (level-- > 0) i = 64 * i + static_cast<std::size_t>(std::countr_zero(levels_[level][i]));
      return i;
    }
    return kNone;
  }

 private:
  std::vector<std::vector<std::uint64_t>>
      levels_;  // a bit is set if the word of its number one level below is not 0
};

}  // namespace morsel::core
