#pragma once
/// Mean curvature at a scale along the surface, robust to noise and to the triangulation.

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// Mean curvature of the surface with waves shorter than 2π·scale diffused, unit 1/length; a sphere of radius
/// r has a little less than +1/r:
///
///   H = G(scale/3) (½ Δx' · n'),   x' = G(scale) x,   G(s) = (1 + t Δ)⁻²,   t = (√2 − 1) s²,
///
/// where x are the positions, n' the outward unit normals of the surface x' and Δ the surface's own
/// Laplacian, Δx = 2Hn (positive semi-definite). G(s) is two implicit steps of the heat equation (Desbrun,
/// Meyer, Schröder, Barr, "Implicit fairing of irregular meshes using diffusion and curvature flow", SIGGRAPH
/// 1999): it halves a wave of length 2πs. A sphere's curvature comes out as 1/r · (1 + 2t/r²)⁻², t that of
/// the scale.
///
/// Δ is M⁻¹L with the cotangents L and barycentric areas M of the intrinsic Delaunay triangulation (Bobenko,
/// Springborn, "A discrete Laplace-Beltrami operator for simplicial surfaces", 2007). One-ring estimates,
/// Taubin's among them, keep a trace of the triangles' shapes however smooth the surface is. Here that is
/// averaged by area, in the surface and, at a third of the scale, in the field: another sampling of the same
/// surface has nearly the same field. Noise falsifies the lengths in Δ itself: smooth it away first
/// (low_pass(), half an edge is enough).
///
/// Boundary conditions are natural (no flux): boundaries shrink along the surface, which does not change its
/// curvature. Degenerate triangles are allowed (edge_lengths.h). Where x' has no normal H is 0 before it is
/// diffused.
///
/// The scale is finite, above 0 and in the mesh's unit; throws InvalidArgument otherwise, BadInput if all
/// vertices coincide. Scales exactly by powers of two. Two factorisations, about n^1.5 on surfaces; mostly
/// serial, the same bits for every number of threads.
core::ScalarField diffused_mean_curvature(const core::TriangleMesh& mesh, double scale,
                                          const core::Progress& progress = {});

}  // namespace morsel::morse
