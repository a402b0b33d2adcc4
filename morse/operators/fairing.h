#pragma once
/// Surfaces that are smoothed along themselves, whatever their triangulation.

#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/surface_heat.h"

namespace morsel::morse {

/// Each coordinate after two steps of heat: G x. Two solves for each axis.
std::vector<core::Point> diffused(std::vector<core::Point> positions, const HeatStep& step,
                                  const core::Progress& progress);

/// The surface without its undulations below a scale s: a wave of length 2πs keeps half of its height.
///
///   x' = G (2 − G) x,   G = (1 + t Δ)⁻²,   t = (√(2 + √2) − 1) s²
///
/// G is two implicit steps of the heat equation (Desbrun, Meyer, Schröder, Barr, "Implicit fairing of
/// irregular meshes using diffusion and curvature flow", SIGGRAPH 1999). What G takes away is smoothed, too,
/// and given back ("twicing", Tukey 1977), so that long waves lose their height to second order only: thin
/// parts keep their shape where G alone would shrink them. Δ is the surface's own Laplacian
/// (surface_laplacian()). Noise falsifies its lengths, so x' is made twice from x: first at half the scale,
/// with the Laplacian of the surface as it is, then with that of the result, which has few of the noise's
/// lengths and still nearly those of thin parts.
///
/// In contrast to low_pass() neither shapes of triangles nor how densely a surface is sampled matter: another
/// sampling of the same surface becomes nearly the same surface, and vertices do not slide along it. The
/// price is that noise larger than the edges is removed less well. Natural boundary conditions (no flux):
/// boundaries shrink along the surface.
///
/// The scale is in the mesh's unit, finite and not below 0; 0 returns the mesh itself. Throws InvalidArgument
/// otherwise, BadInput if it exceeds the diagonal of the mesh's box. Scales exactly by powers of two. Two
/// factorisations, about n^1.5 on surfaces; serial, the same bits for every number of threads.
core::TriangleMesh faired(const core::TriangleMesh& mesh, double scale, const core::Progress& progress = {});

}  // namespace morsel::morse
