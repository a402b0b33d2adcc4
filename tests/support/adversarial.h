#pragma once
/// Inputs on which a careless algorithm needs time quadratic in their size; for tests and the benchmark.

#include <array>
#include <cstddef>
#include <functional>
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

/// Edges whose hash in the triangulation of polygons agrees in the last 24 bits.
std::vector<std::array<Index, 2>> colliding_edges(std::size_t count);

/// Simple polygons in the plane z = 0, counter-clockwise, by about their number of corners.
struct PolygonFamily {
  std::string name;
  std::function<std::vector<Point>(std::size_t corners)> make;
};
std::vector<PolygonFamily> simple_polygons();
/// Two of them: long teeth, and the outline of a random maze without a cycle, thousands of whose corners lie
/// around any ear.
std::vector<Point> comb(std::size_t corners);
std::vector<Point> maze(std::size_t corners, unsigned seed);

/// A PDB file of so many frames of an atom each, without MODEL records.
std::string pdb_of_frames(std::size_t count);
/// One of so many atoms whose chains are A, B, A, B, …, then Z, A, Z, A, …
std::string pdb_of_alternating_chains(std::size_t count);
/// An mmCIF file of so many models of an atom each, in a chain of its own.
std::string mmcif_of_models(std::size_t count);
/// A CIF file of so many blocks that say nothing about atoms.
std::string cif_of_blocks(std::size_t count);

/// Triangles that all have one edge; a fan around one vertex; triangles on the same vertices; triangles apart
/// from one another.
Soup book(std::size_t pages);
Soup fan(std::size_t triangles);
Soup duplicates(std::size_t triangles);
Soup apart(std::size_t triangles);

}  // namespace morsel::test::adversarial
