#include "morsel/mscomplex/quads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/eigenfunctions.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/quads/arc_drawing.h"
#include "morsel/mscomplex/quads/triangle_search.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::ArcDrawing;
using mscomplex::MorseSmaleComplex;
using mscomplex::QuadLayout;
using mscomplex::QuadMesh;

namespace {

/// Whether every vertex of the quad mesh is a point of the surface.
void check_on_surface(const QuadMesh& quads, const TriangleMesh& mesh) {
  const mscomplex::TriangleSearch surface(mesh.positions(), mesh.triangles());
  double largest = 0;
  for (const Point& p : quads.positions) largest = std::max(largest, surface.distance(p));
  CHECK(largest <= 1e-9 * mesh.bounding_box().diagonal());
}

/// All that holds for every layout and its quads. Returns whether there is a layout.
bool check_layout(const ScalarField& field, int relaxation, Index resolution) {
  const TriangleMesh& mesh = field.mesh();
  std::optional<mscomplex::RepairedComplex> repaired;
  try {
    repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
  } catch (const core::BadInput& e) {
    CHECK(std::string(e.what()).find("no saddle") != std::string::npos);
    return false;
  }
  const MorseSmaleComplex& complex = repaired->complex;
  complex.gradient().validate();
  CHECK(complex.saddle_count() + repaired->repairs.size() == MorseSmaleComplex(field).saddle_count());
  const QuadLayout layout = mscomplex::embed_layout(complex, {relaxation});
  layout.validate(complex);
  const QuadMesh quads = mscomplex::sample(layout, resolution);
  Index pentagons = 0;
  for (Index q = 0; q < complex.quad_count(); ++q)
    if (layout.is_cap(complex.quad(q).nodes[2])) ++pentagons;
  REQUIRE(4 * quads.quads.size() ==
          (4 * std::size_t{complex.quad_count()} + pentagons) * resolution * resolution);
  mscomplex::validate(quads, mesh.euler_characteristic(), mesh.boundary_loop_count());
  check_on_surface(quads, mesh);
  for (Index n = 0; mesh.is_closed() && n < complex.node_count(); ++n)
    REQUIRE(quads.positions[n] == layout.surface.position(layout.node_vertex[n]));
  const mscomplex::QuadQuality quality = mscomplex::measure(quads, mesh);
  REQUIRE(quality.valence.size() >= 5);
  CHECK(quality.valence[0] + quality.valence[1] == 0);
  // Minima and maxima of other than four arcs, and the middles of pentagons.
  std::size_t extraordinary = pentagons;
  for (Index n = 0; n < complex.node_count(); ++n)
    if (complex.kind(n) == mscomplex::NodeKind::minimum || complex.kind(n) == mscomplex::NodeKind::maximum)
      extraordinary += complex.arcs_ending_at(n).size() != 4;
  CHECK(quality.extraordinary == extraordinary);
  CHECK(quality.patches.size() == complex.quad_count());
  return true;
}

/// A bipyramid whose rim goes up and down.
TriangleMesh wavy_bipyramid(int sides) {
  const TriangleMesh flat = bipyramid(sides).mesh();
  std::vector<Point> positions;
  for (Index v = 0; v < flat.vertex_count(); ++v)
    positions.push_back(flat.position(v) + Point(0, 0, v < 2 ? 0 : v % 2 == 0 ? -0.2 : 0.2));
  return {positions, {flat.triangles().begin(), flat.triangles().end()}};
}

/// Minima 2 and 4, maxima at the poles 0 and 1, saddles 3 and 5.
ScalarField two_of_each() { return {octahedron().mesh(), {9, 8, -2, 0, -1, 1}}; }

std::string refusal(const ScalarField& field) {
  try {
    mscomplex::embed_layout(mscomplex::repair_dangling(field, MorseSmaleComplex(field)).complex);
  } catch (const core::BadInput& e) {
    return e.what();
  }
  return "";
}

QuadMesh unit_cube() {
  QuadMesh cube;
  for (int i = 0; i < 8; ++i) cube.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  cube.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  cube.patch = {0, 1, 2, 3, 4, 5};
  cube.resolution = 1;
  return cube;
}

TriangleMesh triangulated(const QuadMesh& quads) {
  std::vector<core::Triangle> triangles;
  for (const auto& q : quads.quads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return {quads.positions, triangles};
}

ScalarField eigenfunction(const TriangleMesh& mesh, std::size_t index) {
  return {mesh, morse::eigenfunctions(mesh, index).back().phi};
}

}  // namespace

TEST_CASE("a layout of the octahedron") {
  const ScalarField field = two_of_each();
  const MorseSmaleComplex complex(field);
  REQUIRE(complex.quad_count() == 4);
  CHECK(mscomplex::repair_dangling(field, complex).repairs.empty());
  const QuadLayout layout = mscomplex::embed_layout(complex, {.relaxation = 0});
  layout.validate(complex);
  CHECK(layout.missed == 0);
  // Extrema are where they were, saddles at the midpoints of their critical edges.
  const TriangleMesh& mesh = field.mesh();
  for (Index n = 0; n < complex.node_count(); ++n) {
    const Point at = layout.surface.position(layout.node_vertex[n]);
    if (complex.kind(n) == mscomplex::NodeKind::saddle) {
      const auto [a, b] = mesh.edge_vertices(complex.node(n).cell);
      CHECK(at == (mesh.position(a) + mesh.position(b)) / 2);
    } else {
      CHECK(at == mesh.position(complex.node(n).vertex));
    }
  }
  const QuadMesh quads = mscomplex::sample(layout, 4);
  CHECK(quads.positions.size() == 6 + 8 * 3 + 4 * 9);
  CHECK(quads.quads.size() == 64);
  const mscomplex::QuadQuality quality = mscomplex::measure(quads, mesh);
  CHECK(quality.valence == std::vector<std::size_t>{0, 0, 4, 0, 62});
  CHECK(quality.extraordinary == 4);
  CHECK(quality.patches.size() == 4);
}

TEST_CASE("a monkey saddle is split into two") {
  const ScalarField field(bipyramid(6).mesh(), {0, 0, 1, -1, 2, -2, 3, -3});
  const MorseSmaleComplex complex(field);
  REQUIRE(complex.saddle_count() == 4);
  for (const int relaxation : {0, 1, 3}) CHECK(check_layout(field, relaxation, 3));
}

TEST_CASE("dangling arcs are cancelled and reported") {
  // Three bumps on a row of vertices: the outer two maxima have a single arc each, and when they are gone so
  // has the third.
  const ScalarField field(bipyramid(6).mesh(), {0, -9, 1, -1, 2, -2, 3, -3});
  CHECK_THROWS_AS(mscomplex::embed_layout(MorseSmaleComplex(field)), core::BadInput);
  CHECK(refusal(field).find("no saddle") != std::string::npos);

  int repaired = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    const TriangleMesh mesh = sphere(3).mesh();
    const ScalarField bumpy(mesh, smooth_values(mesh, 1, seed));
    const MorseSmaleComplex complex(bumpy);
    const auto result = mscomplex::repair_dangling(bumpy, complex);
    repaired += static_cast<int>(result.repairs.size());
    CHECK(complex.saddle_count() == result.complex.saddle_count() + result.repairs.size());
    for (Index n = 0; n < result.complex.node_count(); ++n)
      CHECK(result.complex.arcs_ending_at(n).size() != 1);
    for (const auto& r : result.repairs) {
      const auto minima = complex.gradient().minima();
      const auto maxima = complex.gradient().maxima();
      CHECK((r.kind == mscomplex::NodeKind::minimum
                 ? std::find(minima.begin(), minima.end(), r.vertex) != minima.end()
                 : std::any_of(maxima.begin(), maxima.end(),
                               [&](const auto& m) { return m.vertex == r.vertex; })));
      CHECK(r.persistence == std::abs(bumpy.value(r.vertex) - bumpy.value(r.saddle_vertex)));
    }
  }
  CHECK(repaired > 0);
}

TEST_CASE("what has no layout is refused") {
  const TriangleMesh ball = sphere(2).mesh();
  std::vector<double> height;
  for (const Point& p : ball.positions()) height.push_back(p.z());
  CHECK(refusal({ball, height}).find("more critical points") != std::string::npos);

  CHECK(refusal({grid(3, 3).mesh(), {0, 1, 2, 3, 4, 5, 6, 7, 8}}).find("boundary loop") != std::string::npos);

  // A component with a layout, and one without.
  const Soup two = together(octahedron(), tetrahedron());
  CHECK(refusal({two.mesh(), {9, 8, -2, 0, -1, 1, 0, 1, 2, 3}}).find("component 1") != std::string::npos);

  const MorseSmaleComplex complex(two_of_each());
  const QuadLayout layout = mscomplex::embed_layout(complex);
  CHECK_THROWS_AS(mscomplex::sample(layout, 1), core::InvalidArgument);
  CHECK_THROWS_AS(mscomplex::sample(layout, 100000), core::InvalidArgument);
  const TriangleMesh disc = grid(6, 6).mesh();
  const ScalarField bumpy(disc, random_values(disc.vertex_count(), 1));
  const auto repaired = mscomplex::repair_dangling(bumpy, MorseSmaleComplex(bumpy));
  for (const Index n : {2u, 5u})
    CHECK_THROWS_AS(mscomplex::sample(mscomplex::embed_layout(repaired.complex), n), core::InvalidArgument);
  CHECK_THROWS_AS(mscomplex::embed_layout(complex, {.relaxation = -1}), core::InvalidArgument);
}

TEST_CASE("layouts of every mesh of the zoo") {
  int laid_out = 0;
  for (const NamedMesh& entry : mesh_zoo()) {
    for (const NamedField& f : field_zoo(entry.mesh, 81))
      for (const int relaxation : {0, 1}) {
        INFO(entry.name << " | " << f.name << " | relaxed " << relaxation);
        laid_out += check_layout(f.field, relaxation, entry.mesh.is_closed() ? 2 : 4);
      }
  }
  CHECK(laid_out >= 130);
}

TEST_CASE("layouts of random surfaces and fields") {
  int laid_out = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    laid_out += check_layout({mesh, random_values(mesh.vertex_count(), seed)}, 2, 4);
    laid_out += check_layout({mesh, smooth_values(mesh, 2, seed)}, 0, 4);
  }
  CHECK(laid_out >= 100);
}

TEST_CASE("layouts of simplified complexes, of several components and of a torus") {
  const TriangleMesh ring = torus(12, 24).mesh();
  CHECK(check_layout({ring, smooth_values(ring, 3, 1)}, 2, 4));
  const TriangleMesh both = together(torus(10, 20), pierced_slab(2)).mesh();
  const ScalarField field(both, random_values(both.vertex_count(), 5));
  CHECK(check_layout(field, 1, 3));
  const mscomplex::PersistenceHierarchy hierarchy(field);
  for (const Index level : {hierarchy.levels() / 2, hierarchy.levels()}) {
    const auto repaired =
        mscomplex::repair_dangling(field, MorseSmaleComplex(field, hierarchy.gradient(level)));
    const QuadLayout layout = mscomplex::embed_layout(repaired.complex, {.relaxation = 1});
    layout.validate(repaired.complex);
    mscomplex::validate(mscomplex::sample(layout, 3), both.euler_characteristic());
  }
}

TEST_CASE("quads at vertices of a degree of five thousand take seconds, not minutes") {
  const TriangleMesh mesh = bipyramid(5000).mesh();
  std::vector<double> values;
  for (const Point& p : mesh.positions()) values.push_back(p.x() * p.y());
  CHECK(check_layout({mesh, values}, 2, 4));
}

TEST_CASE("a first drawing that would take too many triangles is refused, and one of just as many is not") {
  CHECK(ArcDrawing::most_at_first(100) == 4'194'304);
  CHECK(ArcDrawing::most_at_first(1'000'000) == 16'000'000);
  const TriangleMesh mesh = wavy_bipyramid(80);
  const ScalarField field = eigenfunction(mesh, 40);
  const auto repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
  const std::size_t needed = mscomplex::embed_layout(repaired.complex, {0}).surface.triangle_count();
  REQUIRE(needed > mesh.triangle_count());
  ArcDrawing(repaired.complex).draw_first(needed);
  CHECK_THROWS_AS(ArcDrawing(repaired.complex).draw_first(needed - 1), core::BadInput);
  CHECK_THROWS_WITH(
      ArcDrawing(repaired.complex).draw_first(needed - 1),
      Catch::Matches(
          "the [0-9]+ arcs that meet in the (minimum|maximum) at vertex [0-9]+ would cut the surface "
          "of 160 triangles into more than " +
          std::to_string(needed - 1) + "; a field with fewer critical points there, .*"));
}

TEST_CASE("relaxations where many arcs meet add a bounded number of triangles") {
  Index left = 0;
  for (const int sides : {40, 80, 120}) {
    INFO(sides);
    const TriangleMesh mesh = wavy_bipyramid(sides);
    const ScalarField field = eigenfunction(mesh, 40);
    const auto repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
    std::size_t before = 0;
    for (const int relaxation : {0, 1, 2}) {
      const QuadLayout layout = mscomplex::embed_layout(repaired.complex, {relaxation});
      layout.validate(repaired.complex);
      const std::size_t now = layout.surface.triangle_count();
      if (relaxation == 0) CHECK(layout.left == 0);
      if (relaxation > 0) CHECK(now <= before + std::max<std::size_t>(before, 65'536));
      before = now;
      left += layout.left;
    }
  }
  CHECK(left > 0);
}

TEST_CASE("quads of the bunny, the elephant and the lion") {
  const std::vector<std::pair<std::string, std::vector<int>>> runs = {
      {"bunny00.off", {1}}, {"refined_elephant.off", {0}}, {"lion-head.off", {0, 1}}};
  for (const auto& [file, relaxations] : runs) {
    INFO(file);
    const TriangleMesh mesh = core::read_mesh(sample(file)).mesh;
    const ScalarField field = eigenfunction(mesh, 20);
    const auto repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
    std::vector<double> angles;
    for (const int relaxation : relaxations) {
      const QuadLayout layout = mscomplex::embed_layout(repaired.complex, {relaxation});
      CHECK(layout.missed == 0);
      layout.validate(repaired.complex);
      const QuadMesh quads = mscomplex::sample(layout, 10);
      mscomplex::validate(quads, mesh.euler_characteristic(), mesh.boundary_loop_count());
      check_on_surface(quads, mesh);
      const mscomplex::QuadQuality quality = mscomplex::measure(quads, mesh);
      CHECK(quality.concave < quads.quads.size() / 10);
      CHECK(quality.distance_max < 0.05 * mesh.bounding_box().diagonal());
      CHECK(quality.distance_from_input < 0.1 * mesh.bounding_box().diagonal());
      angles.push_back(quality.angle_mean);
    }
    CHECK(std::is_sorted(angles.rbegin(), angles.rend()));
  }
}

TEST_CASE("quads are the same for every number of threads") {
  const TriangleMesh mesh = punctured_sphere(3, 2).mesh();
  const ScalarField field(mesh, smooth_values(mesh, 4, 3));
  const auto quads_with = [&](int threads) {
    core::ThreadLimit limit(threads);
    const auto repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
    const QuadMesh quads = mscomplex::sample(mscomplex::embed_layout(repaired.complex), 4);
    return std::pair(quads, mscomplex::measure(quads, mesh));
  };
  const auto [one, quality] = quads_with(1);
  REQUIRE(one.quads.size() > 100);
  for (const int threads : {2, 7}) {
    const auto [many, same] = quads_with(threads);
    CHECK(one.positions == many.positions);
    CHECK(one.quads == many.quads);
    CHECK(quality.angle_mean == same.angle_mean);
    CHECK(quality.distance_mean == same.distance_mean);
    CHECK(quality.distance_from_input == same.distance_from_input);
  }
}

TEST_CASE("the quality of a cube, and of a box against it") {
  QuadMesh cube = unit_cube();
  mscomplex::validate(cube, 2);
  const TriangleMesh input = triangulated(cube);
  const auto good = mscomplex::measure(cube, input);
  CHECK(good.valence == std::vector<std::size_t>{0, 0, 0, 8});
  CHECK(good.extraordinary == 8);
  CHECK(good.angle_max == Approx(0).margin(1e-12));
  CHECK(good.scaled_jacobian_min == Approx(1));
  CHECK(good.concave == 0);
  CHECK(good.area_mean == Approx(1));
  CHECK(good.area_deviation == Approx(0).margin(1e-12));
  CHECK(good.distance_max == Approx(0).margin(1e-15));
  CHECK(good.distance_from_input == Approx(0).margin(1e-15));

  // Twice as high: two quads of area 1, four of area 2.
  for (Point& p : cube.positions) p.z() *= 2;
  const auto high = mscomplex::measure(cube, input);
  CHECK(high.area_mean == Approx(10.0 / 6));
  CHECK(high.area_max == Approx(1.2));
  CHECK(high.area_min == Approx(0.6));
  CHECK(high.area_deviation == Approx(std::sqrt(2.0 / 25)));
  CHECK(high.distance_max == Approx(1));
  CHECK(high.distance_from_input == Approx(0).margin(1e-15));  // its old top corners lie on the new sides
}

TEST_CASE("an angle that points inwards counts") {
  QuadMesh dart = unit_cube();
  dart.positions[3] = {0.25, 0.25, 0};  // of the lower face, past its diagonal
  const auto quality = mscomplex::measure(dart, triangulated(dart));
  CHECK(quality.concave >= 1);
  CHECK(quality.scaled_jacobian_min < 0);
  CHECK(quality.angle_max > 90);
}

TEST_CASE("quad meshes that are not closed manifolds are detected") {
  const auto spoiled = [](auto&& spoil) {
    QuadMesh mesh = unit_cube();
    spoil(mesh);
    return mesh;
  };
  for (const QuadMesh& mesh : {
           spoiled([](QuadMesh& m) { m.quads.pop_back(); }),
           spoiled([](QuadMesh& m) { std::swap(m.quads[0][1], m.quads[0][3]); }),
           spoiled([](QuadMesh& m) { m.quads.push_back(m.quads[0]); }),
           spoiled([](QuadMesh& m) { m.quads[0][1] = m.quads[0][0]; }),
           spoiled([](QuadMesh& m) { m.quads[0][1] = 8; }),
           spoiled([](QuadMesh& m) { m.positions.emplace_back(5, 5, 5); }),
           spoiled([](QuadMesh& m) {  // a second cube on vertex 0
             const auto quads = m.quads;
             for (auto q : quads) {
               for (Index& v : q) v = v == 0 ? 0 : v + 7;
               m.quads.push_back(q);
             }
             m.positions.resize(15, Point(1, 2, 3));
           }),
       })
    CHECK_THROWS_AS(mscomplex::validate(mesh, 2), std::logic_error);
  CHECK_THROWS_AS(mscomplex::validate(unit_cube(), 0), std::logic_error);
}

TEST_CASE("a layout that is not the complex's is detected") {
  const MorseSmaleComplex complex(two_of_each());
  const QuadLayout good = mscomplex::embed_layout(complex);
  good.validate(complex);
  QuadLayout bad = good;
  std::swap(bad.arcs[0], bad.arcs[2]);
  CHECK_THROWS_AS(bad.validate(complex), std::logic_error);
  bad = good;
  std::swap(bad.node_vertex[0], bad.node_vertex[1]);
  CHECK_THROWS_AS(bad.validate(complex), std::logic_error);
  bad = good;
  bad.patch_of_triangle[0] = (bad.patch_of_triangle[0] + 1) % 4;
  CHECK_THROWS_AS(bad.validate(complex), std::logic_error);
  bad = good;
  bad.arcs[1].erase(bad.arcs[1].begin() + 1);
  CHECK_THROWS_AS(bad.validate(complex), std::logic_error);
}

TEST_CASE("distances to triangles agree with brute force") {
  for (const std::size_t count : {0u, 1u, 3u, 4u, 5u, 9u, 100u, 1000u}) {
    INFO(count);
    const auto random = random_values(3 * 3 * count + 300, 7);
    std::vector<Point> positions;
    std::vector<core::Triangle> triangles;
    for (Index i = 0; i < 3 * count; ++i) {
      positions.emplace_back(random[3 * i], random[3 * i + 1], 0.2 * random[3 * i + 2]);
      if (i % 3 == 2) triangles.push_back({i - 2, i - 1, i});
    }
    if (count > 3) triangles[1] = {3, 3, 3};  // a point
    if (count > 3) triangles[2] = {6, 7, 7};  // an edge
    const mscomplex::TriangleSearch all(positions, triangles);
    std::vector<mscomplex::TriangleSearch> each;
    for (const core::Triangle& t : triangles) each.emplace_back(positions, std::vector{t});
    for (int k = 0; k < 20; ++k) {
      const double* r = &random[9 * count + 3 * k];
      const Point x(2 * r[0], 2 * r[1], 2 * r[2] - 1);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& one : each) least = std::min(least, one.distance(x));
      CHECK(all.distance(x) == least);
    }
  }
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const mscomplex::TriangleSearch one(corners, std::vector<core::Triangle>{{0, 1, 2}});
  CHECK(one.distance({0.25, 0.25, 2}) == 2);
  CHECK(one.distance({-3, -4, 0}) == 5);
  CHECK(one.distance({0.5, -1, 0}) == 1);
  CHECK(one.distance({1, 1, 0}) == Approx(std::sqrt(0.5)));
}
