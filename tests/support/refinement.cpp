#include "support/refinement.h"

#include <array>
#include <random>

namespace morsel::test {

Soup refined(const TriangleMesh& mesh, int pieces) {
  const auto m = static_cast<Index>(pieces);
  const Index on_edge = m - 1;
  const Index inside = (m - 1) * (m - 2) / 2;  // a triangle
  const Index first_on_edges = mesh.vertex_count();
  const Index first_inside = first_on_edges + on_edge * mesh.edge_count();
  Soup soup;
  soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
  soup.positions.reserve(first_inside + static_cast<std::size_t>(inside) * mesh.triangle_count());
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    for (Index i = 1; i < m; ++i)
      soup.positions.push_back((mesh.position(a) * (m - i) + mesh.position(b) * i) / m);
  }
  // Vertex (i, j) of triangle t: i steps from corner 0 to corner 1, j to corner 2.
  const auto vertex = [&](Index t, Index i, Index j) {
    const Index k = m - i - j;
    const core::Triangle& corners = mesh.triangle(t);
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
  soup.triangles.reserve(std::size_t{m} * m * mesh.triangle_count());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const std::array<Point, 3> corner = {mesh.position(mesh.triangle(t)[0]),
                                         mesh.position(mesh.triangle(t)[1]),
                                         mesh.position(mesh.triangle(t)[2])};
    for (Index j = 1; j < m; ++j)
      for (Index i = 1; i + j < m; ++i)
        soup.positions.push_back((corner[0] * (m - i - j) + corner[1] * i + corner[2] * j) / m);
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i + j < m; ++i) {
        soup.triangles.push_back({vertex(t, i, j), vertex(t, i + 1, j), vertex(t, i, j + 1)});
        if (i + j + 1 < m)
          soup.triangles.push_back({vertex(t, i + 1, j), vertex(t, i + 1, j + 1), vertex(t, i, j + 1)});
      }
  }
  return soup;
}

void add_noise(Soup& soup, double share, unsigned seed) {
  double sum = 0;
  for (const core::Triangle& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) sum += (soup.positions[t[i]] - soup.positions[t[(i + 1) % 3]]).norm();
  const double most = share * sum / (3.0 * static_cast<double>(soup.triangles.size()));
  std::mt19937 generator(seed);
  for (Point& p : soup.positions)
    for (int axis = 0; axis < 3;
         ++axis)  // the generator's own numbers: distributions differ between libraries
      p[axis] += most * (2.0 * generator() / std::mt19937::max() - 1);
}

}  // namespace morsel::test
