#pragma once
/// Curvatures by discrete differential operators: Meyer, Desbrun, Schröder, Barr, "Discrete
/// differential-geometry operators for triangulated 2-manifolds", 2003.

#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// 2π − Σ θ over the angles of the triangles at each inner vertex, π − Σ θ at a boundary vertex; in radians.
/// They sum to 2πχ (Gauss, Bonnet). An angle at a side of length zero is that of the limit as the side
/// shrinks: π/2, or π/3 if all three sides have length zero. O(n), parallel.
std::vector<double> angle_defects(const core::TriangleMesh& mesh);

/// Gaussian curvature: the angle defect over the mixed area of the vertex (section 4.1 there), unit
/// 1/length²; a sphere of radius r has 1/r². At a boundary vertex the defect is mostly the boundary's
/// geodesic curvature. 0 where a vertex has no area. Throws BadInput where a value is too large for a double.
/// O(n), parallel.
core::ScalarField gaussian_curvature(const core::TriangleMesh& mesh, const core::Progress& progress = {});

/// Mean curvature ‖K‖/2 from the mean curvature normal K(v) = 1/(2A) Σ (cot α + cot β)(v − x) over the
/// neighbours x (equation 8 there), A the mixed area; unit 1/length. Sign: that of K · n with n the outward
/// area-weighted normal, so a sphere of radius r has +1/r. At a boundary vertex K has a tangential part,
/// which is not curvature, and the value is K · n/2. 0 where a vertex has no area. A one-ring estimate: no
/// better than Taubin's against noise. O(n), parallel.
core::ScalarField cotangent_mean_curvature(const core::TriangleMesh& mesh,
                                           const core::Progress& progress = {});

}  // namespace morsel::morse
