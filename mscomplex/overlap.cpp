#include "morsel/mscomplex/overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/radix_sort.h"

namespace morsel::mscomplex {
namespace {

using core::Index;
using core::InvalidArgument;

using Pair = std::uint64_t;  // of segments: segment · other_count + other

struct PairedTriangle {
  Pair pair;
  Index triangle;
};

void check_sizes(std::span<const Index> labels, std::span<const double> areas) {
  if (labels.size() != areas.size())
    throw InvalidArgument("there are " + std::to_string(labels.size()) + " labels for " +
                          std::to_string(areas.size()) + " triangles");
}

void check_labels(std::span<const Index> labels, Index count) {
  const Index largest = core::parallel_reduce(
      0, labels.size(), core::kGrain, Index{0},
      [&](std::size_t first, std::size_t last) {
        return *std::max_element(labels.begin() + static_cast<std::ptrdiff_t>(first),
                                 labels.begin() + static_cast<std::ptrdiff_t>(last));
      },
      [](Index a, Index b) { return std::max(a, b); });
  if (!labels.empty() && largest >= count)
    throw InvalidArgument("label " + std::to_string(largest) + " is not below the number of segments, " +
                          std::to_string(count));
}

/// Where the runs of equal pairs begin.
std::vector<std::size_t> run_starts(const core::FlatArray<PairedTriangle>& sorted) {
  return core::parallel_reduce(
      0, sorted.size(), 16 * core::kGrain, std::vector<std::size_t>{},
      [&](std::size_t first, std::size_t last) {
        std::vector<std::size_t> starts;
        for (std::size_t i = first; i < last; ++i)
          if (i == 0 || sorted[i].pair != sorted[i - 1].pair) starts.push_back(i);
        return starts;
      },
      [](std::vector<std::size_t> all, const std::vector<std::size_t>& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
      });
}

}  // namespace

std::vector<double> triangle_areas(const core::TriangleMesh& mesh) {
  std::vector<double> areas(mesh.triangle_count());
  core::parallel_for_each(areas.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangle(static_cast<Index>(t));
    const core::Point& origin = mesh.position(a);
    areas[t] = (mesh.position(b) - origin).cross(mesh.position(c) - origin).norm() / 2;
  });
  return areas;
}

std::vector<double> segment_areas(std::span<const Index> labels, Index count, std::span<const double> areas) {
  check_sizes(labels, areas);
  check_labels(labels, count);
  std::vector<double> sums(count, 0);
  for (std::size_t t = 0; t < labels.size(); ++t) sums[labels[t]] += areas[t];
  return sums;
}

OverlapTable overlaps(std::span<const Index> labels, Index count, std::span<const Index> others,
                      Index other_count, std::span<const double> areas) {
  check_sizes(labels, areas);
  check_sizes(others, areas);
  check_labels(labels, count);
  check_labels(others, other_count);
  core::FlatArray<PairedTriangle> sorted(labels.size());
  core::parallel_for_each(sorted.size(), [&](std::size_t t) {
    sorted[t] = {Pair{labels[t]} * other_count + others[t], static_cast<Index>(t)};
  });
  core::radix_sort(sorted, static_cast<unsigned>(std::bit_width(Pair{count} * other_count)),
                   [](const PairedTriangle& item) { return item.pair; });
  const std::vector<std::size_t> starts = run_starts(sorted);

  OverlapTable table;
  table.entries.resize(starts.size());
  core::parallel_for(0, starts.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      const std::size_t end = e + 1 < starts.size() ? starts[e + 1] : sorted.size();
      double area = 0;
      for (std::size_t i = starts[e]; i < end; ++i) area += areas[sorted[i].triangle];
      table.entries[e] = {static_cast<Index>(sorted[starts[e]].pair % other_count), area};
    }
  });
  table.offset.assign(std::size_t{count} + 1, 0);
  for (const std::size_t start : starts) ++table.offset[sorted[start].pair / other_count + 1];
  for (Index i = 0; i < count; ++i) table.offset[i + 1] += table.offset[i];
  return table;
}

OverlapTable transposed(const OverlapTable& table, Index other_count) {
  OverlapTable result;
  result.offset.assign(std::size_t{other_count} + 1, 0);
  for (const Overlap& entry : table.entries) {
    if (entry.segment >= other_count)
      throw InvalidArgument("segment " + std::to_string(entry.segment) +
                            " is not below the number of segments, " + std::to_string(other_count));
    ++result.offset[entry.segment + 1];
  }
  for (Index i = 0; i < other_count; ++i) result.offset[i + 1] += result.offset[i];
  result.entries.resize(table.entries.size());
  std::vector<std::size_t> place(result.offset.begin(), result.offset.end() - 1);
  for (Index i = 0; i < table.segment_count(); ++i)
    for (const Overlap& entry : table.of(i)) result.entries[place[entry.segment]++] = {i, entry.area};
  return result;
}

std::vector<Overlap> largest_overlaps(const OverlapTable& table) {
  std::vector<Overlap> largest(table.segment_count());
  core::parallel_for_each(largest.size(), [&](std::size_t i) {
    const std::span<const Overlap> row = table.of(static_cast<Index>(i));
    const auto best = std::max_element(row.begin(), row.end(),
                                       [](const Overlap& a, const Overlap& b) { return a.area < b.area; });
    if (best != row.end()) largest[i] = *best;
  });
  return largest;
}

}  // namespace morsel::mscomplex
