#pragma once
/// Inputs on which a careless algorithm needs time quadratic in their size; for tests and the benchmark.

#include <cstddef>
#include <string>
#include <vector>

#include "support/meshes.h"

namespace morsel::test::adversarial {

/// An ASCII PLY file of a triangle whose vertices have so many properties.
std::string ply_with_properties(std::size_t count);
/// The same with so many elements of no instances after vertices and faces.
std::string ply_with_elements(std::size_t count);

/// Points on a line whose hash in STL welding agrees in the last 24 bits.
std::vector<Point> colliding_points(std::size_t count);
/// An ASCII STL file: each three consecutive points are a triangle.
std::string ascii_stl(const std::vector<Point>& points);

/// So many tetrahedra, apart.
TriangleMesh tetrahedra(std::size_t count);
/// A sheet with about so many square holes (a square number of them), its vertices a little out of place.
TriangleMesh pierced_sheet(std::size_t holes);

}  // namespace morsel::test::adversarial
