#include "morsel/morse/functions/curvature.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature_functions.h"
#include "morsel/morse/operators/normals.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

/// Taubin's tensor as the paper writes it, in three dimensions.
std::array<double, 3> slow_curvature(const TriangleMesh& mesh, Index v, double sign) {
  const Point& p = mesh.position(v);
  Point normal = Point::Zero();
  std::map<Index, double> weight;
  double total = 0;
  for (const core::Triangle& t : mesh.triangles()) {
    const Point area =
        (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0]));
    if (t[0] != v && t[1] != v && t[2] != v) continue;
    normal += area;
    for (const Index u : t)
      if (u != v && mesh.position(u) != p) {
        weight[u] += area.norm();
        total += area.norm();
      }
  }
  normal *= sign / normal.norm();
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  double mean = 0;
  for (const auto& [u, w] : weight) {
    const Point d = p - mesh.position(u);
    const double kappa = 2 * normal.dot(d) / d.squaredNorm();
    const Point t = (d - normal * normal.dot(d)).normalized();
    tensor += w / total * kappa * t * t.transpose();
    mean += w / total * kappa;
  }
  // The normal is an eigenvector of value 0; of the other two, found across it:
  const Point a = normal.unitOrthogonal();
  const Point b = normal.cross(a);
  Eigen::Matrix2d plane;
  plane << a.dot(tensor * a), a.dot(tensor * b), b.dot(tensor * a), b.dot(tensor * b);
  const Eigen::Vector2d m = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(plane).eigenvalues();
  return {mean, 3 * m[1] - m[0], 3 * m[0] - m[1]};
}

}  // namespace

TEST_CASE("a sphere of radius r has mean curvature 1 over r whichever way its triangles turn") {
  for (const double radius : {0.01, 1.0, 250.0})
    for (const bool inward : {false, true}) {
      const Soup soup = inward ? inside_out(sphere(3)) : sphere(3);
      const TriangleMesh mesh = scaled(soup.mesh(), radius);
      const ScalarField curvature = morse::mean_curvature(mesh);
      CHECK(curvature.min() * radius == Approx(1).epsilon(0.01));
      CHECK(curvature.max() * radius == Approx(1).epsilon(0.01));
    }
}

TEST_CASE("normals are turned if all outermost components are inside out, and a bounded one's never are") {
  for (const bool other_inward : {false, true}) {
    const TriangleMesh mesh =
        together(together(inside_out(sphere(2)), other_inward ? inside_out(sphere(2)) : sphere(2)),
                 inside_out(punctured_sphere(2, 1)))
            .mesh();
    const ScalarField curvature = morse::mean_curvature(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index c = mesh.component_of_vertex(v);
      const double expected = c == 2 || (c == 0 && !other_inward) ? -1 : 1;
      if (!mesh.is_boundary_vertex(v)) CHECK(curvature.value(v) == Approx(expected).epsilon(0.02));
    }
    CHECK_THAT(morse::orientation_warnings(mesh).front(),
               Catch::Contains(other_inward ? "turned outward" : "others are not"));
  }
}

namespace {

/// A sphere of radius 1, and one of half the radius within it.
Soup hollow_sphere(bool inner_is_wall) {
  Soup soup = sphere(2);
  const Soup inner = inner_is_wall ? inside_out(sphere(2)) : sphere(2);
  const auto shift = static_cast<Index>(soup.positions.size());
  for (const Point& p : inner.positions) soup.positions.emplace_back(p / 2);
  for (const core::Triangle& t : inner.triangles)
    soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return soup;
}

}  // namespace

TEST_CASE("regression: the wall of a cavity had the sign of an outside") {
  for (const bool turned : {false, true}) {
    const Soup soup = hollow_sphere(true);
    const TriangleMesh mesh = turned ? inside_out(soup).mesh() : soup.mesh();
    const ScalarField curvature = morse::mean_curvature(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(curvature.value(v) == Approx(mesh.component_of_vertex(v) == 0 ? 1 : -2).epsilon(0.02));
    CHECK(morse::orientation_warnings(mesh).empty() == !turned);
  }
  const TriangleMesh both_outward = hollow_sphere(false).mesh();  // the file's own orientation is kept
  CHECK(morse::mean_curvature(both_outward).value(200) == Approx(2).epsilon(0.02));
  CHECK(morse::orientation_warnings(both_outward).empty());
}

TEST_CASE("regression: faces of an open mesh could be turned over without a word") {
  const auto warnings = [](const Soup& soup) { return morse::orientation_warnings(soup.mesh()); };
  for (const Soup& told : {punctured_sphere(2, 1), punctured_sphere(3, 4), cylinder(2.5, 30, 13)}) {
    CHECK(warnings(told).empty());
    REQUIRE(warnings(inside_out(told)).size() == 1);
    CHECK_THAT(warnings(inside_out(told)).front(), Catch::Contains("seem to be inside out: 1;"));
  }
  for (const Soup& flat : {grid(6, 5), inside_out(grid(6, 5))}) {
    REQUIRE(warnings(flat).size() == 1);
    CHECK_THAT(warnings(flat).front(), Catch::Contains("cannot be told which side is outside: 1;"));
  }
  const std::vector<std::string> all =
      warnings(together(together(inside_out(sphere(2)), grid(6, 5)), inside_out(punctured_sphere(2, 1))));
  REQUIRE(all.size() == 3);
  CHECK_THAT(all[0], Catch::Contains("turned outward"));
  // Gaussian curvature and curvedness are the same from either side.
  const TriangleMesh sheet = grid(6, 5).mesh();
  CHECK(made(morse::make_curvedness, "curvedness", {})->evaluate(sheet, {}).warnings.empty());
  CHECK(made(morse::make_mean_curvature, "mean-curvature", {})->evaluate(sheet, {}).warnings.size() == 1);
}

TEST_CASE("a repaired orientation is outward, by nesting") {
  for (const bool inner_is_wall : {false, true}) {
    Soup soup = hollow_sphere(inner_is_wall);
    for (const std::size_t t : {std::size_t{3}, soup.triangles.size() - 3})
      std::swap(soup.triangles[t][0], soup.triangles[t][1]);
    core::PolygonSoup polygons;
    polygons.positions = soup.positions;
    for (const core::Triangle& t : soup.triangles) polygons.add_polygon(t);
    const TriangleMesh mesh = core::build_mesh(std::move(polygons), {.repair = true}).mesh;
    const ScalarField curvature = morse::mean_curvature(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(curvature.value(v) == Approx(mesh.component_of_vertex(v) == 0 ? 1 : -2).epsilon(0.02));
  }
}

TEST_CASE("curvature of a plane is zero") {
  const TriangleMesh mesh = grid(9, 8).mesh();
  const auto [k1, k2] = morse::principal_curvatures(mesh);
  const ScalarField curvature = morse::mean_curvature(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(curvature.value(v) == 0);
    CHECK(k1[v] == 0);
    CHECK(k2[v] == 0);
  }
}

TEST_CASE("curvatures of a cylinder") {
  constexpr double kRadius = 2.5;
  constexpr int kAround = 60;
  const TriangleMesh mesh = cylinder(kRadius, kAround, 7).mesh();
  const auto [k1, k2] = morse::principal_curvatures(mesh);
  const ScalarField curvature = morse::mean_curvature(mesh);
  for (Index v = 2 * kAround; v < 5 * kAround; ++v) {
    CHECK(curvature.value(v) == Approx(0.5 / kRadius).epsilon(2e-3));
    CHECK(k1[v] == Approx(1 / kRadius).epsilon(2e-3));
    CHECK(k2[v] == Approx(0).margin(2e-3 / kRadius));
  }
}

TEST_CASE("curvatures of a saddle are opposite") {
  // z = (x² − y²)/2 over six neighbours at distance 0.01: curvatures ±1, and the lower side is the outer one.
  Soup soup = wheel(6);
  soup.positions[0] = {0, 0, 0};
  for (int j = 0; j < 6; ++j) {
    const double x = 0.01 * std::cos(j * M_PI / 3);
    const double y = 0.01 * std::sin(j * M_PI / 3);
    soup.positions[static_cast<std::size_t>(j) + 1] = {x, y, (x * x - y * y) / 2};
  }
  const auto [k1, k2] = morse::principal_curvatures(soup.mesh());
  CHECK(k1[0] == Approx(1).epsilon(1e-3));
  CHECK(k2[0] == Approx(-1).epsilon(1e-3));
  CHECK(morse::mean_curvature(soup.mesh()).value(0) == Approx(0).margin(1e-4));
}

TEST_CASE("curvature of a fine torus comes near the smooth one") {
  // Radii 2 and 1: k = 1 across, cos b / (2 + cos b) along. Squares cut into triangles weigh their diagonals,
  // so Taubin's sums are off by a little however fine the mesh is.
  const TriangleMesh mesh = torus(180, 90).mesh();
  const ScalarField curvature = morse::mean_curvature(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double c = std::cos(2 * M_PI * (v % 90) / 90);
    CHECK(curvature.value(v) == Approx((1 + c / (2 + c)) / 2).margin(0.25));
  }
  CHECK(curvature.min() > -0.2);
  CHECK(curvature.max() < 0.85);
}

TEST_CASE("curvatures agree with the tensor written down plainly and their mean is the mean curvature") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const TriangleMesh mesh = jittered(entry.mesh, 0.05, 3);
    const ScalarField curvature = morse::mean_curvature(mesh);
    const auto [k1, k2] = morse::principal_curvatures(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      // Outward is as in the family, as the jitter is small.
      const auto [mean, slow1, slow2] = slow_curvature(mesh, v, 1);
      CHECK(curvature.value(v) == Approx(mean).epsilon(1e-9).margin(1e-10));
      CHECK(k1[v] == Approx(slow1).epsilon(1e-9).margin(1e-9));
      CHECK(k2[v] == Approx(slow2).epsilon(1e-9).margin(1e-9));
      CHECK(k1[v] >= k2[v]);
      CHECK((k1[v] + k2[v]) / 2 == Approx(curvature.value(v)).epsilon(1e-12).margin(1e-12));
    }
  }
}

TEST_CASE("curvature does not change when the mesh is moved and turned and scales with the inverse length") {
  const TriangleMesh mesh = jittered(torus(14, 11).mesh(), 0.1, 5);
  const ScalarField before = morse::mean_curvature(mesh);
  const auto principal = morse::principal_curvatures(mesh);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  std::vector<Point> positions;
  for (const Point& p : mesh.positions()) positions.push_back(3 * (turn * p) + Point(7, -4, 2));
  const TriangleMesh moved = mesh.with_positions(positions);
  const ScalarField after = morse::mean_curvature(moved);
  const auto principal_after = morse::principal_curvatures(moved);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(3 * after.value(v) == Approx(before.value(v)).margin(1e-11));
    CHECK(3 * principal_after.k1[v] == Approx(principal.k1[v]).margin(1e-11));
    CHECK(3 * principal_after.k2[v] == Approx(principal.k2[v]).margin(1e-11));
  }
}

TEST_CASE("curvature of renumbered meshes follows the vertices") {
  const Soup soup = sphere(2);
  std::vector<Index> new_number;
  const TriangleMesh renumbered = jittered(soup.mesh(), 0, 1);
  const TriangleMesh mesh = shuffled(soup, 5, &new_number).mesh();
  const ScalarField a = morse::mean_curvature(renumbered);
  const ScalarField b = morse::mean_curvature(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(b.value(new_number[v]) == Approx(a.value(v)));
}

TEST_CASE("curvature is exact under powers of two and survives very large and very small meshes") {
  const TriangleMesh mesh = jittered(sphere(1).mesh(), 0.1, 2);
  const ScalarField before = morse::mean_curvature(mesh);
  const auto principal = morse::principal_curvatures(mesh);
  for (const int exponent : {-1010, -400, -1, 7, 500}) {
    const TriangleMesh other = scaled(mesh, std::ldexp(1.0, exponent));
    const ScalarField after = morse::mean_curvature(other);
    const auto [k1, k2] = morse::principal_curvatures(other);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(after.value(v) == std::ldexp(before.value(v), -exponent));
      CHECK(k1[v] == std::ldexp(principal.k1[v], -exponent));
      CHECK(k2[v] == std::ldexp(principal.k2[v], -exponent));
    }
  }
}

TEST_CASE("edges without length and triangles without area give finite curvatures") {
  const TriangleMesh mesh = sphere(2).mesh();
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  const Index a = mesh.edge_vertices(0)[0];
  const Index b = mesh.edge_vertices(0)[1];
  positions[b] = positions[a];
  const ScalarField collapsed = morse::mean_curvature(mesh.with_positions(positions));
  for (const Index v : {a, b})
    CHECK(collapsed.value(v) == Approx(slow_curvature(mesh.with_positions(positions), v, 1)[0]));

  for (Point& p : positions) p = {p.x(), 0, 0};  // a needle: no area at all
  const ScalarField needle = morse::mean_curvature(mesh.with_positions(positions));
  CHECK(needle.extent() == 0);
  CHECK(needle.min() == 0);
  for (Point& p : positions) p = {1, 2, 3};
  CHECK(morse::mean_curvature(mesh.with_positions(positions)).extent() == 0);
  const auto [k1, k2] = morse::principal_curvatures(mesh.with_positions(positions));
  CHECK(k1[3] == 0);
  CHECK(k2[3] == 0);

  // A flattened sphere: normals fall on the plane's normal or cancel out; no volume, so no inside.
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    positions[v] = mesh.position(v);
    positions[v].z() = 0;
  }
  const ScalarField flat = morse::mean_curvature(mesh.with_positions(positions));
  CHECK(std::isfinite(flat.extent()));
}

TEST_CASE("a neighbour along the normal adds its curvature to all directions equally") {
  // A spike of the bipyramid folded so that vertex 2 lies straight above vertex 0.
  Soup soup = wheel(4);
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const auto flat = morse::principal_curvatures(soup.mesh());
  CHECK(flat.k1[0] == 0);
  soup.positions = {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const auto needle = morse::principal_curvatures(soup.mesh());
  CHECK(needle.k1[0] == 0);
  CHECK(needle.k2[0] == 0);
}

TEST_CASE("curvature gives the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(5).mesh(), 0.01, 4);
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return morse::mean_curvature(mesh);
  };
  const ScalarField one = run(1);
  for (const int threads : {2, 7}) {
    const ScalarField more = run(threads);
    CHECK(std::equal(one.values().begin(), one.values().end(), more.values().begin()));
  }
}
