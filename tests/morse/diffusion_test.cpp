#include "morsel/morse/smoothing/diffusion.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::EdgeWeights;
namespace {

core::MethodResult laplacian(const ScalarField& field, Given given) {
  return made(morse::make_laplacian, "laplacian", std::move(given))->apply(field, {});
}

constexpr EdgeWeights kWeights[] = {EdgeWeights::uniform, EdgeWeights::cotangent, EdgeWeights::clamped};

double integral(const TriangleMesh& mesh, std::span<const double> values) {
  const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::barycentric);
  return std::inner_product(areas.begin(), areas.end(), values.begin(), 0.0);
}

}  // namespace

TEST_CASE("an explicit step goes towards the mean of the neighbours") {
  const TriangleMesh mesh = octahedron().mesh();
  const std::vector<double> values = {6, 0, 1, 2, 3, 4};
  for (const EdgeWeights weights :
       {EdgeWeights::uniform, EdgeWeights::cotangent}) {  // equal on an octahedron
    const std::vector<double> next = morse::ExplicitDiffusion(mesh, weights, 0.5).step(values);
    CHECK(next[0] == Approx(6 + 0.5 * (2.5 - 6)));
    CHECK(next[1] == Approx(0.5 * 2.5));
    CHECK(next[2] == Approx(1 + 0.5 * ((6 + 0 + 2 + 4) / 4.0 - 1)));
  }
}

TEST_CASE("diffusion leaves constants exactly as they are") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const std::vector<double> values(mesh.vertex_count(), 0.1);
    for (const EdgeWeights weights : kWeights) {
      CHECK(morse::ExplicitDiffusion(mesh, weights, 0.7).step(values) == values);
      CHECK(morse::ImplicitDiffusion(mesh, weights, 0.3).step(values) == values);
    }
  }
}

TEST_CASE("weights that are not negative keep every value within the range before") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const std::vector<double> values = random_values(mesh.vertex_count(), 7);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    for (const EdgeWeights weights : {EdgeWeights::uniform, EdgeWeights::clamped})
      for (const std::vector<double>& next : {morse::ExplicitDiffusion(mesh, weights, 1).step(values),
                                              morse::ImplicitDiffusion(mesh, weights, 2).step(values)}) {
        CHECK(*std::min_element(next.begin(), next.end()) >= *low - 1e-14);
        CHECK(*std::max_element(next.begin(), next.end()) <= *high + 1e-14);
      }
  }
}

TEST_CASE("an implicit step solves the heat equation and keeps the integral") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const std::vector<double> values = random_values(mesh.vertex_count(), 9);
    const double time = 0.2;
    const std::vector<double> next =
        morse::ImplicitDiffusion(mesh, EdgeWeights::cotangent, time).step(values);
    CHECK(integral(mesh, next) == Approx(integral(mesh, values)));
    const morse::SparseMatrix l = morse::laplacian(mesh, morse::edge_weights(mesh, EdgeWeights::cotangent));
    const Eigen::VectorXd lf = l * Eigen::Map<const Eigen::VectorXd>(next.data(), l.rows());
    const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::barycentric);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(areas[v] * next[v] + time * lf[v] == Approx(areas[v] * values[v]).margin(1e-11));
  }
}

TEST_CASE("the height of a sphere decays as the heat equation says") {
  // z is an eigenfunction of eigenvalue 2 on the unit sphere: a backward Euler step over t divides it by 1 +
  // 2 t.
  const TriangleMesh mesh = sphere(4).mesh();
  std::vector<double> z;
  for (const Point& p : mesh.positions()) z.push_back(p.z());
  const std::vector<double> next = morse::ImplicitDiffusion(mesh, EdgeWeights::cotangent, 0.25).step(z);
  for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(next[v] == Approx(z[v] / 1.5).margin(2e-3));
}

TEST_CASE("the Euler identity holds after Laplacian smoothing and threads change nothing") {
  for (const auto& [mesh_name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 4))
      for (const Given& given : {Given{}, Given{{"weights", "cotangent"}, {"lambda", "1"}},
                                 Given{{"scheme", "implicit"}, {"iterations", "2"}}}) {
        INFO(mesh_name << ", " << field_name);
        const ScalarField result = laplacian(field, given).field;
        const morse::CriticalPoints points = morse::classify(result);
        CHECK(static_cast<long>(points.minima) - static_cast<long>(points.saddle_multiplicity) +
                  static_cast<long>(points.maxima) ==
              mesh.euler_characteristic());
        const core::ThreadLimit limit(4);
        const ScalarField again = laplacian(field, given).field;
        CHECK(std::equal(again.values().begin(), again.values().end(), result.values().begin()));
      }
}

TEST_CASE("Laplacian smoothing resolves its parameters") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 1));
  CHECK(laplacian(field, {}).parameters == core::Parameters{{"iterations", std::int64_t{10}},
                                                            {"scheme", "explicit"},
                                                            {"weights", "uniform"},
                                                            {"lambda", 0.5}});
  CHECK(laplacian(field, {{"scheme", "implicit"}, {"time", "0.2"}, {"weights", "clamped"}}).parameters ==
        core::Parameters{{"iterations", std::int64_t{10}},
                         {"scheme", "implicit"},
                         {"weights", "clamped"},
                         {"spread", 0.2},
                         {"time", 0.2 * 0.2 / 2}});
  for (const Given& bad : {Given{{"lambda", "0"}}, Given{{"lambda", "1.5"}}, Given{{"weights", "cotan"}},
                           Given{{"time", "1"}}, Given{{"scheme", "implicit"}, {"lambda", "1"}},
                           Given{{"scheme", "implicit"}, {"time", "0"}}, Given{{"scheme", "forward"}}}) {
    INFO(bad.back().first << "=" << bad.back().second);
    CHECK_THROWS_AS(laplacian(field, bad), core::InvalidArgument);
    CHECK_THROWS_WITH(laplacian(field, bad), Catch::Contains(bad.back().first));
  }
  CHECK_THROWS_AS(morse::ExplicitDiffusion(mesh, EdgeWeights::uniform, 0), core::InvalidArgument);
  CHECK_THROWS_AS(morse::ImplicitDiffusion(mesh, EdgeWeights::uniform, -1), core::InvalidArgument);
}

TEST_CASE("counts after Laplacian smoothing on real meshes") {
  struct Expected {
    const char* mesh;
    Given given;
    double total;
  };
  for (const Expected& expected :
       {Expected{"lion-head.off", {}, 329}, Expected{"lion-head.off", {{"scheme", "implicit"}}, 240},
        Expected{"lion-head.off", {{"scheme", "implicit"}, {"time", "2eps"}}, 191},
        Expected{"bunny00.off", {}, 1562}}) {
    INFO(expected.mesh << ", " << expected.given.size());
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(expected.mesh)).mesh);
    const std::size_t total = morse::classify(laplacian(field, expected.given).field).total();
    CHECK(static_cast<double>(total) == Approx(expected.total).epsilon(0.005));
  }
}
