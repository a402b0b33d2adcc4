#include "morsel/morse/functions/spectral_signatures.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/operators/eigenfunctions.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::heat_kernel_signature;
using morse::wave_kernel_signature;
using std::numbers::pi;

namespace {

/// Of the unit sphere, whose eigenvalues are l(l + 1), 2l + 1 times each.
double heat_of_sphere(double time, int degrees) {
  double sum = 0;
  for (int l = 0; l <= degrees; ++l) sum += (2 * l + 1) * std::exp(-l * (l + 1) * time);
  return sum / (4 * pi);
}

}  // namespace

TEST_CASE("heat and wave kernel signatures of a sphere are those of its eigenvalues") {
  const TriangleMesh mesh = sphere(4).mesh();
  constexpr int kDegrees = 7;
  const std::size_t modes = (kDegrees + 1) * (kDegrees + 1) - 1;
  for (const double spread : {0.5, 0.8, 1.5}) {
    const morse::Signature heat = heat_kernel_signature(mesh, spread, modes);
    const double expected = heat_of_sphere(spread * spread / 2, kDegrees);
    CHECK(heat.modes == modes);
    CHECK(-std::log(heat.last) == Approx(kDegrees * (kDegrees + 1) * spread * spread / 2).epsilon(0.03));
    CHECK(heat.field.min() == Approx(expected).epsilon(0.02));
    CHECK(heat.field.max() == Approx(expected).epsilon(0.02));
  }
  // Σ φ² over an eigenvalue is (2l + 1)/4π, so that every weighted mean over modes is 1/4π.
  for (const double energy : {0.0, 0.4, 0.9}) {
    const ScalarField wave = wave_kernel_signature(mesh, energy, 0.07, modes).field;
    CHECK(wave.min() == Approx(1 / (4 * pi)).epsilon(0.05));
    CHECK(wave.max() == Approx(1 / (4 * pi)).epsilon(0.05));
  }
}

TEST_CASE("signatures are sums over the eigenfunctions") {
  const TriangleMesh mesh = together(torus(14, 9), punctured_sphere(2, 1)).mesh();
  const std::vector<morse::Eigenfunction> functions = morse::eigenfunctions(mesh, 12);
  const double spread = 1.3;
  const ScalarField heat = heat_kernel_signature(mesh, spread, 12).field;
  const ScalarField wave = wave_kernel_signature(mesh, 0.3, 0.2, 12).field;
  const ScalarField constants = heat_kernel_signature(mesh, 1e3, 12).field;  // nothing else is left
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double sum = constants.value(v);
    double weighted = 0;
    double total = 0;
    for (const morse::Eigenfunction& f : functions) {
      sum += std::exp(-f.eigenvalue * spread * spread / 2) * f.phi[v] * f.phi[v];
      const double low = std::log(functions.front().eigenvalue);
      const double place = (std::log(f.eigenvalue) - low) / (std::log(functions.back().eigenvalue) - low);
      const double weight = std::exp(-(0.3 - place) * (0.3 - place) / (2 * 0.2 * 0.2));
      weighted += weight * f.phi[v] * f.phi[v];
      total += weight;
    }
    CHECK(heat.value(v) == Approx(sum).epsilon(1e-9));
    CHECK(wave.value(v) == Approx(weighted / total).epsilon(1e-9));
  }
  CHECK(constants.value(0) != Approx(constants.value(mesh.vertex_count() - 1)));  // each its own area
}

TEST_CASE("signatures scale with the surface and do not turn with it") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.05, 5);
  const ScalarField heat = heat_kernel_signature(mesh, 0.4, 30).field;
  const ScalarField wave = wave_kernel_signature(mesh, 0.5, 0.07, 30).field;
  const double factor = 3;
  const ScalarField large_heat = heat_kernel_signature(scaled(mesh, factor), 0.4 * factor, 30).field;
  const ScalarField large_wave = wave_kernel_signature(scaled(mesh, factor), 0.5, 0.07, 30).field;
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const ScalarField turned = heat_kernel_signature(moved(mesh, turn, Point(3, 1, 2)), 0.4, 30).field;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(large_heat.value(v) * factor * factor == Approx(heat.value(v)).epsilon(1e-6));
    CHECK(large_wave.value(v) * factor * factor == Approx(wave.value(v)).epsilon(1e-6));
    CHECK(turned.value(v) == Approx(heat.value(v)).epsilon(1e-6));
  }
}

TEST_CASE("signatures by name report what they came to") {
  const TriangleMesh mesh = sphere(2).mesh();
  const auto heat = made(morse::make_heat_kernel_signature, "heat-kernel-signature", {{"modes", "9"}});
  const core::Parameters parameters = heat->evaluate(mesh, {}).parameters;
  CHECK(parameters[0] == std::pair<std::string, core::ParameterValue>("time", 0.1 * core::root_area(mesh)));
  CHECK(parameters[1] == std::pair<std::string, core::ParameterValue>("modes", std::int64_t{9}));
  CHECK(parameters[2].first == "last_weight");
  const auto wave = made(morse::make_wave_kernel_signature, "wave-kernel-signature", {{"modes", "900"}});
  CHECK(wave->evaluate(mesh, {}).parameters[2] ==
        std::pair<std::string, core::ParameterValue>("modes", std::int64_t{161}));  // all that it has
}

TEST_CASE("signatures refuse what they do not know") {
  const TriangleMesh mesh = octahedron().mesh();
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(heat_kernel_signature(mesh, bad, 3), core::InvalidArgument);
    CHECK_THROWS_AS(wave_kernel_signature(mesh, 0.5, bad, 3), core::InvalidArgument);
  }
  CHECK_THROWS_AS(wave_kernel_signature(mesh, 1.5, 0.1, 3), core::InvalidArgument);
  CHECK_THROWS_AS(heat_kernel_signature(mesh, 1, 0), core::InvalidArgument);
  CHECK_THROWS_AS(heat_kernel_signature(point, 1, 3), core::BadInput);
  CHECK_THROWS_AS(made(morse::make_heat_kernel_signature, "heat-kernel-signature")->evaluate(point, {}),
                  core::BadInput);
  CHECK_THROWS_AS(made(morse::make_heat_kernel_signature, "h", {{"time", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(made(morse::make_wave_kernel_signature, "w", {{"energy", "2"}}), core::InvalidArgument);
  CHECK_THROWS_AS(made(morse::make_wave_kernel_signature, "w", {{"modes", "0"}}), core::InvalidArgument);
  CHECK(wave_kernel_signature(mesh, 0.5, morse::kLeastWidth, 5).field.min() > 0);  // between two energies
}

TEST_CASE("signatures are the same for every number of threads") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return values_of(heat_kernel_signature(mesh, 0.1, 20).field);
  };
  CHECK(run(1) == run(4));
}
