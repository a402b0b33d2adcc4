#pragma once
/// Curvatures of the surface at its vertices, by Taubin's tensor; others: discrete_curvature.h,
/// quadric_curvature.h.

#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// Mean curvature at each vertex, unit 1/length; a sphere of radius r has +1/r (Taubin, "Estimating the
/// tensor of curvature of a surface from a polyhedral approximation", ICCV 1995).
///
/// H_i = Σ_j w_ij κ_ij over the neighbours j, where κ_ij = 2 n_i·(v_i − v_j)/‖v_i − v_j‖² is the normal
/// curvature towards v_j, n_i the area-weighted unit normal and w_ij the area of the triangles at edge ij,
/// scaled to sum to 1. Normals point outward on closed components, whatever the orientation of their
/// triangles; on bounded components they follow the triangles.
///
/// Where the formulas are undefined: a neighbour at the same place (an edge of length zero) has no direction
/// and is left out, the other weights summing to 1; a vertex without area around it, or whose normals cancel
/// out, has curvature 0. So values are never NaN. Edges far below the unit of the floating-point range (under
/// 1e-308) may make them overflow, which throws BadInput. O(n), parallel.
core::ScalarField mean_curvature(const core::TriangleMesh& mesh, const core::Progress& progress = {});

/// k1 ≥ k2 at each vertex, unit 1/length.
struct PrincipalCurvatures {
  std::vector<double> k1;
  std::vector<double> k2;
};

/// The principal curvatures k1 = 3 m1 − m2 and k2 = 3 m2 − m1 from the two eigenvalues m1 ≥ m2 in the tangent
/// plane of Taubin's tensor Σ_j w_ij κ_ij T_ij T_ijᵀ, T_ij being the unit projection of v_j − v_i. Their mean
/// is mean_curvature(), sign and special cases as there; a neighbour straight along the normal, which has no
/// T_ij, adds its κ_ij to all directions equally. O(n), parallel.
PrincipalCurvatures principal_curvatures(const core::TriangleMesh& mesh, const core::Progress& progress = {});

}  // namespace morsel::morse
