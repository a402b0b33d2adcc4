#pragma once
/// Curvatures of quadrics fitted to the surface around each vertex.

#include <cstddef>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/functions/curvature.h"

namespace morsel::morse {

/// Vertices that determine a quadric, and twice as many, which a fit takes so that noise is averaged.
inline constexpr std::size_t kQuadricCoefficients = 6;
inline constexpr std::size_t kLeastFitted = 2 * kQuadricCoefficients;

struct QuadricCurvatures {
  PrincipalCurvatures curvatures;  ///< signs as those of principal_curvatures()
  std::size_t widened =
      0;  ///< vertices with fewer than kLeastFitted in their ball, which took whole rings instead
  std::size_t unfitted = 0;  ///< vertices that no quadric fits, which have Taubin's curvatures
};

/// Principal curvatures of z = a x² + b x y + c y² + d x + e y + f, fitted by least squares to all vertices
/// in the ball of the radius that are connected to the vertex there (see ConnectedBalls), z along the outward
/// area-weighted normal and the origin in the vertex: the degree-2 jet of Cazals and Pouget, "Estimating
/// differential quantities using polynomial fitting of osculating jets", 2003; Panozzo, Puppo, Rocca,
/// "Efficient multi-scale curvature and crease estimation", 2010, leave out f, so that the noise of the
/// vertex itself is not averaged. Curvatures are those of the graph of the quadric at x = y = 0, its slope
/// included.
///
/// With fewer than kLeastFitted vertices in the ball, whole rings around it are added until there are as
/// many. A vertex without a normal, or whose neighbours lie on or near a conic in the tangent plane (the
/// pivots of the equations are more than a factor of 1e8 apart), cannot be fitted. The radius is finite and
/// above 0, in the mesh's unit; throws InvalidArgument otherwise. O(n · vertices in a ball), parallel, the
/// same bits for every number of threads.
QuadricCurvatures quadric_curvatures(const core::TriangleMesh& mesh, double radius,
                                     const core::Progress& progress = {});

}  // namespace morsel::morse
