#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <stop_token>
#include <string_view>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/cholesky.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using morse::EdgeWeights;
using morse::VertexArea;

namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const core::Triangle& t : mesh.triangles())
    sum +=
        (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0])).norm() /
        2;
  return sum;
}

}  // namespace

TEST_CASE("cotangent weights of a right isosceles triangle") {
  const Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const TriangleMesh mesh = soup.mesh();
  const std::vector<double> weights = morse::edge_weights(mesh, EdgeWeights::cotangent);
  for (Index e = 0; e < 3; ++e) {
    const bool hypotenuse = mesh.edge_vertices(e) == std::array<Index, 2>{1, 2};
    CHECK(weights[e] == Approx(hypotenuse ? 0 : 0.5).margin(1e-14));
  }
  CHECK(morse::edge_weights(mesh, EdgeWeights::uniform) == std::vector<double>(3, 1.0));
  const std::vector<double> mixed = morse::vertex_areas(mesh, VertexArea::mixed);
  CHECK(mixed[0] == Approx(0.25));
  CHECK(mixed[1] == Approx(0.125));
  CHECK(mixed[2] == Approx(0.125));
}

TEST_CASE("clamped weights are the cotangents that are large enough") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const std::vector<double> plain = morse::edge_weights(mesh, EdgeWeights::cotangent);
    const std::vector<double> clamped = morse::edge_weights(mesh, EdgeWeights::clamped);
    for (std::size_t e = 0; e < plain.size(); ++e)
      CHECK(clamped[e] == std::max(plain[e], morse::kLeastWeight));
  }
}

TEST_CASE("the Laplacian is symmetric and has constants in its kernel") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const morse::SparseMatrix l = morse::laplacian(mesh, morse::edge_weights(mesh, EdgeWeights::cotangent));
    CHECK(l.nonZeros() == static_cast<long>(mesh.vertex_count() + 2 * mesh.edge_count()));
    CHECK(morse::SparseMatrix(l.transpose()).isApprox(l));
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(mesh.vertex_count());
    CHECK((l * one).cwiseAbs().maxCoeff() < 1e-12 * l.coeffs().cwiseAbs().maxCoeff());
    double asymmetry = 0;
    for (int column = 0; column < l.outerSize(); ++column)
      for (morse::SparseMatrix::InnerIterator it(l, column); it; ++it)
        asymmetry = std::max(asymmetry, std::abs(it.value() - l.coeff(column, it.row())));
    CHECK(asymmetry == 0);
  }
}

TEST_CASE("the cotangent Laplacian of a linear function vanishes inside a plane") {
  const TriangleMesh mesh = grid(7, 5).mesh();
  const morse::SparseMatrix l = morse::laplacian(mesh, morse::edge_weights(mesh, EdgeWeights::cotangent));
  Eigen::VectorXd f(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) f[v] = 3 * mesh.position(v).x() - 2 * mesh.position(v).y();
  const Eigen::VectorXd result = l * f;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.is_boundary_vertex(v)) CHECK(std::abs(result[v]) < 1e-12);
}

TEST_CASE("vertex areas sum to the surface") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    for (const VertexArea kind : {VertexArea::barycentric, VertexArea::mixed}) {
      const std::vector<double> areas = morse::vertex_areas(mesh, kind);
      CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) == Approx(area(mesh)));
      CHECK(*std::min_element(areas.begin(), areas.end()) > 0);
    }
  }
}

TEST_CASE("Cholesky solves what it has factorised at any number of threads") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    morse::SparseMatrix l = morse::laplacian(mesh, morse::edge_weights(mesh, EdgeWeights::clamped));
    for (int v = 0; v < l.rows(); ++v) l.coeffRef(v, v) += 0.1;
    const std::vector<double> b = random_values(mesh.vertex_count(), 5);
    const std::vector<double> x = morse::Cholesky(l, "test").solve(b);
    const Eigen::VectorXd back = l * Eigen::Map<const Eigen::VectorXd>(x.data(), l.rows());
    for (std::size_t v = 0; v < b.size(); ++v)
      CHECK(back[static_cast<long>(v)] == Approx(b[v]).margin(1e-11));
  }
}

TEST_CASE("Cholesky has the bits of Eigen's own factorisation") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    morse::SparseMatrix matrix =
        morse::laplacian(entry.mesh, morse::edge_weights(entry.mesh, morse::EdgeWeights::cotangent));
    for (int v = 0; v < matrix.rows(); ++v) matrix.coeffRef(v, v) += 0.1;
    const Eigen::SimplicialLDLT<morse::SparseMatrix> eigen(matrix);
    const std::vector<double> right = random_values(entry.mesh.vertex_count(), 9);
    const Eigen::VectorXd expected =
        eigen.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), matrix.rows()));
    const std::vector<double> solution = morse::Cholesky(matrix, "test").solve(right);
    CHECK(std::equal(solution.begin(), solution.end(), expected.begin(), expected.end()));
  }
}

TEST_CASE("a factorisation can be stopped") {
  const TriangleMesh mesh = grid(300, 300).mesh();
  const morse::SparseMatrix matrix = [&] {
    morse::SparseMatrix made = morse::laplacian(mesh, morse::edge_weights(mesh, morse::EdgeWeights::uniform));
    for (int v = 0; v < made.rows(); ++v) made.coeffRef(v, v) += 1;
    return made;
  }();
  std::stop_source stop;
  std::size_t calls = 0;
  double last = 0;
  const core::Progress progress(
      [&](std::string_view, double fraction) {
        last = fraction;
        if (++calls == 6) stop.request_stop();
      },
      stop.get_token());
  CHECK_THROWS_AS(morse::Cholesky(matrix, "test", progress), core::Cancelled);
  CHECK(calls == 6);
  CHECK(last > 0.2);
  CHECK(last < 1);
}

TEST_CASE("Cholesky refuses a singular matrix by name") {
  const morse::SparseMatrix nothing(3, 3);
  CHECK_THROWS_WITH(morse::Cholesky(nothing, "heat"), Catch::Contains("heat"));
  CHECK_THROWS_AS(morse::Cholesky(nothing, "heat"), core::BadInput);
}

TEST_CASE("vertex normals point outward and are unit vectors or zero") {
  for (const bool inward : {false, true}) {
    const TriangleMesh mesh =
        together(inward ? inside_out(sphere(2)) : sphere(2), inside_out(grid(3, 3))).mesh();
    const std::vector<Point> normals = morse::vertex_normals(mesh);
    for (Index v = 0; v < 162; ++v) CHECK(normals[v].dot(mesh.position(v)) > 0.99);
    for (Index v = 162; v < mesh.vertex_count(); ++v) CHECK(normals[v] == Point(0, 0, -1));
  }
  const TriangleMesh ball = sphere(1).mesh();
  const TriangleMesh point = ball.with_positions(std::vector<Point>(ball.vertex_count(), Point(1, 2, 3)));
  CHECK(morse::vertex_normals(point)[4] == Point(0, 0, 0));
}

TEST_CASE("unit-sized surfaces lose no digit") {
  const TriangleMesh mesh = jittered(torus(9, 7).mesh(), 0.1, 3);
  for (const int exponent : {-1050, -3, 0, 5, 500}) {
    std::vector<Point> positions;
    for (const Point& p : mesh.positions())
      positions.emplace_back(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent),
                             std::ldexp(p.z(), exponent));
    const TriangleMesh other = mesh.with_positions(positions);
    const morse::UnitSized unit = morse::unit_sized(other);
    const double side = (unit.mesh.bounding_box().max - unit.mesh.bounding_box().min).maxCoeff();
    CHECK(side >= 1);
    CHECK(side < 2);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(std::ldexp(unit.mesh.position(v).x(), unit.exponent) == other.position(v).x());
  }
}
