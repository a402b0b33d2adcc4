#include "morsel/morse/operators/eigenfunctions.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/eigenfunction.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/laplacian.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using morse::Eigenfunction;
using std::numbers::pi;

namespace {

std::vector<double> areas_of(const TriangleMesh& mesh) {
  const morse::EdgeLengths lengths = morse::edge_lengths(mesh);
  std::vector<double> areas = morse::barycentric_areas(mesh, lengths);
  for (double& area : areas) area *= lengths.unit * lengths.unit;
  return areas;
}

double product(const std::vector<double>& areas, const std::vector<double>& f, const std::vector<double>& g) {
  double sum = 0;
  for (std::size_t v = 0; v < f.size(); ++v) sum += areas[v] * f[v] * g[v];
  return sum;
}

TriangleMesh rectangle(double width, double height, int columns, int rows) {
  Soup soup = grid(columns, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      soup.positions[static_cast<std::size_t>(y * columns + x)] = {width * x / (columns - 1),
                                                                   height * y / (rows - 1), 0};
  return soup.mesh();
}

core::FunctionResult evaluate_eigenfunction(const TriangleMesh& mesh, Given given) {
  return made(morse::make_eigenfunction, "eigenfunction", std::move(given))->evaluate(mesh, {});
}

}  // namespace

TEST_CASE("edge lengths are those of the mesh unless a triangle is degenerate") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const morse::EdgeLengths lengths = morse::edge_lengths(mesh);
    CHECK(lengths.added == 0);
    const std::vector<double> plain = morse::edge_weights(mesh, morse::EdgeWeights::cotangent);
    const std::vector<double> intrinsic = morse::cotangent_weights(mesh, lengths);
    const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::barycentric);
    const std::vector<double> same = areas_of(mesh);
    for (std::size_t e = 0; e < plain.size(); ++e) CHECK(intrinsic[e] == Approx(plain[e]).margin(1e-12));
    for (std::size_t v = 0; v < areas.size(); ++v) CHECK(same[v] == Approx(areas[v]));
  }
  Soup flat = grid(4, 4);
  flat.positions[5] = (flat.positions[4] + flat.positions[6]) / 2;
  flat.positions[9] = flat.positions[5];  // an edge without length
  const morse::EdgeLengths lengths = morse::edge_lengths(flat.mesh());
  CHECK(lengths.added > 0);
  CHECK(lengths.added < 1e-5);
  for (const double area : morse::barycentric_areas(flat.mesh(), lengths)) CHECK(area > 0);
  Soup nothing = tetrahedron();
  for (Point& p : nothing.positions) p = {1, 2, 3};
  CHECK_THROWS_WITH(morse::edge_lengths(nothing.mesh()), Catch::Contains("no extent"));
}

TEST_CASE("cotangents of lengths are exact where triangles are needles") {
  const double tiny = 1e-5;
  CHECK(morse::triangle_area({1, 1, tiny}) == Approx(tiny / 2).epsilon(1e-9));
  CHECK(morse::triangle_area({3, 4, 5}) == 6);
  CHECK(morse::triangle_area({5, 3, 4}) == 6);
  CHECK(morse::triangle_area({1, 2, 4}) == 0);
}

TEST_CASE("eigenvalues of a sphere converge") {
  std::vector<double> errors;
  for (const int rounds : {2, 3, 4}) {
    double worst = 0;
    const std::vector<Eigenfunction> functions = morse::eigenfunctions(sphere(rounds).mesh(), 8);
    for (int k = 0; k < 8; ++k) {
      const double exact = k < 3 ? 2 : 6;
      worst = std::max(worst, std::abs(functions[k].eigenvalue - exact) / exact);
    }
    errors.push_back(worst);
  }
  CHECK(errors[1] < 0.3 * errors[0]);  // by the square of the edges
  CHECK(errors[2] < 0.3 * errors[1]);
}

TEST_CASE("eigenvalues of a sphere are l times l plus 1") {
  for (const double radius : {1.0, 2.5}) {
    Soup soup = sphere(4);
    for (Point& p : soup.positions) p *= radius;
    const std::vector<Eigenfunction> functions = morse::eigenfunctions(soup.mesh(), 24);
    int k = 0;
    for (int l = 1; l <= 4; ++l)
      for (int m = 0; m < 2 * l + 1; ++m, ++k) {
        INFO("l = " << l << ", " << m);
        CHECK(functions[k].eigenvalue == Approx(l * (l + 1) / (radius * radius)).epsilon(0.01));
        CHECK(functions[k].residual < 1e-8 * functions[k].eigenvalue);
      }
    // l = 1: heights. The first of them along the axis through its highest vertex.
    for (int i = 0; i < 3; ++i) {
      const auto points = morse::classify({soup.mesh(), functions[i].phi});
      CHECK(points.minima == 1);
      CHECK(points.maxima == 1);
      CHECK(points.saddles == 0);
    }
  }
}

TEST_CASE("eigenvalues of a rectangle are those of its cosines") {
  const double width = 3, height = 1.7;
  const TriangleMesh mesh = rectangle(width, height, 61, 41);
  std::vector<double> expected;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      expected.push_back(pi * pi * (i * i / (width * width) + j * j / (height * height)));
  std::sort(expected.begin(), expected.end());
  const std::vector<Eigenfunction> functions = morse::eigenfunctions(mesh, 20);
  for (std::size_t k = 0; k < 20; ++k)
    CHECK(functions[k].eigenvalue == Approx(expected[k + 1]).epsilon(0.01));
  // The first is cos(πx/width), positive at the end with the smallest vertex.
  const double scale = std::sqrt(2 / (width * height));
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(functions[0].phi[v] == Approx(scale * std::cos(pi * mesh.position(v).x() / width)).margin(2e-3));
}

TEST_CASE("eigenfunctions are orthonormal and solve their equation on every mesh") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const Index most = morse::nonconstant_eigenfunction_count(mesh);
    const std::vector<Eigenfunction> functions = morse::eigenfunctions(mesh, most);
    const std::vector<double> areas = areas_of(mesh);
    REQUIRE(functions.size() == most);
    double asymmetry = 0;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      CHECK(functions[i].eigenvalue > 0);
      CHECK(functions[i].residual < 1e-9 * functions.back().eigenvalue);
      if (i > 0) CHECK(functions[i].eigenvalue >= functions[i - 1].eigenvalue * (1 - 1e-8));
      double sum = 0;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        sum += areas[v] * functions[i].phi[v];
        if (mesh.component_of_vertex(v) != functions[i].component) CHECK(functions[i].phi[v] == 0);
      }
      asymmetry = std::max(asymmetry, std::abs(sum));
      for (std::size_t j = 0; j <= i; ++j)
        asymmetry = std::max(asymmetry,
                             std::abs(product(areas, functions[i].phi, functions[j].phi) - (i == j ? 1 : 0)));
    }
    CHECK(asymmetry < 1e-9);
    // As the whole matrix has them.
    const Eigen::MatrixXd l(morse::laplacian(mesh, morse::edge_weights(mesh, morse::EdgeWeights::cotangent)));
    const Eigen::Map<const Eigen::VectorXd> mass(areas.data(), l.rows());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> whole(l,
                                                                          Eigen::MatrixXd(mass.asDiagonal()));
    for (std::size_t i = 0; i < functions.size(); ++i)
      CHECK(functions[i].eigenvalue ==
            Approx(whole.eigenvalues()[static_cast<long>(i + mesh.component_count())]).epsilon(1e-7));
  }
}

TEST_CASE("no eigenfunction of an eigenvalue is missed") {
  // Symmetric and too large for the dense solver: one Krylov space holds one function of each eigenvalue.
  for (const TriangleMesh& mesh : {sphere(3).mesh(), bipyramid(400).mesh(), wheel(300).mesh()}) {
    const std::vector<double> areas = areas_of(mesh);
    const Eigen::MatrixXd l(morse::laplacian(mesh, morse::edge_weights(mesh, morse::EdgeWeights::cotangent)));
    const Eigen::Map<const Eigen::VectorXd> mass(areas.data(), l.rows());
    const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> whole(root.asDiagonal() * l * root.asDiagonal(),
                                                               Eigen::EigenvaluesOnly);
    for (const std::size_t count : {1, 3, 10, 35}) {
      const std::vector<Eigenfunction> functions = morse::eigenfunctions(mesh, count);
      REQUIRE(functions.size() == count);
      for (std::size_t k = 0; k < count; ++k)
        CHECK(functions[k].eigenvalue == Approx(whole.eigenvalues()[static_cast<long>(k + 1)]).epsilon(1e-7));
    }
  }
}

TEST_CASE("equal eigenvalues have a basis that the count does not change") {
  const TriangleMesh mesh = sphere(3).mesh();
  const std::vector<Eigenfunction> many = morse::eigenfunctions(mesh, 15);
  for (const std::size_t count : {1, 2, 3, 5, 8, 12}) {
    const std::vector<Eigenfunction> few = morse::eigenfunctions(mesh, count);
    for (std::size_t k = 0; k < count; ++k)
      for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(std::abs(few[k].phi[v] - many[k].phi[v]) < 1e-6);
  }
  // Of each eigenvalue the first is largest where the others are 0.
  for (const auto& [first, last] : {std::pair{0, 3}, std::pair{3, 8}})
    for (int k = first; k < last; ++k) {
      const auto top = std::max_element(many[k].phi.begin(), many[k].phi.end()) - many[k].phi.begin();
      for (int other = k + 1; other < last; ++other) CHECK(std::abs(many[other].phi[top]) < 1e-9);
    }
}

TEST_CASE("the sign is positive where a function is largest") {
  const Eigenfunction lowest = morse::eigenfunctions(rectangle(3, 1, 31, 11), 1)[0];
  CHECK(lowest.phi[0] > 0);
  const auto bunny = morse::eigenfunctions(core::read_mesh(sample("bunny00.off")).mesh, 3);
  for (const Eigenfunction& function : bunny) {
    const auto [low, high] = std::minmax_element(function.phi.begin(), function.phi.end());
    CHECK(*high >= -*low * (1 - 1e-5));
  }
}

TEST_CASE("eigenfunctions of several components are those of each") {
  const TriangleMesh one = torus(9, 7).mesh();
  Soup both = together(torus(9, 7), torus(9, 7));
  const std::vector<Eigenfunction> single = morse::eigenfunctions(one, 6);
  const std::vector<Eigenfunction> twice = morse::eigenfunctions(both.mesh(), 12);
  const std::vector<Eigenfunction> odd = morse::eigenfunctions(both.mesh(), 5);
  for (std::size_t k = 0; k < 12; ++k)
    CHECK(twice[k].eigenvalue == Approx(single[k / 2].eigenvalue).epsilon(1e-7));
  CHECK(twice[0].component == 0);
  for (std::size_t k = 0; k < 5; ++k) CHECK(odd[k].phi == twice[k].phi);
}

TEST_CASE("eigenfunctions are the same in any unit and at any number of threads") {
  const TriangleMesh mesh = sphere(3).mesh();
  const std::vector<Eigenfunction> reference = morse::eigenfunctions(mesh, 4);
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    const std::vector<Eigenfunction> again = morse::eigenfunctions(mesh, 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(again[k].eigenvalue == reference[k].eigenvalue);
      CHECK(again[k].phi == reference[k].phi);
    }
  }
  for (const double scale : {1e-60, 0.1, 1e60}) {
    std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
    for (Point& p : positions) p *= scale;
    const std::vector<Eigenfunction> scaled = morse::eigenfunctions(mesh.with_positions(positions), 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(scaled[k].eigenvalue * scale * scale == Approx(reference[k].eigenvalue));
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        CHECK(scaled[k].phi[v] * scale == Approx(reference[k].phi[v]).margin(1e-6));
    }
  }
}

TEST_CASE("degenerate triangles have eigenfunctions too") {
  Soup soup = sphere(3);
  for (const std::size_t t : {3, 77, 500}) {  // an edge without length; a vertex in the middle of an edge
    soup.positions[soup.triangles[t][0]] = soup.positions[soup.triangles[t][1]];
    const core::Triangle& other = soup.triangles[t + 40];
    soup.positions[other[0]] = (soup.positions[other[1]] + soup.positions[other[2]]) / 2;
  }
  const std::vector<Eigenfunction> functions = morse::eigenfunctions(soup.mesh(), 8);
  for (int k = 0; k < 3; ++k) CHECK(functions[k].eigenvalue == Approx(2).epsilon(0.05));
  for (int k = 3; k < 8; ++k) CHECK(functions[k].eigenvalue == Approx(6).epsilon(0.05));
}

TEST_CASE("the eigenfunction field resolves its parameters") {
  const TriangleMesh mesh = torus(12, 9).mesh();
  const std::vector<Eigenfunction> functions = morse::eigenfunctions(mesh, 3);
  const core::FunctionResult result = evaluate_eigenfunction(mesh, {{"index", "3"}});
  CHECK(std::vector<double>(result.field.values().begin(), result.field.values().end()) == functions[2].phi);
  REQUIRE(result.parameters.size() == 4);
  CHECK(result.parameters[0] == core::Parameters::value_type{"index", std::int64_t{3}});
  CHECK(result.parameters[1] == core::Parameters::value_type{"eigenvalue", functions[2].eigenvalue});
  CHECK(result.parameters[3] == core::Parameters::value_type{"component", std::int64_t{0}});
  CHECK(evaluate_eigenfunction(mesh, {}).parameters[0] ==
        core::Parameters::value_type{"index", std::int64_t{1}});
}

TEST_CASE("an eigenfunction that does not exist is refused") {
  const TriangleMesh mesh = octahedron().mesh();
  CHECK_NOTHROW(evaluate_eigenfunction(mesh, {{"index", "5"}}));
  CHECK_THROWS_AS(evaluate_eigenfunction(mesh, {{"index", "6"}}), core::BadInput);
  CHECK_THROWS_WITH(evaluate_eigenfunction(mesh, {{"index", "6"}}),
                    Catch::Contains("6") && Catch::Contains("1 to 5"));
  CHECK_THROWS_AS(evaluate_eigenfunction(mesh, {{"index", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_eigenfunction(mesh, {{"index", "1001"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_eigenfunction(mesh, {{"index", "first"}}), core::InvalidArgument);
}

TEST_CASE("counts of eigenfunctions on the samples") {
  struct Expected {
    const char* file;
    const char* index;
    std::size_t minima, multiplicity, maxima;
  };
  for (const Expected& expected :
       {Expected{"lion-head.off", "1", 2, 2, 1}, Expected{"lion-head.off", "8", 4, 6, 3},
        Expected{"bunny00.off", "1", 1, 1, 2}, Expected{"bunny00.off", "10", 2, 5, 5}}) {
    INFO(expected.file << " " << expected.index);
    const core::TriangleMesh mesh = core::read_mesh(sample(expected.file)).mesh;
    const auto points = morse::classify(evaluate_eigenfunction(mesh, {{"index", expected.index}}).field);
    CHECK(points.minima == expected.minima);
    CHECK(points.saddle_multiplicity == expected.multiplicity);
    CHECK(points.maxima == expected.maxima);
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          mesh.euler_characteristic());
  }
}
