#pragma once
/// Repairing triangles until they obey the rules of TriangleMesh. Internal to build_mesh(), which documents
/// what is done.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// Triangles that are parts of the polygons of an input.
struct TriangleSoup {
  std::vector<Point> positions;
  std::vector<Triangle> triangles;
  /// Per triangle the polygon that it is a part of, ascending; empty if each is one of its own.
  std::vector<Index> faces;

  Index face(std::size_t t) const { return faces.empty() ? static_cast<Index>(t) : faces[t]; }
};

/// Counts of repairs before and during repair_triangles().
struct RepairCounts {
  std::size_t left_out_vertices = 0;
  std::size_t left_out_faces = 0;
  std::size_t split_left_out_rims = 0;
  std::size_t welded_vertices = 0;
  std::size_t removed_collapsed_faces = 0;
  std::size_t merged_repeated_corners = 0;
  std::size_t removed_degenerate_faces = 0;
  std::size_t removed_duplicate_faces = 0;
  std::size_t split_non_manifold_edges = 0;
  std::size_t split_non_manifold_vertices = 0;
  std::size_t reoriented_faces = 0;
  std::size_t removed_unreferenced_vertices = 0;

  /// Those that are not zero, in the order above.
  std::vector<Repair> listed() const;
};

/// Repairs in place. All corners must name vertices that exist. What remains afterwards is at most: no
/// triangle, non-finite positions, components that cannot be oriented. O(n log n).
VertexNumbering repair_triangles(TriangleSoup& soup, RepairCounts& counts);

/// Splits vertices whose faces form several fans, as repair_triangles() does it, but only where `may_split`
/// is true, and none at a non-manifold edge or a degenerate face: these stay as they are. All corners must
/// name vertices that exist. O(n + m log m) for m faces at the vertices that may be split.
VertexNumbering split_rims(TriangleSoup& soup, std::vector<bool> may_split, RepairCounts& counts);

}  // namespace morsel::core
