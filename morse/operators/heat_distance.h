#pragma once
/// Geodesic distance by short heat flow.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// What holds at boundaries while heat flows.
enum class HeatBoundary : std::uint8_t {
  average,   ///< the mean of both solutions (the paper's choice): distances hardly depend on the boundary
  neumann,   ///< no flow through it: level lines meet it at right angles
  dirichlet  ///< no heat on it: level lines run along it
};

struct HeatOptions {
  /// The time t that heat flows, as a multiple of the squared mean length of the edges. Small is sharp, large
  /// is smooth.
  double time = 1;
  /// No vertex is farther from its source than this, in the mesh's unit. Heat falls as exp(−distance/√t) and
  /// must not underflow, so t is at least (reach/500)²; this matters beyond about 500 edges.
  double reach = 0;
  HeatBoundary boundary = HeatBoundary::average;
  /// Whether heat flows on the intrinsic Delaunay triangulation (intrinsic_triangles.h) instead of the mesh's
  /// triangles: a better answer for the same vertices, where triangles are long and thin.
  bool delaunay = true;
};

/// Distances along a surface (Crane, Weischedel, Wardetzky 2013, "Geodesics in heat"): heat u from the
/// sources after time t, (M + t L) u = δ; its direction X = −∇u/‖∇u‖ in each triangle; the function whose
/// gradient is nearest to it, L φ = ∇·X. Cotangent Laplacian L and barycentric areas M with the lengths of
/// edge_lengths.h, so that degenerate triangles are allowed. The error is of the order of an edge's length;
/// where triangles are large, that adds local extrema of its size.
///
/// Factorises in the constructor, n^1.5, serial; then each set of sources takes O(n log n). Immutable, may be
/// used from several threads at once.
class HeatDistance {
 public:
  /// Throws InvalidArgument if the time is not positive, BadInput if the surface has no extent.
  HeatDistance(const core::TriangleMesh& mesh, const HeatOptions& options,
               const core::Progress& progress = {});
  ~HeatDistance();

  /// The distance of each vertex to the nearest of the sources (vertices), in the mesh's unit: exactly 0
  /// there and never negative (a negative result next to a source is replaced by the straight line's length).
  /// φ is given up to a constant for each component: its mean at the sources is made 0. Throws BadInput,
  /// saying how many, if there are components without a source, or, with dirichlet, with all their sources on
  /// the boundary.
  std::vector<double> from(std::span<const core::Index> sources) const;

  /// t in the mesh's squared unit.
  double time() const;

 private:
  struct Operators;
  std::unique_ptr<const Operators> operators_;
};

}  // namespace morsel::morse
