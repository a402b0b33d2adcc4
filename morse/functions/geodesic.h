#pragma once
/// Geodesic distance as a Morse function.

#include <memory>
#include <span>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/morse/operators/heat_distance.h"

namespace morsel::morse {

struct GeodesicOptions {
  double time = 1;  ///< HeatOptions::time
  HeatBoundary boundary = HeatBoundary::average;
  bool delaunay = true;  ///< HeatOptions::delaunay
};

struct GeodesicResult {
  core::ScalarField field;
  double time;  ///< that heat flowed, in the mesh's squared unit
};

/// The distance along the surface of every vertex to the nearest source, by the heat method
/// (operators/heat_distance.h), in the mesh's unit; exactly 0 at sources, positive elsewhere. Throws
/// InvalidArgument if there is no source or a source is not a vertex of the mesh, and what HeatDistance
/// throws: BadInput if a component has no source.
GeodesicResult geodesic_distance(const core::TriangleMesh& mesh, std::span<const core::Index> sources,
                                 const GeodesicOptions& options = {}, const core::Progress& progress = {});

struct AverageGeodesicResult {
  core::ScalarField field;
  double time;
  std::vector<core::Index> samples;  ///< the base points; fewer than asked for on a small mesh
};

/// The average geodesic distance of each vertex from the surface: low in the middle, high at the ends
/// (Hilaga, Shinagawa, Kohmura, Kunii 2001, "Topology matching", 3.2):
///
///   f(v) = Σ_i g(v, b_i) · area(b_i) / Σ_i area(b_i)
///
/// with base points b_i by farthest-point sampling (operators/edge_paths.h) and the area of the vertices that
/// are nearer to b_i, along edges, than to other ones. The paper's integral is this times the surface's area,
/// and its normalised form (f − min f)/max f: neither changes a critical point, so here it stays a length.
/// The paper measures g along edges, here it is the heat method's distance.
///
/// Factorises once; the samples are solved in parallel. The same bits for every number of threads. Throws
/// InvalidArgument on no samples, and BadInput on a mesh of several components, between which there is no
/// distance.
AverageGeodesicResult average_geodesic_distance(const core::TriangleMesh& mesh, std::size_t samples,
                                                const GeodesicOptions& options = {},
                                                const core::Progress& progress = {});

/// Keys: mode=distance|average (default distance), source=12/40 (vertices of the input file) or the lowest or
/// highest vertex along an axis, min-x … max-z (required by distance), samples (average, default 50),
/// time, boundary=average|neumann|dirichlet, delaunay=true|false. A vertex that does not exist throws
/// BadInput.
std::unique_ptr<core::MorseFunction> make_geodesic(core::ParameterReader& reader);

}  // namespace morsel::morse
