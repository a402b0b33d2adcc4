#include "support/path_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace morsel::test {
namespace {

double length(const TriangleMesh& mesh, Index a, Index b) {
  return (mesh.position(a) - mesh.position(b)).norm();
}

double angle_at(const TriangleMesh& mesh, Index corner, Index a, Index b) {
  const Point u = mesh.position(a) - mesh.position(corner);
  const Point v = mesh.position(b) - mesh.position(corner);
  return std::acos(std::clamp(u.dot(v) / (u.norm() * v.norm()), -1.0, 1.0));
}

/// From p to q over the edge ab; infinite if the straight line passes beside it.
double over(const TriangleMesh& mesh, Index a, Index b, Index p, Index q) {
  const double at_a = angle_at(mesh, a, b, p) + angle_at(mesh, a, b, q);
  const double at_b = angle_at(mesh, b, a, p) + angle_at(mesh, b, a, q);
  if (at_a > std::numbers::pi || at_b > std::numbers::pi) return HUGE_VAL;
  const double ap = length(mesh, a, p);
  const double aq = length(mesh, a, q);
  return std::sqrt(std::max(0.0, ap * ap + aq * aq - 2 * ap * aq * std::cos(at_a)));
}

}  // namespace

std::vector<std::vector<double>> all_distances(const TriangleMesh& mesh) {
  const Index n = mesh.vertex_count();
  std::vector<std::vector<double>> distance(n, std::vector<double>(n, HUGE_VAL));
  const auto lower = [&](Index a, Index b, double d) {
    distance[a][b] = std::min(distance[a][b], d);
    distance[b][a] = std::min(distance[b][a], d);
  };
  for (Index v = 0; v < n; ++v) distance[v][v] = 0;
  for (const core::Triangle& one : mesh.triangles()) {
    for (int i = 0; i < 3; ++i) lower(one[i], one[(i + 1) % 3], length(mesh, one[i], one[(i + 1) % 3]));
    for (const core::Triangle& other : mesh.triangles())
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (one[i] == other[(j + 1) % 3] && one[(i + 1) % 3] == other[j])
            lower(one[(i + 2) % 3], other[(j + 2) % 3],
                  over(mesh, one[i], one[(i + 1) % 3], one[(i + 2) % 3], other[(j + 2) % 3]));
  }
  for (Index k = 0; k < n; ++k)
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b)
        distance[a][b] = std::min(distance[a][b], distance[a][k] + distance[k][b]);
  return distance;
}

}  // namespace morsel::test
