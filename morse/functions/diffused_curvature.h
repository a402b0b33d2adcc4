#pragma once
/// Curvatures at a scale along the surface, robust to noise and to the triangulation.

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

/// Gaussian curvature of the faired surface, spread over the surface, unit 1/length²: maxima where a
/// surface has its tips, near or far from one another as `spread` says. For the points that people mark.
///
///   K = (M + t L)⁻¹ d,   t = spread²/2,
///
/// where d are the angle defects of the surface x' = G(fairing) x (above), 0 at boundary vertices, where they
/// are the turning of the rim. One implicit step of the heat equation spreads this density: it multiplies a
/// wave of frequency λ by 1/(1 + tλ), so that much of what is near stays, and spread² = 2t is the variance of
/// the heat kernel of the time t. M and L are those of the surface itself, as above. ∫K is ∫d: 2πχ on closed
/// surfaces (Gauss, Bonnet); on a sphere K is 1/r², however it is faired.
///
/// Lengths are finite and in the mesh's unit; `fairing` is at least 0 (the surface as it is), `spread` above
/// 0; throws InvalidArgument otherwise, BadInput if all vertices coincide. Scales exactly by powers of two.
/// Two factorisations, about n^1.5 on surfaces; mostly serial, the same bits for every number of threads.
core::ScalarField diffused_gaussian_curvature(const core::TriangleMesh& mesh, double fairing, double spread,
                                              const core::Progress& progress = {});

}  // namespace morsel::morse
