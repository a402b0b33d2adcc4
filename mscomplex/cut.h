#pragma once
/// Cutting a surface open into discs along the arcs of its Morse-Smale complex.

#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// A piece of a cut between two vertices where it branches, ends or meets the boundary.
struct CutPath {
  std::vector<core::Index> vertices;  ///< neighbours each; two or more; a loop has its first one last too
  double length = 0;                  ///< sum of the edges' lengths, in the mesh's unit
  core::Index component = 0;
};

/// Inner edges of a mesh along which each of its components opens into one disc.
///
/// Inner vertices on a single edge of the cut occur only as the two ends of the path that opens a closed
/// surface of genus 0. A component that is a disc needs no cut.
struct CutGraph {
  std::vector<core::Index> edges;  ///< mesh edges, ascending
  std::vector<CutPath> paths;      ///< all edges, each in one path; ordered by a path's first vertex
  double length = 0;               ///< of all paths, in the mesh's unit

  /// Checks, for tests, that the paths are made of the edges as described above and that cutting along them
  /// makes a disc of each component; throws std::logic_error naming the first contradiction. O(n).
  void validate(const core::TriangleMesh& mesh) const;
};

/// A cut of the complex's mesh, of any genus and with any number of boundary loops, made of descending arcs
/// (Ni, Garland, Hart 2004, "Fair Morse functions for extracting the topological structure of a surface
/// mesh").
///
/// A tree and its complement (Eppstein 2003): saddles join the tops, by their ascending arcs, to a graph;
/// those of its spanning tree with the longest descending arcs are crossed, the descending arcs of the
/// others, without the dangling ends, are the cut. The surface can be left anywhere along a boundary
/// loop: each boundary edge at which ascending arcs end is a top of its own, descending arcs end
/// where they meet the boundary, and the path down from a boundary vertex counts as a saddle's. A closed
/// component of genus 0 is cut along a shortest path, of two edges or more, from its lowest to its
/// highest vertex.
///
/// The shorter and the fewer the arcs, the better the cut: simplify a noisy field first. O(n + saddles ·
/// log saddles), and O(n log n) for closed components of genus 0; deterministic.
CutGraph find_cut(const MorseSmaleComplex& complex, const core::ScalarField& field,
                  const core::Progress& progress = {});

struct ShortenOptions {
  /// At most so many attempts per path on average; 1 or more. The result is a valid cut whenever it stops.
  int rounds = 16;
};

struct ShortenedCut {
  CutGraph cut;
  std::size_t attempts = 0;  ///< paths for which a shorter one was sought
  std::size_t replaced = 0;  ///< paths that were replaced
  bool is_settled = false;   ///< no single path can be made shorter
};

/// A shorter cut: replaces path after path by the shortest one that opens the surface as well. Glued
/// along one path the disc is an annulus; any path along mesh edges through its inside that joins its two
/// boundaries can replace that path, so that its ends slide along the rest of the cut and along
/// boundary loops. Goes on until no path gets shorter or `rounds` are over. A path that opens a closed
/// component of genus 0 stays.
///
/// `cut` must be one of `mesh` (throws InvalidArgument if an edge is on the boundary or does not exist, or
/// rounds < 1). Each attempt searches the vertices nearer to one side of the annulus than the path is long:
/// O(n log n) at worst. Deterministic.
ShortenedCut shorten(const core::TriangleMesh& mesh, const CutGraph& cut, const ShortenOptions& options = {},
                     const core::Progress& progress = {});

/// A mesh cut open.
struct CutMesh {
  /// The same triangles in the same order. Vertices keep their numbers; the copies that the cut makes of
  /// them come after all others, ordered by the vertex that they copy.
  core::TriangleMesh mesh;
  /// Per copy: the vertex that it copies. Copy i is vertex (original count) + i.
  std::vector<core::Index> copied;

  core::Index original_count() const { return mesh.vertex_count() - static_cast<core::Index>(copied.size()); }
  core::Index original(core::Index v) const {
    return v < original_count() ? v : copied[v - original_count()];
  }
};

/// Cuts along any set of edges: a vertex becomes as many vertices as there are parts into which cut and
/// boundary edges divide its triangles. Throws InvalidArgument if an edge does not exist, is on the boundary,
/// or meets neither another edge of the cut nor the boundary (cutting it would make two edges with the same
/// ends). Any other set gives a mesh that keeps all rules. O(n).
CutMesh cut_open(const core::TriangleMesh& mesh, const std::vector<core::Index>& edges);

/// The mesh before it was cut: the same positions and triangles in the same order. O(n).
core::TriangleMesh glue(const CutMesh& cut);

}  // namespace morsel::mscomplex
