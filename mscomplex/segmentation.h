#pragma once
/// The segmentations of a surface by a field: by the minimum reached downhill, by the maximum reached uphill,
/// and by both.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/discrete_gradient.h"

namespace morsel::mscomplex {

/// What segments are the regions of.
enum class SegmentKind : std::uint8_t {
  descending,  ///< a maximum, or the cap of a boundary loop: all from which the V-path up leads there
  ascending,   ///< a minimum: all from which the V-path down leads there
  morse_smale  ///< a quad of the complex: a minimum and a maximum or cap
};
inline constexpr std::array kSegmentKinds = {SegmentKind::descending, SegmentKind::ascending,
                                             SegmentKind::morse_smale};
/// "descending", "ascending", "morse-smale".
std::string to_string(SegmentKind kind);

/// A label for each vertex and each triangle.
struct SegmentLabels {
  std::vector<core::Index> vertex;
  std::vector<core::Index> triangle;
  core::Index count = 0;  ///< of segments, that is of labels that some triangle carries
};

/// The segmentation of the vertices and triangles of a surface.
///
/// A vertex's minimum is where descend() leads, a triangle's maximum where ascend() leads, or the cap of the
/// boundary loop where that leaves the surface. A triangle takes the minimum of its lowest vertex; a vertex
/// the maximum or cap of the highest triangle in its star (that with the highest vertex, then the highest
/// second, then the highest third).
struct Segmentation {
  /// Ascending manifolds of the minima: label i is gradient.minima()[i], node i of the complex. Every minimum
  /// has a segment. Its vertices are connected along mesh edges.
  SegmentLabels ascending;
  /// Descending manifolds of the maxima, then of the caps: label i is gradient.maxima()[i], or loop i −
  /// maxima, node complex.maximum_node(i). Every maximum has a segment, whose triangles are connected across
  /// edges; that of a cap may be in several pieces, connected through the cap alone, and may be empty: then
  /// it is not counted.
  SegmentLabels descending;
  /// The two together: label i is the pair cells[i]. One label for each pair that occurs, whether the region
  /// is connected or, as where several quads join the same minimum and maximum, in several pieces.
  SegmentLabels morse_smale;
  /// (ascending, descending) label of each Morse-Smale label. First the `morse_smale.count` pairs that
  /// triangles carry, lexicographically; then those, if any, that only vertices do, lexicographically.
  std::vector<std::array<core::Index, 2>> cells;
};

/// The segmentation by `gradient`, which must be `field`'s (throws InvalidArgument if it is on another mesh).
/// O(n) except for sorting the maxima around each minimum; parallel, the same bits for every number of
/// threads. Memory: 36 bytes a vertex, and 8 a Morse-Smale segment.
Segmentation segment(const core::ScalarField& field, const DiscreteGradient& gradient,
                     const core::Progress& progress = {});

}  // namespace morsel::mscomplex
