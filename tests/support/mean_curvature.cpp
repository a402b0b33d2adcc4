#include "support/mean_curvature.h"

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace morsel::test {

std::vector<double> plain_mean_curvature(const TriangleMesh& mesh) {
  const Index n = mesh.vertex_count();
  const auto area_vector = [&](Index t) {
    const auto& [a, b, c] = mesh.triangle(t);
    return Point((mesh.position(b) - mesh.position(a)).cross(mesh.position(c) - mesh.position(a)));
  };
  std::vector<Point> normals(n, Point::Zero());
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    for (const Index v : mesh.triangle(t)) normals[v] += area_vector(t);
  std::vector<double> sum(n, 0);
  std::vector<double> weights(n, 0);
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Index h = mesh.edge_halfedge(e);
    double area = area_vector(TriangleMesh::triangle_of(h)).norm();
    if (mesh.twin(h) != core::kNone) area += area_vector(TriangleMesh::triangle_of(mesh.twin(h))).norm();
    const auto [a, b] = mesh.edge_vertices(e);
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      const Point difference = mesh.position(i) - mesh.position(j);
      sum[i] += area * 2 * normals[i].normalized().dot(difference) / difference.squaredNorm();
      weights[i] += area;
    }
  }
  for (Index v = 0; v < n; ++v) sum[v] /= weights[v];
  return sum;
}

TriangleMesh read_plain_off(const std::string& path) {
  std::ifstream in(path);
  std::string magic;
  std::size_t vertices = 0, faces = 0, edges = 0;
  in >> magic >> vertices >> faces >> edges;
  if (!in || magic != "OFF") throw std::runtime_error(path + " is not a plain OFF file");
  Soup soup;
  for (std::size_t v = 0; v < vertices; ++v) {
    Point p;
    in >> p.x() >> p.y() >> p.z();
    soup.positions.push_back(p);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    int corners = 0;
    core::Triangle t;
    in >> corners >> t[0] >> t[1] >> t[2];
    if (corners != 3) throw std::runtime_error(path + " has a face that is not a triangle");
    soup.triangles.push_back(t);
  }
  if (!in) throw std::runtime_error(path + " ends too early");
  return soup.mesh();
}

}  // namespace morsel::test
