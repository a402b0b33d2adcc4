#include "morsel/morse/functions/geodesic.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/operators/edge_paths.h"
#include "morsel/morse/operators/intrinsic_triangles.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::HeatBoundary;
using std::numbers::pi;

namespace {

std::vector<double> from(const TriangleMesh& mesh, std::vector<Index> sources,
                         const morse::GeodesicOptions& options = {}) {
  const ScalarField field = morse::geodesic_distance(mesh, sources, options).field;
  return {field.values().begin(), field.values().end()};
}

core::FunctionResult evaluate_geodesic(const TriangleMesh& mesh, Given given,
                                       const core::MeshSource* source = nullptr) {
  return made(morse::make_geodesic, "geodesic", std::move(given))->evaluate(mesh, {source, {}});
}

/// A plane of width 1, `columns` × `rows` vertices.
TriangleMesh plane(int columns, int rows) {
  Soup soup = grid(columns, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      soup.positions[static_cast<std::size_t>(y * columns + x)] = {x / (columns - 1.0), y / (columns - 1.0),
                                                                   0};
  return soup.mesh();
}

/// A tube of radius 1 around z, open at 0 and at its height; ring by ring.
TriangleMesh tube(int around, int rings, double height) {
  Soup soup = annulus(around, rings);
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * pi * a / around;
      soup.positions[static_cast<std::size_t>(r * around + a)] = {std::cos(angle), std::sin(angle),
                                                                  height * r / (rings - 1)};
    }
  return soup.mesh();
}

double largest_error(const TriangleMesh& mesh, const std::vector<double>& values, const auto& expected) {
  double error = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    error = std::max(error, std::abs(values[v] - expected(mesh.position(v))));
  return error;
}

double sphere_error(int subdivisions) {
  const TriangleMesh mesh = sphere(subdivisions).mesh();
  const Point source = mesh.position(5);
  return largest_error(mesh, from(mesh, {5}),
                       [&](const Point& p) { return std::acos(std::clamp(p.dot(source), -1.0, 1.0)); });
}

}  // namespace

TEST_CASE("geodesics of a sphere are arcs") {
  const double coarse = sphere_error(3);
  const double fine = sphere_error(4);
  const double finest = sphere_error(5);
  CHECK(coarse < 0.09);
  CHECK(fine < 0.6 * coarse);
  CHECK(finest < 0.7 * fine);
}

TEST_CASE("geodesics of a plane are straight whatever the boundary") {
  const TriangleMesh mesh = plane(41, 31);
  for (const Index source : {Index{15 * 41 + 20}, Index{3 * 41 + 4}}) {
    const Point at = mesh.position(source);
    const auto straight = [&](const Point& p) { return (p - at).norm(); };
    CHECK(largest_error(mesh, from(mesh, {source}), straight) < 0.04);
    CHECK(largest_error(mesh, from(mesh, {source}, {1, HeatBoundary::neumann}), straight) < 0.06);
  }
  const Point corner = mesh.position(0);
  CHECK(largest_error(mesh, from(mesh, {0}), [&](const Point& p) { return (p - corner).norm(); }) < 0.06);
  CHECK(from(mesh, {700}) != from(mesh, {700}, {1, HeatBoundary::dirichlet}));
  CHECK(from(mesh, {700}) != from(mesh, {700}, {1, HeatBoundary::neumann}));
  CHECK(from(mesh, {700}) != from(mesh, {700}, {4}));
}

TEST_CASE("geodesics of a cylinder are straight when it is unrolled") {
  const TriangleMesh mesh = tube(60, 31, 3);
  const Index source = 15 * 60;
  const auto unrolled = [&](const Point& p) {
    return std::hypot(std::atan2(p.y(), p.x()), p.z() - mesh.position(source).z());
  };
  CHECK(largest_error(mesh, from(mesh, {source}), unrolled) < 0.12);
  CHECK(largest_error(tube(120, 61, 3), from(tube(120, 61, 3), {30 * 120}), unrolled) < 0.09);
}

TEST_CASE("geodesic distance is 0 at sources and positive elsewhere on every mesh") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    std::vector<Index> sources;
    for (Index c = 0; c < mesh.component_count(); ++c)
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.component_of_vertex(v) == c) {
          sources.push_back(v);
          break;
        }
    const std::vector<double> distance = from(mesh, sources);
    const std::vector<double> along_edges = morse::edge_distances(mesh, sources);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const bool is_source = std::find(sources.begin(), sources.end(), v) != sources.end();
      CHECK((distance[v] == 0) == is_source);
      CHECK((distance[v] > 0) == !is_source);
      CHECK(distance[v] < 2 * along_edges[v] + 1e-12);
    }
    const auto points = morse::classify({mesh, distance});
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          mesh.euler_characteristic());
  }
}

TEST_CASE("geodesic distance is symmetric up to its error and the nearest source counts") {
  const TriangleMesh mesh = torus(48, 32).mesh();
  const std::vector<Index> places = {3, 700, 1200};
  std::vector<std::vector<double>> single;
  for (const Index p : places) single.push_back(from(mesh, {p}));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK(single[i][places[j]] == Approx(single[j][places[i]]).epsilon(0.05));
  const std::vector<double> together = from(mesh, places);
  double error = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    error = std::max(error, std::abs(together[v] - std::min({single[0][v], single[1][v], single[2][v]})));
  CHECK(error < 0.1 * *std::max_element(together.begin(), together.end()));
  CHECK(from(mesh, {3, 3, 700}) == from(mesh, {700, 3, 3}));
}

TEST_CASE("heat reaches the end of a long strip") {
  const TriangleMesh mesh = grid(3000, 3).mesh();
  const double unit = (mesh.position(1) - mesh.position(0)).norm();
  for (const double time : {1.0, 1e-3}) {
    const std::vector<double> distance = from(mesh, {3000}, {time});
    for (Index x = 1; x < 3000; ++x) CHECK(distance[3000 + x] > distance[3000 + x - 1]);
    CHECK(distance[5999] == Approx(2999 * unit).epsilon(0.02));
  }
}

TEST_CASE("geodesic distance is the same in any unit and at any number of threads") {
  const TriangleMesh mesh = sphere(3).mesh();
  const std::vector<double> reference = from(mesh, {0});
  const ScalarField average = morse::average_geodesic_distance(mesh, 40).field;
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    CHECK(from(mesh, {0}) == reference);
    const ScalarField again = morse::average_geodesic_distance(mesh, 40).field;
    CHECK(std::equal(again.values().begin(), again.values().end(), average.values().begin()));
  }
  for (const double scale : {1e-60, 3.0, 1e60}) {
    std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
    for (Point& p : positions) p *= scale;
    const std::vector<double> scaled = from(mesh.with_positions(positions), {0});
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(scaled[v] / scale == Approx(reference[v]));
  }
}

TEST_CASE("distances are right with degenerate triangles") {
  Soup soup = sphere(3);
  for (const std::size_t t : {3, 77, 500}) {
    soup.positions[soup.triangles[t][0]] = soup.positions[soup.triangles[t][1]];
    const core::Triangle& other = soup.triangles[t + 40];
    soup.positions[other[0]] = (soup.positions[other[1]] + soup.positions[other[2]]) / 2;
  }
  const TriangleMesh mesh = soup.mesh();
  const Point source = mesh.position(600);
  CHECK(largest_error(mesh, from(mesh, {600}), [&](const Point& p) {
          return std::acos(std::clamp(p.normalized().dot(source.normalized()), -1.0, 1.0));
        }) < 0.15);
}

TEST_CASE("Delaunay flips leave no negative weight and the same surface") {
  std::vector<NamedMesh> meshes = mesh_zoo();
  Soup slanted = grid(12, 9);  // sheared: every diagonal is the wrong one
  for (Point& p : slanted.positions) p.x() -= 2.5 * p.y();
  meshes.push_back({"sheared", slanted.mesh()});
  for (unsigned seed = 0; seed < 100; ++seed) meshes.push_back({std::to_string(seed), random_surface(seed)});
  for (const auto& [name, mesh] : meshes) {
    INFO(name);
    const morse::EdgeLengths lengths = morse::edge_lengths(mesh);
    const morse::IntrinsicTriangles before = morse::mesh_triangles(mesh, lengths);
    const morse::IntrinsicTriangles after = morse::delaunay_triangles(mesh, lengths);
    const std::size_t n = mesh.vertex_count();
    double area = 0, area_after = 0;
    REQUIRE(after.sides.size() == before.sides.size());
    for (std::size_t t = 0; t < after.sides.size(); ++t) {
      area += morse::triangle_area(before.sides[t]);
      area_after += morse::triangle_area(after.sides[t]);
      CHECK(morse::triangle_area(after.sides[t]) > 0);
    }
    CHECK(area_after == Approx(area));
    const morse::SparseMatrix l = morse::laplacian(after, mesh.vertex_count());
    if (after.flips == 0) {
      const morse::SparseMatrix plain = morse::laplacian(mesh, morse::cotangent_weights(mesh, lengths));
      CHECK((l - plain).norm() < 1e-9 * plain.norm());
    }
    if (mesh.is_closed())
      for (int column = 0; column < l.outerSize(); ++column)
        for (morse::SparseMatrix::InnerIterator it(l, column); it; ++it)
          if (it.row() != column) CHECK(it.value() <= 1e-8);
    // A function's energy is least on the Delaunay triangulation (Rippa 1990), that of the vertices of a
    // plane's linear function the same.
    const std::vector<double> values = random_values(n, 9);
    const Eigen::Map<const Eigen::VectorXd> f(values.data(), static_cast<long>(n));
    const morse::SparseMatrix plain = morse::laplacian(before, mesh.vertex_count());
    CHECK(f.dot(l * f) <= f.dot(plain * f) * (1 + 1e-9));
    if (name == "sheared") {
      CHECK(after.flips > 50);
      Eigen::VectorXd x(static_cast<long>(n));
      for (Index v = 0; v < n; ++v) x[v] = mesh.position(v).x();
      CHECK(x.dot(l * x) == Approx(x.dot(plain * x)));
    }
  }
}

TEST_CASE("distances are right with thin triangles") {
  Soup soup = grid(41, 31);
  for (Point& p : soup.positions) p = {(p.x() + 0.75 * p.y()) / 40, p.y() / 400, 0};
  const TriangleMesh mesh = soup.mesh();
  const Point at = mesh.position(15 * 41 + 20);
  const auto straight = [&](const Point& p) { return (p - at).norm(); };
  CHECK(largest_error(mesh, from(mesh, {15 * 41 + 20}), straight) < 0.03);
  const morse::GeodesicOptions plain{1, HeatBoundary::average, false};
  CHECK(largest_error(mesh, from(mesh, {15 * 41 + 20}, plain), straight) > 0.04);
}

TEST_CASE("points are spread over the surface") {
  const TriangleMesh mesh = plane(21, 21);
  const morse::FarthestPoints five = morse::farthest_points(mesh, 5);
  REQUIRE(five.points.size() == 5);
  CHECK(five.points[0] == 0);  // all corners are as far from the middle
  std::vector<Index> first(five.points.begin(), five.points.begin() + 4);
  std::sort(first.begin(), first.end());
  CHECK(first == std::vector<Index>{0, 20, 420, 440});
  for (std::size_t i = 0; i < 5; ++i) CHECK(five.nearest[five.points[i]] == i);
  CHECK(morse::farthest_points(mesh, 1000).points.size() == 441);
  const std::vector<double> distance = morse::edge_distances(mesh, std::vector<Index>{0});
  CHECK(distance[20] == Approx(1));
  CHECK(distance[420] == Approx(1));
}

TEST_CASE("the average distance on a sphere is a quarter turn everywhere") {
  const TriangleMesh mesh = sphere(3).mesh();
  const auto result = morse::average_geodesic_distance(mesh, mesh.vertex_count());
  CHECK(result.samples.size() == mesh.vertex_count());
  for (const double value : result.field.values()) CHECK(value == Approx(pi / 2).epsilon(0.03));
  const auto few = morse::average_geodesic_distance(mesh, 50);
  for (const double value : few.field.values()) CHECK(value == Approx(pi / 2).epsilon(0.08));
}

TEST_CASE("the average distance is lowest in the middle of a tube") {
  const int around = 12;
  const int rings = 61;
  const TriangleMesh mesh = tube(around, rings, 20);
  const ScalarField field = morse::average_geodesic_distance(mesh, 100).field;
  CHECK(std::abs(mesh.position(field.order().front()).z() - 10) < 1);
  // Half of the length at an end, a quarter in the middle (and a little for the way around).
  CHECK(field.max() == Approx(10).epsilon(0.1));
  CHECK(field.min() == Approx(5).epsilon(0.15));
}

TEST_CASE("geodesic sources are vertices of the input or ends of an axis") {
  const TriangleMesh mesh = sphere(2).mesh();
  const core::FunctionResult by_name = evaluate_geodesic(mesh, {{"source", "max-x/min-z"}});
  Index high = 0, low = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.position(v).x() > mesh.position(high).x()) high = v;
    if (mesh.position(v).z() < mesh.position(low).z()) low = v;
  }
  const std::string numbers = std::to_string(high) + "/" + std::to_string(low);
  const core::FunctionResult by_number = evaluate_geodesic(mesh, {{"source", numbers}});
  CHECK(std::equal(by_name.field.values().begin(), by_name.field.values().end(),
                   by_number.field.values().begin()));
  CHECK(by_name.parameters == by_number.parameters);
  REQUIRE(by_name.parameters.size() == 6);
  CHECK(by_name.parameters[0] == core::Parameters::value_type{"mode", "distance"});
  CHECK(by_name.parameters[1] == core::Parameters::value_type{"source", numbers});
  CHECK(by_name.parameters[2] == core::Parameters::value_type{"time", 1.0});
  CHECK(by_name.parameters[3] == core::Parameters::value_type{"boundary", "average"});
  CHECK(by_name.parameters[4] == core::Parameters::value_type{"delaunay", true});
  CHECK(by_name.parameters[5].first == "time_step");

  // The input had a vertex 0 that was dropped.
  core::MeshSource source;
  source.numbering.input_count = mesh.vertex_count() + 1;
  source.numbering.from_input.push_back(core::kNone);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    source.numbering.to_input.push_back(v + 1);
    source.numbering.from_input.push_back(v);
  }
  CHECK(evaluate_geodesic(mesh, {{"source", "3"}}, &source).field.value(2) == 0);
  CHECK(evaluate_geodesic(mesh, {{"source", "3"}}, &source).parameters[1].second ==
        core::ParameterValue("3"));
  CHECK_THROWS_WITH(evaluate_geodesic(mesh, {{"source", "0"}}, &source), Catch::Contains("dropped"));
  CHECK_NOTHROW(evaluate_geodesic(mesh, {{"source", "162"}}, &source));
  CHECK_THROWS_WITH(evaluate_geodesic(mesh, {{"source", "163"}}, &source),
                    Catch::Contains("163") && Catch::Contains("0 to 162"));
}

TEST_CASE("geodesic keys are checked") {
  const TriangleMesh mesh = sphere(1).mesh();
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", "42"}}), core::BadInput);
  CHECK_THROWS_WITH(evaluate_geodesic(mesh, {{"source", "42"}}), Catch::Contains("42 vertices"));
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", "7/99999999999"}}), core::BadInput);
  for (const char* source : {"", "-1", "max", "max-w", "1.5", "3//4", "7 8"}) {
    INFO(source);
    CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", source}}), core::InvalidArgument);
  }
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {}), core::InvalidArgument);
  CHECK_THROWS_WITH(evaluate_geodesic(mesh, {{"mode", "average"}, {"source", "1"}}),
                    Catch::Contains("not both"));
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", "1"}, {"samples", "5"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"mode", "average"}, {"samples", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", "1"}, {"time", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_geodesic(mesh, {{"source", "1"}, {"boundary", "free"}}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::geodesic_distance(mesh, {}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::geodesic_distance(mesh, std::vector<Index>{42}), core::InvalidArgument);
  const auto average = evaluate_geodesic(mesh, {{"mode", "average"}, {"samples", "1000"}});
  CHECK(average.parameters[1] == core::Parameters::value_type{"samples", std::int64_t{42}});
  core::ParameterReader help = core::ParameterReader::for_help("geodesic");
  morse::make_geodesic(help);
  CHECK(help.declared().size() == 6);
}

TEST_CASE("a component without a source is refused") {
  const TriangleMesh two = together(together(sphere(1), torus(6, 5)), grid(3, 3)).mesh();
  CHECK_THROWS_AS(from(two, {0}), core::BadInput);
  CHECK_THROWS_WITH(from(two, {0}), Catch::Contains("2 of 3 components"));
  CHECK_NOTHROW(from(two, {0, 50, 75}));
  CHECK_THROWS_WITH(from(two, {0, 50, 72}, {1, HeatBoundary::dirichlet}), Catch::Contains("boundary"));
  CHECK_THROWS_WITH(morse::average_geodesic_distance(two, 10), Catch::Contains("3 components"));
}

TEST_CASE("counts of geodesic distances on the samples") {
  struct Expected {
    const char* file;
    std::pair<std::string, std::string> key;
    std::size_t minima, multiplicity, maxima;
  };
  for (const Expected& expected : {Expected{"lion-head.off", {"source", "0"}, 1, 15, 15},
                                   Expected{"lion-head.off", {"mode", "average"}, 13, 27, 15},
                                   Expected{"bunny00.off", {"source", "max-z"}, 1, 14, 15},
                                   Expected{"bunny00.off", {"mode", "average"}, 5, 23, 20}}) {
    INFO(expected.file << " " << expected.key.first << "=" << expected.key.second);
    const auto points =
        morse::classify(evaluate_geodesic(core::read_mesh(sample(expected.file)).mesh, {expected.key}).field);
    CHECK(points.minima == expected.minima);
    CHECK(points.saddle_multiplicity == expected.multiplicity);
    CHECK(points.maxima == expected.maxima);
  }
}
