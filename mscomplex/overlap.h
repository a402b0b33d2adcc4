#pragma once
/// How the segments of two segmentations of one surface overlap.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::mscomplex {

/// An area that a segment shares with a segment of the other segmentation.
struct Overlap {
  core::Index segment = core::kNone;  ///< of the other one; kNone where there is none
  double area = 0;                    ///< in the mesh's unit of length, squared
  friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// The segments of the other segmentation that each segment shares triangles with: a sparse matrix, row by
/// row.
struct OverlapTable {
  std::vector<std::size_t> offset;  ///< per segment, and the end
  std::vector<Overlap> entries;     ///< by segment, then by ascending segment of the other

  core::Index segment_count() const { return static_cast<core::Index>(offset.size() - 1); }
  /// Those of segment i; empty if no triangle carries its label.
  std::span<const Overlap> of(core::Index i) const {
    return std::span<const Overlap>(entries).subspan(offset[i], offset[i + 1] - offset[i]);
  }
};

/// The area of each triangle. O(n), parallel.
std::vector<double> triangle_areas(const core::TriangleMesh& mesh);

/// The area of each segment, from a label below `count` for each triangle. O(n).
std::vector<double> segment_areas(std::span<const core::Index> labels, core::Index count,
                                  std::span<const double> areas);

/// The overlaps of the segments that `labels` names with those that `others` names; both have a label a
/// triangle, below `count` and `other_count`, and `areas` the triangles' areas. Throws InvalidArgument on
/// other sizes and labels. Areas are summed in the order of the triangles, so that a segment that lies in one
/// other as a whole shares exactly its segment_areas(). O(n log(count · other_count)) by radix sorting;
/// parallel, the same bits for every number of threads. Memory: 32 bytes a triangle while it runs.
OverlapTable overlaps(std::span<const core::Index> labels, core::Index count,
                      std::span<const core::Index> others, core::Index other_count,
                      std::span<const double> areas);

/// The transposed table, of the other segmentation, which has `other_count` segments: the overlaps of its
/// segments with these. O(entries + other_count).
OverlapTable transposed(const OverlapTable& table, core::Index other_count);

/// For each segment the one of the other segmentation that it shares the largest area with, of equally large
/// ones that of smallest number; kNone for one that no triangle carries. O(entries).
std::vector<Overlap> largest_overlaps(const OverlapTable& table);

}  // namespace morsel::mscomplex
