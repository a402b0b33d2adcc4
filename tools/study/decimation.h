#pragma once
/// The surface with fewer vertices.

#include <cstdint>

#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

/// Collapses edges, u onto w with w staying where it is, until round(share · n) vertices are left, share in
/// (0, 1]. The shortest edge goes first, each length multiplied by a random factor between 1 and 2, so that
/// vertices are spread evenly and differently from trial to trial. Topology and boundary loops stay: a
/// collapse keeps the surface a manifold (the link condition: Dey, Edelsbrunner, Guha, Nekhayev 1999), takes
/// boundary vertices along the boundary only, and turns no triangle by more than about 78°.
///
/// `source` numbers the vertices that are left as the file does. Depends on the mesh, the seed and the trial
/// alone. O(n log n) as a rule, around vertices of very large degree too. Throws BadInput if no edge can be
/// collapsed any more before enough vertices are removed.
core::LoadedMesh decimated(const core::LoadedMesh& clean, double share, std::uint64_t seed,
                           std::uint64_t trial);

}  // namespace morsel::tools
