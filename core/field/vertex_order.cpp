#include "morsel/core/field/vertex_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/radix_sort.h"

namespace morsel::core {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;

/// Unsigned numbers that are ordered as the values are.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);  // −0 + 0 is 0
  return bits >> 63 != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}

struct KeyRange {
  std::uint64_t least = ~std::uint64_t{0};
  std::uint64_t greatest = 0;
};

/// A vertex and the leading bits of its key.
struct Entry {
  std::uint32_t leading;
  Index vertex;
};

/// Sorts vertices by their values, keeping the order of equal ones.
class VertexSort {
 public:
  explicit VertexSort(std::span<const double> values) : values_(values) {}

  void sort(std::span<Index> vertices) const {
    const KeyRange range = key_range(vertices);
    if (range.least >= range.greatest) return;
    const int shift = std::max(0, static_cast<int>(std::bit_width(range.greatest - range.least)) - 32);
    FlatArray<Entry> entries(vertices.size());
    parallel_for_each(entries.size(), [&](std::size_t i) {
      entries[i] = {static_cast<std::uint32_t>((key(vertices[i]) - range.least) >> shift), vertices[i]};
    });
    radix_sort(entries, 32, [](const Entry& entry) { return entry.leading; });
    parallel_for_each(entries.size(), [&](std::size_t i) { vertices[i] = entries[i].vertex; });
    if (shift == 0) return;
    for (const auto& [first, last] : sort_short_runs(entries, vertices))
      sort(vertices.subspan(first, last - first));
  }

 private:
  using Run = std::pair<std::size_t, std::size_t>;

  std::uint64_t key(Index v) const { return key_of(values_[v]); }

  KeyRange key_range(std::span<const Index> vertices) const {
    return parallel_reduce(
        0, vertices.size(), kChunk, KeyRange{},
        [&](std::size_t first, std::size_t last) {
          KeyRange range;
          for (std::size_t i = first; i < last; ++i) {
            range.least = std::min(range.least, key(vertices[i]));
            range.greatest = std::max(range.greatest, key(vertices[i]));
          }
          return range;
        },
        [](const KeyRange& a, const KeyRange& b) {
          return KeyRange{std::min(a.least, b.least), std::max(a.greatest, b.greatest)};
        });
  }

  /// Orders each run of vertices whose leading bits are equal, but for those of more than a chunk: returns
  /// these.
  std::vector<Run> sort_short_runs(const FlatArray<Entry>& entries, std::span<Index> vertices) const {
    const auto continues = [&](std::size_t i) {
      return i > 0 && i < entries.size() && entries[i].leading == entries[i - 1].leading;
    };
    return parallel_reduce(
        0, entries.size(), kChunk, std::vector<Run>(),
        [&](std::size_t first, std::size_t last) {
          std::vector<Run> long_runs;
          std::size_t i = first;
          while (i < last && continues(i)) ++i;  // belongs to the chunk in which it begins
          while (i < last) {
            std::size_t end = i + 1;
            while (continues(end)) ++end;
            if (end - i > kChunk) {
              long_runs.emplace_back(i, end);
            } else if (end - i > 1) {
              sort_few(vertices.subspan(i, end - i));
            }
            i = end;
          }
          return long_runs;
        },
        [](std::vector<Run> a, const std::vector<Run>& b) {
          a.insert(a.end(), b.begin(), b.end());
          return a;
        });
  }

  void sort_few(std::span<Index> vertices) const {
    const auto less = [this](Index a, Index b) { return key(a) < key(b); };
    if (std::is_sorted(vertices.begin(), vertices.end(), less)) return;
    if (vertices.size() > 16) {
      std::stable_sort(vertices.begin(), vertices.end(), less);
      return;
    }
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const Index moving = vertices[i];
      std::size_t place = i;
      for (; place > 0 && less(moving, vertices[place - 1]); --place) vertices[place] = vertices[place - 1];
      vertices[place] = moving;
    }
  }

  std::span<const double> values_;
};

}  // namespace

FlatArray<Index> vertex_order(std::span<const double> values) {
  FlatArray<Index> order(values.size());
  parallel_for_each(order.size(), [&](std::size_t v) { order[v] = static_cast<Index>(v); });
  VertexSort(values).sort(order);
  return order;
}

FlatArray<Index> vertex_order(std::span<const double> values, std::span<const Index> before) {
  FlatArray<Index> order(before.begin(), before.end());
  VertexSort(values).sort(order);
  return order;
}

FlatArray<Index> inverse(std::span<const Index> permutation) {
  FlatArray<Index> result(permutation.size());
  parallel_for_each(permutation.size(),
                    [&](std::size_t i) { result[permutation[i]] = static_cast<Index>(i); });
  return result;
}

}  // namespace morsel::core
