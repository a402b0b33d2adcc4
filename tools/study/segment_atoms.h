#pragma once
/// Which atoms of a molecule the segments of its surface lie at.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/io/molecule.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::tools {

/// The atom nearest to each vertex.
struct NearestAtoms {
  std::vector<core::Index> of_vertex;  ///< number in the molecule; kNone if none is within the limit
  std::size_t without = 0;             ///< vertices that have none
};

/// By the distance to the atom's sphere, ‖x − c‖ − r, which is 0 on a surface of balls; of equal ones the
/// first. No atom belongs to a vertex that is more than 5 Å away from all spheres. Throws InvalidArgument if
/// there are no atoms or one has no finite position and radius; BadInput if no vertex has one, as where the
/// mesh lies in another frame or unit. Parallel, O(n log a) where atoms do not coincide.
NearestAtoms nearest_atoms(const core::TriangleMesh& mesh, std::span<const core::Atom> atoms,
                           const core::Progress& progress = {});

/// An atom of a segment.
struct SegmentAtom {
  core::Index segment = 0;
  core::Index atom = 0;
  double area = 0;  ///< of the segment, in the mesh's unit squared: a third of a triangle at each corner
};

/// The atoms that corners of a segment's triangles are nearest to, by segment, then atom. `labels`: the
/// segment of each triangle. The areas of all are the surface's, but for vertices without an atom. O(n log
/// n).
std::vector<SegmentAtom> atoms_of_segments(const core::TriangleMesh& mesh,
                                           std::span<const core::Index> labels, const NearestAtoms& nearest);

}  // namespace morsel::tools
