#pragma once
/// From a polygon soup to a TriangleMesh: triangulation, repair, and the map to the input's vertices.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/mesh/vertex_values.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Polygons over shared vertices, exactly as in the file, unchecked.
struct PolygonSoup {
  std::vector<Point> positions;
  /// Polygon p has the corners corners[offsets[p]] … corners[offsets[p + 1] − 1].
  std::vector<std::size_t> offsets = {0};
  std::vector<Index> corners;

  std::size_t polygon_count() const { return offsets.size() - 1; }
  std::span<const Index> polygon(std::size_t p) const {
    return std::span<const Index>(corners).subspan(offsets[p], offsets[p + 1] - offsets[p]);
  }
  void add_polygon(std::span<const Index> polygon);
  /// The length of the vector area of polygon p, half the sum of its corners' cross products: the area of a
  /// flat one. Its corners must exist.
  double area(std::size_t p) const;
};

/// One kind of repair that was done, and on how many elements of the input: faces are its polygons, not the
/// triangles that they are cut into.
struct Repair {
  std::string action;  ///< "left_out_vertices", "removed_degenerate_faces", …, as the report lists it
  std::size_t count = 0;
};

/// How mesh vertices and the input's vertices correspond. Empty tables mean "the same numbers".
struct VertexNumbering {
  std::size_t input_count = 0;
  std::vector<Index> to_input;    ///< per mesh vertex: its number in the input
  std::vector<Index> from_input;  ///< per input vertex: its (smallest) mesh vertex, kNone if dropped

  Index input_vertex(Index mesh_vertex) const {
    return to_input.empty() ? mesh_vertex : to_input[mesh_vertex];
  }
  Index mesh_vertex(Index input_vertex) const {
    return from_input.empty() ? input_vertex : from_input[input_vertex];
  }
};

struct BuiltMesh {
  TriangleMesh mesh;
  VertexNumbering numbering;
  std::vector<Repair> repairs;
  std::vector<std::string> warnings = {};  ///< what was left out, a sentence each
};

struct BuildOptions {
  bool repair = false;  ///< repair what can be repaired instead of refusing it
  /// Join vertices first, within this length (welding.h); at the same position if it is 0.
  std::optional<Length> weld = {};
  // Vertices that are left out (vertex_mask.h). make_mesh() reads these values; build_mesh() is told which
  // vertices they are.
  std::optional<VertexValues> mask = {};  ///< leave out vertices where these are 0 or nan
  std::vector<VertexValues> needed =
      {};  ///< leave out vertices where any of these, of fields to come, is nan

  friend bool operator==(const BuildOptions&, const BuildOptions&) = default;
};

/// Makes the mesh: cuts polygons of four and more corners into triangles (polygon_triangulation.h), keeping
/// their order, and checks every rule of TriangleMesh. Positions are never moved. Throws MeshError with every
/// defect if a rule is broken; vertices and faces in it are numbered as those of the soup. A polygon with
/// fewer than three corners, or with two consecutive ones on the same vertex, is degenerate; polygons with
/// the same sides are duplicates whichever way round they run.
///
/// `left_out` has an entry for each vertex, or none: those that are true are left out first, with all faces
/// at them and vertices that no face is left at (`left_out_vertices`, `left_out_faces`). Where faces that are
/// left meet in a vertex alone, because a face between them has gone, the vertex is split as repair splits
/// one
/// (`split_left_out_rims`). Throws InvalidArgument for another number of entries, BadInput if no face is
/// left.
///
/// With `options.weld` vertices are joined next, as weld() does it: a joined vertex has the position of the
/// one that it joins, and VertexNumbering::from_input of both is the same mesh vertex. That is listed as
/// `welded_vertices`, and as `removed_collapsed_faces` the faces of which it left fewer than three different
/// vertices. Throws InvalidArgument if the length is negative.
///
/// With `options.repair` it then does these repairs, in this order, lists those that changed anything, and
/// throws MeshError only for what remains (faces that name missing vertices, non-finite positions in use,
/// components that cannot be oriented, no face left):
///
/// | action | what |
/// | --- | --- |
/// | merged_repeated_corners | faces in which consecutive corners on the same vertex became one |
/// | removed_degenerate_faces | faces with fewer than three different vertices |
/// | removed_duplicate_faces | faces on the same vertices as an earlier one, which is kept |
/// | split_non_manifold_edges | edges of three or more faces: the faces are separated there |
/// | split_non_manifold_vertices | vertices whose faces form several fans: each gets a vertex of its own |
/// | reoriented_faces | faces turned round so that all in a component agree |
/// | removed_unreferenced_vertices | vertices that no face (any more) uses |
///
/// Where a vertex is split, the fan of the first face keeps its number and the others get new vertices at the
/// same position after all others. Faces that meet in a split edge stay joined where both its ends got the
/// same new vertices. A component that has to be reoriented ends up with normals out of the solid if it is
/// closed (by nesting: those of a cavity's wall point into the cavity), else with the orientation of most of
/// its faces (of the first, in a tie); one that is consistent is left alone.
///
/// O(n log n), deterministic.
BuiltMesh build_mesh(PolygonSoup soup, const BuildOptions& options = {}, const Progress& progress = {},
                     const std::vector<bool>& left_out = {});

}  // namespace morsel::core
