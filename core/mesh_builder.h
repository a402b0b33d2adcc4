#pragma once
/// From a polygon soup to a TriangleMesh: welding, triangulation, repair, and the way back to the input's
/// vertices.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh.h"
#include "morsel/core/mesh_defects.h"

namespace morsel::core {

/// Polygons over shared vertices, exactly as a file holds them: nothing is checked yet.
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
};

/// One kind of repair that was done, and on how many elements.
struct Repair {
  std::string action;  ///< "removed_degenerate_faces", …, as the report lists it
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
};

struct BuildOptions {
  bool repair = false;  ///< mend what can be mended instead of refusing it
};

/// Triangulates polygons and makes the mesh. Throws MeshError with every defect if a rule is broken (with
/// `repair`: if one remains). O(n log n), deterministic.
BuiltMesh build_mesh(const PolygonSoup& soup, const BuildOptions& options = {});

}  // namespace morsel::core
