#pragma once
/// Connected segments at any level of the hierarchy, and their properties.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/segmentation.h"

namespace morsel::mscomplex {

struct Segment {
  core::Index minimum = core::kNone;  ///< node of the complex; kNone if descending
  core::Index top = core::kNone;      ///< node, a maximum or a cap; kNone if ascending
  core::Index triangles = 0;
  core::Index vertices = 0;  ///< may be 0
  double area = 0;           ///< the mesh's unit squared
  double boundary_length =
      0;  ///< of all edges between it and other segments, and of the next; the mesh's unit
  double mesh_boundary_length = 0;  ///< of its edges on the mesh's boundary
};

/// A segment across the border, and the border's length.
struct SegmentNeighbour {
  core::Index segment = core::kNone;
  core::Index edges = 0;
  double length = 0;  ///< the same bits seen from either side
};

/// A partition of the triangles into connected segments, numbered by minimum, then top (by the nodes'
/// numbers), then smallest triangle. A vertex has the segment of one of the triangles beside it.
struct Segments {
  SegmentKind kind = SegmentKind::descending;
  core::Index level = 0;  ///< of the hierarchy

  std::vector<core::Index> triangle;  ///< per triangle: its segment
  std::vector<core::Index> vertex;    ///< per vertex: its segment
  std::vector<Segment> segments;

  core::Index count() const { return static_cast<core::Index>(segments.size()); }
  /// Those that share an edge with segment s, ascending.
  std::span<const SegmentNeighbour> neighbours(core::Index s) const {
    return std::span(neighbour).subspan(neighbour_offset[s], neighbour_offset[s + 1] - neighbour_offset[s]);
  }
  /// The saddle vertices where one or several saddles that are alive at the level are joined by arcs to the
  /// segment's minimum or top, or are corners of its quad; ascending, each once.
  std::span<const core::Index> saddles(core::Index s) const {
    return std::span(saddle).subspan(saddle_offset[s], saddle_offset[s + 1] - saddle_offset[s]);
  }

  std::vector<core::Index> neighbour_offset;  ///< per segment, and the end
  std::vector<SegmentNeighbour> neighbour;
  std::vector<core::Index> saddle_offset;  ///< per segment, and the end
  std::vector<core::Index> saddle;
};

/// Cuts a surface into segments (Natarajan, Wang, Bremer, Pascucci, Hamann 2006, "Segmenting molecular
/// surfaces"), small ones merged by persistence: where a minimum or maximum is cancelled, its segment joins
/// that of the extremum that takes over its arcs.
///
/// A triangle flows to a maximum or cap and a vertex to a minimum, as segmentation.h says; a triangle has the
/// minimum of its lowest vertex. Merged labels are those of the extrema that survive. The kinds and
/// how they are connected:
///
/// | kind | one segment for each | connected |
/// | --- | --- | --- |
/// | descending | maximum alive, and piece of a cap's region | triangles across edges |
/// | ascending | minimum alive | vertices along edges; closed triangles |
/// | morse_smale | quad alive that has a triangle, and piece of one at a cap | closed triangles |
///
/// "Closed triangles" are those that share an edge or a vertex: ascending regions are made of vertices, and
/// where one is a single vertex wide its triangles may touch in that vertex only. The region of a cap is all
/// from which V-paths leave the surface through one boundary loop; often it has several pieces, each of which
/// is a segment. Several quads may have the same minimum and top; each is a segment of its own
/// (quad_regions.h), and cancelling a minimum joins the quads on both sides of its saddle's ascending arcs,
/// cancelling a maximum those of the descending ones. A component without saddles is one segment.
///
/// Vertices: ascending, that of the vertex's own minimum; descending, that of the highest triangle beside it
/// where that is in one piece; morse_smale, one of the triangles beside it that have its minimum, and its
/// maximum if possible.
///
/// Immutable; safe to read from any number of threads. Memory: 6 bytes a triangle, and 12 a segment before
/// merging.
class Segmenter {
 public:
  /// Refers to `hierarchy`, which must be the field's own (throws InvalidArgument if it is on another mesh).
  /// O(n), parallel.
  Segmenter(const core::ScalarField& field, const PersistenceHierarchy& hierarchy, SegmentKind kind,
            const core::Progress& progress = {});

  const PersistenceHierarchy& hierarchy() const { return hierarchy_; }
  SegmentKind kind() const { return kind_; }

  /// The number of segments at a level; it never increases with the level. O(1) if ascending, or if
  /// descending on a closed mesh; otherwise O(n), parallel.
  core::Index count(core::Index level) const;
  /// The first level with at most `wanted` segments, or the last one if no level has so few. O(log s)
  /// counts, or less.
  core::Index level_with(core::Index wanted) const;
  /// The segments at a level. O(n) except for sorting each segment's border, parallel; the same bits for
  /// every number of threads. Throws InvalidArgument if there is no such level.
  Segments segments(core::Index level, const core::Progress& progress = {}) const;

 private:
  struct Merged;
  void label_by_quads(const core::ScalarField& field, const Segmentation& base);
  void choose_triangles(const Segmentation& base);
  Merged merge(core::Index level) const;
  std::vector<core::Index> extremum_classes(core::Index level) const;
  std::vector<core::Index> quad_classes(core::Index level) const;
  template <class Visit>
  void for_each_join(const Cancellation& cancellation, const Visit& visit) const;
  core::Index level_with_quads(core::Index wanted) const;
  void find_pieces(Merged& merged) const;
  void number(Merged& merged, Segments& result) const;
  std::array<core::Index, 4> labels_around(core::Index saddle) const;
  void find_saddles(const Merged& merged, Segments& result) const;

  const PersistenceHierarchy& hierarchy_;
  SegmentKind kind_;
  std::vector<core::Index> label_;                // per triangle, at level 0
  core::FlatArray<core::Index> vertex_triangle_;  // per vertex: the triangle whose segment it has
  std::vector<std::array<core::Index, 2>> ends_;  // per label: minimum and top, nodes at level 0
  std::vector<core::Index> first_;                // per label: its smallest triangle, or kNone
};

}  // namespace morsel::mscomplex
