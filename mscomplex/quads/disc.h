#pragma once
/// A region of a LayoutMesh that is a disc once it is cut along labelled edges. Internal.

#include <string>
#include <vector>

#include "morsel/mscomplex/quads/layout_mesh.h"

namespace morsel::mscomplex {

/// Triangles that are connected across free edges, as a disc of its own: where the region touches a labelled
/// edge, or a vertex of one, from two sides, these are two edges and two vertices of the disc. Disc vertices
/// are numbered: the border first, counter-clockwise, then those inside.
struct Disc {
  std::vector<core::Index> triangles;  ///< of the mesh
  std::vector<core::Index> corner;     ///< disc vertex at corner i of triangles[k]: corner[3k + i]
  std::vector<core::Index> border;     ///< half-edges; border[i] leaves disc vertex i
  std::vector<core::Index> vertex;     ///< of the mesh, per disc vertex

  core::Index vertex_count() const { return static_cast<core::Index>(vertex.size()); }
  core::Index border_size() const { return static_cast<core::Index>(border.size()); }
};

/// Finds discs; reuses its memory from one to the next. Not thread-safe.
class DiscFinder {
 public:
  /// Refers to the mesh, which may be split meanwhile.
  explicit DiscFinder(const LayoutMesh& mesh) : mesh_(mesh) {}

  /// The region on the left of `start`, a labelled half-edge, which becomes border[0]. Throws
  /// std::logic_error, naming `what`, if the region is no disc: it has several borders, or not Euler
  /// characteristic 1.
  Disc find(core::Index start, const std::string& what);
  /// A labelled half-edge of the region that triangle t is in; kNone if it has none.
  core::Index find_border(core::Index t);

 private:
  void flood(core::Index t, std::vector<core::Index>& triangles);

  const LayoutMesh& mesh_;
  std::vector<core::Index> place_;  // per triangle: where it is in the region
};

}  // namespace morsel::mscomplex
