// Costly inputs for what is computed on meshes.

#include <memory>
#include <random>
#include <utility>

#include "benchmark/adversarial.h"
#include "morsel/morse/operators/heat_distance.h"
#include "morsel/morse/smoothing/denoise.h"
#include "morsel/mscomplex/cut.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/tools/molecule/surface.h"
#include "morsel/tools/render/glyphs.h"
#include "morsel/tools/study/point_matching.h"
#include "support/adversarial.h"
#include "support/meshes.h"
#include "support/molecules.h"

namespace morsel::benchmark {
namespace {

using core::ScalarField;
using core::TriangleMesh;
namespace adversarial = test::adversarial;

template <class Value>
std::vector<double> values(const TriangleMesh& mesh, const Value& value) {
  std::vector<double> result;
  for (const core::Point& p : mesh.positions()) result.push_back(value(p));
  return result;
}

/// Finds a cut for the height, shortens it and opens the surface.
std::function<void()> cutting(const TriangleMesh& mesh) {
  const ScalarField field(mesh, values(mesh, [](const core::Point& p) { return p.z() + 0.01 * p.x(); }));
  const auto complex = std::make_shared<mscomplex::MorseSmaleComplex>(field);
  return [mesh, field, complex] {
    const mscomplex::CutGraph cut = mscomplex::find_cut(*complex, field);
    mscomplex::cut_open(mesh, mscomplex::shorten(mesh, cut).cut.edges);
  };
}

/// One iteration with the default lengths.
std::function<void()> denoising(const TriangleMesh& mesh) {
  return [mesh] { morse::SurfaceSmoothing(mesh, morse::BilateralDenoising{}).step({}); };
}

/// A layout and its quads, of a field that has two minima, maxima and saddles on a bipyramid.
std::function<void()> quads(const TriangleMesh& mesh) {
  const ScalarField field(mesh, values(mesh, [](const core::Point& p) { return p.x() * p.y(); }));
  const auto repaired = std::make_shared<mscomplex::RepairedComplex>(
      mscomplex::repair_dangling(field, mscomplex::MorseSmaleComplex(field)));
  return [repaired] { mscomplex::sample(mscomplex::embed_layout(repaired->complex), 8); };
}

/// The distance to all boundary vertices.
std::function<void()> distance_to_boundary(const TriangleMesh& mesh) {
  std::vector<core::Index> sources;
  for (core::Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const core::Index h : mesh.boundary_loop(k)) sources.push_back(mesh.origin(h));
  return [mesh, sources = std::move(sources)] { morse::HeatDistance(mesh, {}).from(sources); };
}

std::vector<core::Point> points_in_cube(std::size_t count, double side, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, side);
  std::vector<core::Point> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(place(random), place(random), place(random));
  return points;
}

/// All of as many points within the radius of all others, and a chance level.
std::function<void()> matching(std::size_t count) {
  return [reference = points_in_cube(count, 1, 1), other = points_in_cube(count, 1, 2)] {
    const tools::PointMatcher matcher(reference, 2);
    matcher.match(other);
    for (int placement = 0; placement < 10; ++placement) matcher.count(other);
  };
}

/// Atoms in a cube that all come within the reach of one probe.
std::function<void()> excluded_surface(std::size_t count) {
  std::vector<core::Atom> atoms;
  for (const core::Point& p : points_in_cube(count, 4, 3)) atoms.push_back(test::atom_at(p, 1.7));
  tools::SurfaceOptions options;
  options.kind = tools::SurfaceKind::ses;
  return [atoms = std::move(atoms), options] { tools::molecular_surface(atoms, options); };
}

/// Arcs as tubes; nearly all of them meet at two poles.
std::function<void()> drawing_arcs(const TriangleMesh& mesh) {
  std::mt19937 random(4);
  const ScalarField field(mesh, values(mesh, [&](const core::Point&) { return double(random()); }));
  const auto complex = std::make_shared<mscomplex::MorseSmaleComplex>(field);
  return [mesh, complex] {
    tools::render::Scene scene{tools::render::make_body(mesh)};
    tools::render::add_arcs(scene, tools::render::Rays(scene.body.mesh), *complex, 0.0012);
  };
}

}  // namespace

std::vector<Family> algorithm_families() {
  using Size = std::size_t;
  return {
      {"cut of many components", 10'000,
       [](const Plan&, Size n) { return cutting(adversarial::tetrahedra(n)); }},
      {"cut of many boundary loops", 500,
       [](const Plan&, Size n) { return cutting(adversarial::pierced_sheet(n)); }},
      {"denoise at poles of large degree", 2'500,
       [](const Plan&, Size n) { return denoising(test::bipyramid(static_cast<int>(n)).mesh()); }},
      {"quads at poles of large degree", 1'000,
       [](const Plan&, Size n) { return quads(test::bipyramid(static_cast<int>(n)).mesh()); }},
      {"matching of points all in reach", 1'000, [](const Plan&, Size n) { return matching(n); }},
      {"excluded surface of dense atoms", 500, [](const Plan&, Size n) { return excluded_surface(n); }},
      {"arcs at poles of large degree", 1'000,
       [](const Plan&, Size n) { return drawing_arcs(test::bipyramid(static_cast<int>(n)).mesh()); }},
      {"heat distance to many sources", 1'000,
       [](const Plan&, Size n) { return distance_to_boundary(adversarial::pierced_sheet(n)); }},
  };
}

}  // namespace morsel::benchmark
