#pragma once
/// New methods and functions as one would write them with well-kept libraries (Eigen, Spectra, nanoflann),
/// the way geometry processing libraries do, on one thread: baselines. Each returns one value of its result,
/// so that nothing is left out.

#include <cstddef>
#include <span>

#include "morsel/core/mesh/mesh.h"

namespace morsel::benchmark::stock {

/// The heat method from one source: cotangent matrix from triplets, two factorisations, two solves.
double geodesic(const core::TriangleMesh& mesh, core::Index source);

/// The lowest `count` eigenpairs by Spectra's generalised shift-invert solver as it comes.
double eigenfunctions(const core::TriangleMesh& mesh, int count);

/// Ten explicit steps with a row-stochastic sparse matrix.
double laplacian(const core::TriangleMesh& mesh, std::span<const double> values);

/// Ten implicit steps of the heat equation: one factorisation.
double implicit_laplacian(const core::TriangleMesh& mesh, std::span<const double> values, double time);

/// Gaussian averages over the ball of radius 2σ, by a radius search for each vertex.
double gaussian(const core::TriangleMesh& mesh, std::span<const double> values, double sigma);

/// Mean curvature of a quadric fitted by QR decomposition to the vertices within `radius`, for each vertex.
double quadric_curvature(const core::TriangleMesh& mesh, double radius);

}  // namespace morsel::benchmark::stock
