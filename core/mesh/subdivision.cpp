#include "morsel/core/mesh/subdivision.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"

namespace morsel::core {

TriangleMesh subdivided(const TriangleMesh& mesh, int pieces) {
  if (pieces < 1) throw InvalidArgument("an edge cannot be cut into " + std::to_string(pieces) + " pieces");
  const auto m = static_cast<Index>(pieces);
  if (std::uint64_t{m} * m * mesh.triangle_count() > kNone / 3)
    throw BadInput("a mesh of " + std::to_string(mesh.triangle_count()) +
                   " triangles cannot be subdivided by " + std::to_string(pieces) +
                   ": no mesh can have so many triangles");
  const Index on_edge = m - 1;
  const Index inside = (m - 1) * (m - 2) / 2;  // a triangle
  const Index first_on_edges = mesh.vertex_count();
  const Index first_inside = first_on_edges + on_edge * mesh.edge_count();
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  positions.reserve(first_inside + static_cast<std::size_t>(inside) * mesh.triangle_count());
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    for (Index i = 1; i < m; ++i)
      positions.push_back((mesh.position(a) * (m - i) + mesh.position(b) * i) / m);
  }
  // Vertex (i, j) of triangle t: i steps from corner 0 to corner 1, j to corner 2.
  const auto vertex = [&](Index t, Index i, Index j) {
    const Index k = m - i - j;
    const Triangle& corners = mesh.triangle(t);
    if (i == m) return corners[1];
    if (j == m) return corners[2];
    if (k == m) return corners[0];
    const auto along = [&](Index side, Index step) {  // `step` from the origin of half-edge 3t + side
      const Index e = mesh.edge(3 * t + side);
      const bool forward = mesh.edge_vertices(e)[0] == corners[side];
      return first_on_edges + e * on_edge + (forward ? step : m - step) - 1;
    };
    if (j == 0) return along(0, i);
    if (k == 0) return along(1, j);
    if (i == 0) return along(2, k);
    // Rows of equal j, the first the longest.
    return first_inside + t * inside + (j - 1) * (m - 1) - j * (j - 1) / 2 + (i - 1);
  };
  std::vector<Triangle> triangles;
  triangles.reserve(std::size_t{m} * m * mesh.triangle_count());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const std::array<Point, 3> corner = {mesh.position(mesh.triangle(t)[0]),
                                         mesh.position(mesh.triangle(t)[1]),
                                         mesh.position(mesh.triangle(t)[2])};
    for (Index j = 1; j < m; ++j)
      for (Index i = 1; i + j < m; ++i)
        positions.push_back((corner[0] * (m - i - j) + corner[1] * i + corner[2] * j) / m);
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i + j < m; ++i) {
        triangles.push_back({vertex(t, i, j), vertex(t, i + 1, j), vertex(t, i, j + 1)});
        if (i + j + 1 < m)
          triangles.push_back({vertex(t, i + 1, j), vertex(t, i + 1, j + 1), vertex(t, i, j + 1)});
      }
  }
  return {std::move(positions), std::move(triangles)};
}

}  // namespace morsel::core
