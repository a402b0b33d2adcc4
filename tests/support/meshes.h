#pragma once
/// Named families of meshes for the tests; all made here, none read from a file.

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/mesh/mesh_builder.h"

namespace morsel::test {

using core::Index;
using core::Point;
using core::TriangleMesh;

/// Positions and triangles before they become a mesh, for tests that break rules.
struct Soup {
  std::vector<Point> positions;
  std::vector<core::Triangle> triangles;
  TriangleMesh mesh() const { return {positions, triangles}; }
  core::PolygonSoup polygons() const;
};

// Drawn by hand.
Soup tetrahedron();  ///< 4 vertices, closed, outward
Soup octahedron();   ///< 6 vertices: 0 = +z, 1 = −z, 2…5 around the equator
Soup single_triangle();
Soup square_pair();         ///< two triangles, 4 vertices
Soup wheel(int spokes);     ///< vertex 0 in the middle of a disc, the rim counter-clockwise
Soup bipyramid(int sides);  ///< closed; vertices 0 and 1 have degree `sides`

// Families.
Soup sphere(int subdivisions);        ///< icosphere: 10·4^s + 2 vertices
Soup torus(int around, int along);    ///< around × along vertices, genus 1
Soup grid(int columns, int rows);     ///< columns × rows vertices, a disc
Soup annulus(int around, int rings);  ///< two boundary loops
/// A slab of cubes with `holes` holes through it: closed, genus `holes`.
Soup pierced_slab(int holes);
/// A sphere with `holes` separate vertices' stars removed: that many boundary loops.
Soup punctured_sphere(int subdivisions, int holes);
Soup moebius(int around);  ///< not orientable
/// Both, apart, the second's vertices after the first's.
Soup together(const Soup& a, const Soup& b);
/// The same surface with vertices renumbered and triangles reordered and turned by a seeded shuffle.
Soup shuffled(const Soup& soup, unsigned seed, std::vector<Index>* new_number = nullptr);

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// One mesh of every family: closed and bounded, genus 0 to 3, one and several components, tiny and small.
const std::vector<NamedMesh>& mesh_zoo();

/// Folder of the sample meshes (MORSEL_SAMPLES); throws if it is missing, so that no test passes by skipping.
std::string sample(const std::string& file);

}  // namespace morsel::test
