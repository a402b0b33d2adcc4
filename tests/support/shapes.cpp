#include "support/shapes.h"

#include <cmath>
#include <utility>

#include "support/fields.h"

namespace morsel::test {

TriangleMesh scaled(const TriangleMesh& mesh, double factor) {
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  for (Point& p : positions) p *= factor;
  return mesh.with_positions(std::move(positions));
}

TriangleMesh jittered(const TriangleMesh& mesh, double amount, unsigned seed) {
  const std::vector<double> noise = random_values(3 * std::size_t{mesh.vertex_count()}, seed);
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      positions[v][axis] += amount * (2 * noise[3 * v + static_cast<std::size_t>(axis)] - 1);
  return mesh.with_positions(std::move(positions));
}

Soup inside_out(Soup soup) {
  for (core::Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  return soup;
}

Soup cylinder(double radius, int around, int rows) {
  Soup soup;
  const double step = 2 * M_PI / around;
  const double height = radius * step * std::sqrt(3.0) / 2;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      const double angle = step * (j + 0.5 * (i % 2));
      soup.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * i);
    }
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < around; ++j) {
      const auto at = [&](int row, int k) {
        return static_cast<Index>(row * around + (k + around) % around);
      };
      const int shift = i % 2;
      soup.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + shift)});
      soup.triangles.push_back({at(i, j), at(i + 1, j + shift), at(i + 1, j + shift - 1)});
    }
  return soup;
}

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Matrix3d& linear, const Point& offset) {
  std::vector<Point> positions;
  for (const Point& p : mesh.positions()) positions.push_back(linear * p + offset);
  return mesh.with_positions(std::move(positions));
}

TriangleMesh with_tips(const std::vector<Point>& tips, int subdivisions) {
  const Soup ball = sphere(subdivisions);
  std::vector<Point> positions;
  for (const Point& p : ball.positions) {
    double height = 0;
    for (const Point& tip : tips) height += 0.5 * std::exp(-(p - tip).squaredNorm() / 0.08);
    positions.push_back(p * (1 + height));
  }
  return ball.mesh().with_positions(std::move(positions));
}

std::vector<Index> nearest_vertices(const TriangleMesh& mesh, const std::vector<Point>& places) {
  std::vector<Index> vertices;
  for (const Point& place : places) {
    Index nearest = 0;
    for (Index v = 1; v < mesh.vertex_count(); ++v)
      if ((mesh.position(v) - place).norm() < (mesh.position(nearest) - place).norm()) nearest = v;
    vertices.push_back(nearest);
  }
  return vertices;
}

}  // namespace morsel::test
