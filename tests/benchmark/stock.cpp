#include "benchmark/stock.h"

#include <Spectra/SymGEigsShiftSolver.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <vector>

#include "morsel/core/mesh/neighbors.h"

namespace morsel::benchmark::stock {
namespace {

using core::Index;
using core::Point;
using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

Matrix cotangent_matrix(const core::TriangleMesh& mesh) {
  Triplets entries;
  for (const core::Triangle& t : mesh.triangles())
    for (int i = 0; i < 3; ++i) {
      const Index a = t[(i + 1) % 3];
      const Index b = t[(i + 2) % 3];
      const Point u = mesh.position(a) - mesh.position(t[i]);
      const Point v = mesh.position(b) - mesh.position(t[i]);
      const double half = u.dot(v) / u.cross(v).norm() / 2;
      entries.emplace_back(a, b, -half);
      entries.emplace_back(b, a, -half);
      entries.emplace_back(a, a, half);
      entries.emplace_back(b, b, half);
    }
  Matrix matrix(mesh.vertex_count(), mesh.vertex_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Matrix mass_matrix(const core::TriangleMesh& mesh) {
  Triplets entries;
  for (const core::Triangle& t : mesh.triangles()) {
    const double area =
        (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0])).norm() /
        2;
    for (const Index v : t) entries.emplace_back(v, v, area / 3);
  }
  Matrix matrix(mesh.vertex_count(), mesh.vertex_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double mean_edge(const core::TriangleMesh& mesh) {
  double sum = 0;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    sum += (mesh.position(a) - mesh.position(b)).norm();
  }
  return sum / mesh.edge_count();
}

Vector copy(std::span<const double> values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

double geodesic(const core::TriangleMesh& mesh, Index source) {
  const Matrix laplacian = cotangent_matrix(mesh);
  const double edge = mean_edge(mesh);
  const Matrix heat = mass_matrix(mesh) + edge * edge * laplacian;
  const Eigen::SimplicialLDLT<Matrix> heat_solver(heat);
  Matrix shifted = laplacian;
  for (int v = 0; v < shifted.rows(); ++v) shifted.coeffRef(v, v) += 1e-8;
  const Eigen::SimplicialLDLT<Matrix> poisson_solver(shifted);
  Vector start = Vector::Zero(mesh.vertex_count());
  start[source] = 1;
  const Vector u = heat_solver.solve(start);
  Vector divergence = Vector::Zero(mesh.vertex_count());
  for (const core::Triangle& t : mesh.triangles()) {
    const Point* p[3] = {&mesh.position(t[0]), &mesh.position(t[1]), &mesh.position(t[2])};
    const Point normal = (*p[1] - *p[0]).cross(*p[2] - *p[0]);
    Point gradient = Point::Zero();
    for (int i = 0; i < 3; ++i) gradient += u[t[i]] * normal.cross(*p[(i + 2) % 3] - *p[(i + 1) % 3]);
    const Point x = -gradient.normalized();
    for (int i = 0; i < 3; ++i) {
      const Point a = *p[(i + 1) % 3] - *p[i];
      const Point b = *p[(i + 2) % 3] - *p[i];
      const Point c = *p[(i + 2) % 3] - *p[(i + 1) % 3];
      const double area = normal.norm();
      divergence[t[i]] += (b.dot(c) / area * a.dot(x) + a.dot(-c) / area * b.dot(x)) / 2;
    }
  }
  const Vector distance = poisson_solver.solve(-divergence);
  return distance.maxCoeff() - distance[source];
}

double eigenfunctions(const core::TriangleMesh& mesh, int count) {
  const Matrix laplacian = cotangent_matrix(mesh);
  const Matrix mass = mass_matrix(mesh);
  using Operator = Spectra::SymShiftInvert<double, Eigen::Sparse, Eigen::Sparse>;
  using Product = Spectra::SparseSymMatProd<double>;
  Operator inverse(laplacian, mass);
  Product product(mass);
  Spectra::SymGEigsShiftSolver<Operator, Product, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, product, count + 1, 2 * count + 20, -1e-3);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn);
  return solver.eigenvalues()[0];
}

double laplacian(const core::TriangleMesh& mesh, std::span<const double> values) {
  Triplets entries;
  std::vector<int> degree(mesh.vertex_count(), 0);
  for (Index e = 0; e < mesh.edge_count(); ++e)
    for (const Index v : mesh.edge_vertices(e)) ++degree[v];
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    entries.emplace_back(a, b, 0.5 / degree[a]);
    entries.emplace_back(b, a, 0.5 / degree[b]);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) entries.emplace_back(v, v, 0.5);
  Matrix step(mesh.vertex_count(), mesh.vertex_count());
  step.setFromTriplets(entries.begin(), entries.end());
  Vector f = copy(values);
  for (int i = 0; i < 10; ++i) f = Vector(step * f);
  return f[0];
}

double implicit_laplacian(const core::TriangleMesh& mesh, std::span<const double> values, double time) {
  const Matrix mass = mass_matrix(mesh);
  const Matrix system = mass + time * cotangent_matrix(mesh);
  const Eigen::SimplicialLDLT<Matrix> solver(system);
  Vector f = copy(values);
  for (int i = 0; i < 10; ++i) f = solver.solve(mass * f);
  return f[0];
}

double gaussian(const core::TriangleMesh& mesh, std::span<const double> values, double sigma) {
  const core::PointSearch search(mesh.positions());
  std::vector<Index> found;
  std::vector<double> result(values.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    search.within(mesh.position(v), 2 * sigma, found);
    double sum = 0;
    double weights = 0;
    for (const Index x : found) {
      const double weight =
          std::exp(-(mesh.position(x) - mesh.position(v)).squaredNorm() / (2 * sigma * sigma));
      sum += weight * values[x];
      weights += weight;
    }
    result[v] = sum / weights;
  }
  return result[0];
}

double quadric_curvature(const core::TriangleMesh& mesh, double radius) {
  std::vector<Point> normals(mesh.vertex_count(), Point::Zero());
  for (const core::Triangle& t : mesh.triangles()) {
    const Point normal =
        (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0]));
    for (const Index v : t) normals[v] += normal;
  }
  const core::PointSearch search(mesh.positions());
  std::vector<Index> found;
  double total = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    search.within(mesh.position(v), radius, found);
    const Point n = normals[v].normalized();
    const Point x = n.unitOrthogonal();
    const Point y = n.cross(x);
    Eigen::MatrixXd rows(found.size(), 5);
    Vector heights(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Point d = mesh.position(found[k]) - mesh.position(v);
      const double a = d.dot(x);
      const double b = d.dot(y);
      rows.row(static_cast<Eigen::Index>(k)) << a * a, a * b, b * b, a, b;
      heights[static_cast<Eigen::Index>(k)] = d.dot(n);
    }
    const Vector c = rows.colPivHouseholderQr().solve(heights);
    const double w = 1 + c[3] * c[3] + c[4] * c[4];
    total -= ((1 + c[4] * c[4]) * 2 * c[0] - 2 * c[3] * c[4] * c[1] + (1 + c[3] * c[3]) * 2 * c[2]) /
             (2 * std::pow(w, 1.5));
  }
  return total;
}

}  // namespace morsel::benchmark::stock
