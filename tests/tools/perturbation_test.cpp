#include "morsel/tools/study/perturbation.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/tools/study/random_stream.h"
#include "morsel/tools/study/statistics.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using tools::NoiseKind;
using tools::perturb;
using tools::Perturbation;
using tools::PerturbationKind;
using tools::PerturbedMesh;
using tools::RandomStream;
using tools::RandomUse;

namespace {

core::LoadedMesh as_loaded(const TriangleMesh& mesh) { return {mesh, {}}; }

std::vector<Point> positions(const TriangleMesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

Perturbation noise(double amount, NoiseKind direction) {
  return {PerturbationKind::noise, amount, direction};
}
Perturbation decimation(double share) { return {PerturbationKind::decimation, share, NoiseKind::normal}; }
Perturbation subdivision(double pieces) { return {PerturbationKind::subdivision, pieces, NoiseKind::normal}; }

std::vector<Point> moves(const TriangleMesh& mesh, const PerturbedMesh& perturbed) {
  std::vector<Point> result;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    result.push_back(perturbed.loaded.mesh.position(v) - mesh.position(v));
  return result;
}

}  // namespace

TEST_CASE("random streams have fixed values") {
  RandomStream random(1, RandomUse::normal_noise, {2, 3});
  const std::uint64_t first = random.next();
  CHECK(first == RandomStream(1, RandomUse::normal_noise, {2, 3}).next());
  CHECK(first == 4337668260179163601u);
  CHECK(RandomStream(1, RandomUse::normal_noise, {2, 3}).normal() == 0.15034286759061619);
  std::set<std::uint64_t> seen;
  for (const std::uint64_t seed : {0, 1, 2})
    for (const RandomUse use : {RandomUse::normal_noise, RandomUse::isotropic_noise, RandomUse::placement})
      for (std::uint64_t i = 0; i < 10; ++i)
        for (std::uint64_t j = 0; j < 10; ++j)
          CHECK(seen.insert(RandomStream(seed, use, {i, j}).next()).second);
}

TEST_CASE("random numbers have the right distributions") {
  const std::size_t count = 200'000;
  std::vector<double> normal, square, fourth, uniform;
  std::vector<std::size_t> die(6, 0);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(7, RandomUse::placement, {i});  // the first numbers of many streams
    normal.push_back(random.normal());
    square.push_back(normal.back() * normal.back());
    fourth.push_back(square.back() * square.back());
    uniform.push_back(random.uniform());
    CHECK((uniform.back() > 0 && uniform.back() < 1));
    ++die[random.below(6)];
  }
  CHECK(tools::estimate(normal).mean == Approx(0).margin(0.01));
  CHECK(tools::estimate(square).mean == Approx(1).margin(0.015));
  CHECK(tools::estimate(fourth).mean == Approx(3).margin(0.12));
  CHECK(tools::estimate(uniform).mean == Approx(0.5).margin(0.003));
  CHECK(tools::estimate(uniform).deviation == Approx(std::sqrt(1 / 12.0)).margin(0.002));
  for (const std::size_t face : die) CHECK(static_cast<double>(face) == Approx(count / 6.0).epsilon(0.03));
}

TEST_CASE("estimates have the tabulated intervals") {
  const std::vector<double> values = {1, 2, 3, 4};
  const tools::Estimate four = tools::estimate(values);
  CHECK(four.mean == 2.5);
  CHECK(four.deviation == Approx(std::sqrt(5 / 3.0)));
  CHECK(four.half_width.value() == Approx(3.182446305 * std::sqrt(5 / 3.0) / 2));  // t of 3 degrees, 97.5 %
  const std::vector<double> two = {0, 1};
  CHECK(tools::estimate(two).half_width.value() == Approx(12.7062047364 / 2));
  const tools::Estimate single = tools::estimate(std::vector<double>{5});
  CHECK(single.mean == 5);
  CHECK_FALSE(single.half_width);
  CHECK(tools::estimate({}).count == 0);
}

TEST_CASE("noise has the standard deviation that it is given, in mean edge lengths") {
  const TriangleMesh mesh = sphere(5).mesh();
  const double edge = core::mean_edge_length(mesh);
  const std::vector<Point> normals = morse::vertex_normals(mesh);
  double sum = 0;
  for (Index e = 0; e < mesh.edge_count(); ++e)
    sum += (mesh.position(mesh.edge_vertices(e)[0]) - mesh.position(mesh.edge_vertices(e)[1])).norm();
  CHECK(edge == Approx(sum / mesh.edge_count()));
  for (const double amount : {0.05, 0.5}) {
    std::vector<double> along;
    const auto normal = moves(mesh, perturb(as_loaded(mesh), noise(amount, NoiseKind::normal), 1, 0));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      along.push_back(normal[v].dot(normals[v]));
      CHECK((normal[v] - along.back() * normals[v]).norm() < 1e-12);
    }
    CHECK(tools::estimate(along).deviation == Approx(amount * edge).epsilon(0.03));
    CHECK(tools::estimate(along).mean == Approx(0).margin(0.04 * amount * edge));
    std::vector<double> axes[3];
    for (const Point& move : moves(mesh, perturb(as_loaded(mesh), noise(amount, NoiseKind::isotropic), 1, 0)))
      for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(move[axis]);
    double product = 0;
    for (std::size_t v = 0; v < axes[0].size(); ++v) product += axes[0][v] * axes[1][v];
    CHECK(std::abs(product) < 0.04 * amount * amount * edge * edge * mesh.vertex_count());
    for (const auto& axis : axes)
      CHECK(tools::estimate(axis).deviation == Approx(amount * edge).epsilon(0.03));
  }
}

TEST_CASE("a trial's noise is the same at all amounts, and that of another trial or seed is not") {
  const TriangleMesh mesh = torus(20, 12).mesh();
  for (const NoiseKind direction : {NoiseKind::normal, NoiseKind::isotropic}) {
    const auto at = [&](double amount, std::uint64_t seed, std::uint64_t trial) {
      return moves(mesh, perturb(as_loaded(mesh), noise(amount, direction), seed, trial));
    };
    const auto small = at(0.1, 1, 0);
    const auto large = at(0.4, 1, 0);
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK((large[v] - 4 * small[v]).norm() < 1e-12);
    CHECK(at(0.1, 1, 1) != small);
    CHECK(at(0.1, 2, 0) != small);
    CHECK(at(0.1, 1, 0) == small);
    const PerturbedMesh none = perturb(as_loaded(mesh), noise(0, direction), 1, 0);
    CHECK(positions(none.loaded.mesh) == positions(mesh));
    const PerturbedMesh some = perturb(as_loaded(mesh), noise(0.3, direction), 1, 0);
    CHECK(some.places == positions(mesh));
  }
}

TEST_CASE("decimation leaves a manifold of the same topology with vertices of the surface") {
  std::size_t done = 0;
  for (const NamedMesh& entry : mesh_zoo())
    for (const double share : {1.0, 0.8, 0.5}) {
      INFO(entry.name << " to " << share);
      const TriangleMesh& mesh = entry.mesh;
      try {
        const PerturbedMesh result = perturb(as_loaded(mesh), decimation(share), 3, 1);
        const TriangleMesh& fewer = result.loaded.mesh;
        fewer.validate();
        ++done;
        CHECK(fewer.vertex_count() == std::llround(share * mesh.vertex_count()));
        CHECK(fewer.euler_characteristic() == mesh.euler_characteristic());
        CHECK(fewer.component_count() == mesh.component_count());
        CHECK(fewer.boundary_loop_count() == mesh.boundary_loop_count());
        for (Index v = 0; v < fewer.vertex_count(); ++v) {
          const Index before = result.loaded.source.numbering.input_vertex(v);
          CHECK(fewer.position(v) == mesh.position(before));
          CHECK(result.loaded.source.numbering.mesh_vertex(before) == v);
          CHECK(result.places[v] == mesh.position(before));
          CHECK((!fewer.is_boundary_vertex(v) || mesh.is_boundary_vertex(before)));
        }
      } catch (const core::BadInput& error) {
        CHECK(share < 1);
        CHECK_THAT(error.what(), Catch::Contains("no edge can be collapsed any more"));
      }
    }
  CHECK(done > 2 * mesh_zoo().size());
  CHECK_THROWS_WITH(perturb(as_loaded(tetrahedron().mesh()), decimation(0.5), 1, 0),
                    Catch::Contains("decimated to 2 vertices") && Catch::Contains("4 of its 4"));
}

TEST_CASE("decimation around a vertex of very large degree keeps the surface") {
  // A cone of rings: its tip keeps hundreds of neighbours while the rings are thinned out.
  constexpr Index kAround = 20'000, kRings = 3;
  std::vector<Point> places = {Point(0, 0, 0)};
  std::vector<core::Triangle> triangles;
  const auto at = [&](Index ring, Index a) { return 1 + ring * kAround + a % kAround; };
  for (Index ring = 0; ring < kRings; ++ring)
    for (Index a = 0; a < kAround; ++a) {
      const double angle = 2 * 3.14159265358979 * a / kAround;
      places.push_back((1 + 1e-3 * ring) * Point(std::cos(angle), std::sin(angle), 0));
      if (ring == 0) {
        triangles.push_back({0, at(0, a), at(0, a + 1)});
      } else {
        triangles.push_back({at(ring - 1, a), at(ring, a), at(ring, a + 1)});
        triangles.push_back({at(ring - 1, a), at(ring, a + 1), at(ring - 1, a + 1)});
      }
    }
  const TriangleMesh mesh(places, triangles);
  const TriangleMesh fewer = perturb(as_loaded(mesh), decimation(0.2), 1, 0).loaded.mesh;
  fewer.validate();
  CHECK(fewer.vertex_count() == std::llround(0.2 * mesh.vertex_count()));
  CHECK(fewer.euler_characteristic() == 1);
  CHECK(fewer.boundary_loop_count() == 1);
}

TEST_CASE("decimation keeps the shape and spreads vertices evenly, differently in each trial") {
  const TriangleMesh mesh = sphere(4).mesh();
  const auto at = [&](std::uint64_t trial) {
    return perturb(as_loaded(mesh), decimation(0.25), 1, trial).loaded.mesh;
  };
  const TriangleMesh fewer = at(0);
  double volume = 0;
  for (const core::Triangle& t : fewer.triangles())
    volume += fewer.position(t[0]).dot(fewer.position(t[1]).cross(fewer.position(t[2]))) / 6;
  CHECK(volume == Approx(4 * 3.14159265 / 3).epsilon(0.03));
  std::vector<double> lengths;
  for (Index e = 0; e < fewer.edge_count(); ++e)
    lengths.push_back(
        (fewer.position(fewer.edge_vertices(e)[0]) - fewer.position(fewer.edge_vertices(e)[1])).norm());
  const tools::Estimate length = tools::estimate(lengths);
  CHECK(length.mean > 1.7 * core::mean_edge_length(mesh));
  CHECK(length.deviation < 0.4 * length.mean);
  CHECK(positions(at(0)) == positions(fewer));
  CHECK(positions(at(1)) != positions(fewer));
}

TEST_CASE("subdivision numbers its new vertices after those of the file") {
  const TriangleMesh mesh = annulus(8, 3).mesh();
  core::LoadedMesh clean = as_loaded(mesh);
  const PerturbedMesh finer = perturb(clean, subdivision(2), 1, 0);
  CHECK(finer.loaded.mesh.triangle_count() == 4 * mesh.triangle_count());
  CHECK(finer.places == positions(finer.loaded.mesh));
  // A file whose vertex 0 no face uses.
  core::VertexNumbering& numbering = clean.source.numbering;
  numbering.input_count = mesh.vertex_count() + 1;
  numbering.from_input = {core::kNone};
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    numbering.to_input.push_back(v + 1);
    numbering.from_input.push_back(v);
  }
  const core::LoadedMesh again = perturb(clean, subdivision(3), 1, 0).loaded;
  for (Index v = 0; v < again.mesh.vertex_count(); ++v) {
    CHECK(again.source.numbering.input_vertex(v) == v + 1);
    CHECK(again.source.numbering.mesh_vertex(v + 1) == v);
  }
  CHECK(again.source.numbering.input_count == again.mesh.vertex_count() + 1);
}
