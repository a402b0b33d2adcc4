#pragma once
/// The edges of a cut as used by the algorithms: walls that separate triangles, and paths between branchings.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "morsel/mscomplex/cut.h"

namespace morsel::mscomplex {

double edge_length(const core::TriangleMesh& mesh, core::Index halfedge);

/// The edges that separate triangles: those on the boundary and those of a cut.
class Walls {
 public:
  /// Throws InvalidArgument if one of `edges` is none of the mesh's or on the boundary.
  Walls(const core::TriangleMesh& mesh, std::span<const core::Index> edges);

  bool is_cut(core::Index edge) const { return cut_[edge] != 0; }
  bool is_wall(core::Index halfedge) const {
    return mesh_.twin(halfedge) == core::kNone || is_cut(mesh_.edge(halfedge));
  }
  /// The number of walls at a vertex; a boundary counts 2.
  core::Index degree(core::Index vertex) const { return degree_[vertex]; }

  /// Adds an inner edge that is no wall, or removes one that is.
  void add(core::Index edge) { change(edge, 1); }
  void remove(core::Index edge) { change(edge, 0); }

 private:
  void change(core::Index edge, std::uint8_t cut) {
    cut_[edge] = cut;
    for (const core::Index v : mesh_.edge_vertices(edge)) degree_[v] += cut != 0 ? 1 : core::Index(-1);
  }

  core::TriangleMesh mesh_;
  std::vector<std::uint8_t> cut_;    // per edge
  std::vector<core::Index> degree_;  // per vertex
};

/// The half-edge from `vertices[i]` to `vertices[i + 1]`, for each i; they must be neighbours.
std::vector<core::Index> halfedges_along(const core::TriangleMesh& mesh,
                                         std::span<const core::Index> vertices);

/// Edges of a cut between two vertices where it branches, ends or meets the boundary.
struct TracedPath {
  std::vector<core::Index> halfedges;  ///< from the end of the smaller number on
  double length = 0;                   ///< sum of the edges' lengths, in that order
};

/// These edges (inner ones, ascending, each once) split into paths where is_end(v, number of them at v)
/// holds; it must wherever that number is not 2. Ordered by the paths' first vertices, then by their first
/// edges. O(n log n).
std::vector<TracedPath> trace_paths(const core::TriangleMesh& mesh, std::span<const core::Index> edges,
                                    const std::function<bool(core::Index, std::size_t)>& is_end);

/// The graph of these edges (inner ones, ascending, each once), split into paths.
CutGraph make_cut_graph(const core::TriangleMesh& mesh, std::vector<core::Index> edges);

}  // namespace morsel::mscomplex
