#pragma once
/// Surfaces of known curvature, and surfaces that are moved, scaled or disturbed.

#include <Eigen/Core>

#include "support/meshes.h"

namespace morsel::test {

TriangleMesh scaled(const TriangleMesh& mesh, double factor);
/// Each coordinate moved by up to `amount`: positions without symmetry, and no distance at a cut-off.
TriangleMesh jittered(const TriangleMesh& mesh, double amount, unsigned seed);
TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Matrix3d& linear, const Point& offset);
Soup inside_out(Soup soup);
/// A strip of equilateral triangles rolled into a cylinder about z: each inner vertex has six neighbours, 60°
/// apart, so that Taubin's sums over directions are exact.
Soup cylinder(double radius, int around, int rows);

/// A sphere of radius 1 with a bump of height 0.5 in the direction of each of the tips, which are unit
/// vectors.
TriangleMesh with_tips(const std::vector<Point>& tips, int subdivisions = 4);
/// The vertex nearest to each of some places.
std::vector<Index> nearest_vertices(const TriangleMesh& mesh, const std::vector<Point>& places);

}  // namespace morsel::test
