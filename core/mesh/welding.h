#pragma once
/// Welding: vertices of a file that coincide, exactly or within a length, become one.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// Per vertex the representative that it joins, itself where it joins none. In the order of their numbers,
/// each vertex joins the representative with the smallest number that is no farther away than `length`, or
/// becomes a representative. So representatives are farther apart than `length`, and two vertices that join
/// the same one may be up to twice as far apart. With 0, vertices join at the same position (−0 is 0).
/// Vertices with a non-finite coordinate join none. Serial, deterministic, O(n) as a rule and O(n log n) at
/// worst. Throws InvalidArgument if `length` is negative or not finite.
std::vector<Index> coincident_vertices(std::span<const Point> positions, double length = 0,
                                       const Progress& progress = {});

/// The length in the unit of the soup, as Length::on() has it of a mesh: vertices with a non-finite
/// coordinate do not count, edges are the sides of all polygons, and areas those of polygons by their vector
/// area. Corners that name no such vertex are left out, with their edges and polygons. O(n).
double length_on(const Length& length, const PolygonSoup& soup);

/// What weld() makes of a soup.
struct WeldedSoup {
  /// The vertices that are left, in their order; polygons keep their numbers.
  PolygonSoup soup;
  VertexNumbering numbering;  ///< to the unwelded soup; tables are empty if nothing was joined
  std::size_t joined = 0;     ///< vertices that became another one
  /// Per polygon whether joining left fewer than three different vertices of it: it is no face any more and
  /// has no corner here. Empty if there is none.
  std::vector<bool> collapsed;
  std::size_t collapsed_count = 0;
};

/// Replaces every vertex by its representative. In polygons that lose a vertex so, consecutive corners on the
/// same vertex become one, and sides that run back and forth between two vertices go. O(n log n).
WeldedSoup weld(PolygonSoup soup, double length, const Progress& progress = {});

/// The number of vertices that would be joined with others by welding at boundary edges: those at the ends of
/// boundary edges that lie on other boundary edges. Copies of the same input vertex, as repair makes them
/// where it splits one, do not count. O(n log n) for n boundary edges, O(1) on a closed mesh.
Index count_unwelded(const TriangleMesh& mesh, const VertexNumbering& numbering = {},
                     const Progress& progress = {});

/// The sentence about them: "798 of 960 vertices coincide with others …"; empty if there are none.
std::string unwelded_warning(const TriangleMesh& mesh, const VertexNumbering& numbering = {},
                             const Progress& progress = {});

/// How values of joined vertices differ.
struct JoinedDifference {
  std::size_t count = 0;  ///< vertices with another value than the one that they joined
  double largest = 0;     ///< the largest difference of finite values
};
/// Compares the values of all vertices of the input, by its numbers, with those that the mesh takes. Throws
/// InvalidArgument if their number is not the input's. O(n).
JoinedDifference compare_joined(const VertexNumbering& numbering, std::span<const double> values);

}  // namespace morsel::core
