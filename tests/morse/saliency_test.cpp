#include "morsel/morse/smoothing/saliency.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
namespace {

core::MethodResult apply_saliency(const ScalarField& field, Given given) {
  return made(morse::make_saliency, "saliency", std::move(given))->apply(field, {});
}

/// The papers' steps one after the other.
std::vector<double> slow_saliency(const ScalarField& field, const std::vector<double>& scales,
                                  bool suppress) {
  const std::size_t n = field.mesh().vertex_count();
  const auto average = [&](double sigma) {
    morse::GaussianOptions options;
    options.sigma = core::Length::absolute(sigma);
    return morse::gaussian(field, options);
  };
  std::vector<double> sum(n, 0.0);
  std::vector<Index> ring;
  for (const double sigma : scales) {
    const ScalarField fine = average(sigma);
    const ScalarField coarse = average(2 * sigma);
    std::vector<double> map;
    for (Index v = 0; v < n; ++v) map.push_back(std::abs(fine.value(v) - coarse.value(v)));
    if (suppress) {
      const double least = *std::min_element(map.begin(), map.end());
      const double most = *std::max_element(map.begin(), map.end());
      for (double& s : map) s = most > least ? (s - least) / (most - least) : 0;
      double mean = 0;
      int count = 0;
      for (Index v = 0; v < n; ++v) {
        field.mesh().neighbors(v, ring);
        const bool is_maximum =
            map[v] < 1 && std::all_of(ring.begin(), ring.end(), [&](Index u) { return map[u] < map[v]; });
        if (is_maximum) mean += map[v];
        count += is_maximum ? 1 : 0;
      }
      if (count > 0) mean /= count;
      for (double& s : map) s *= (1 - mean) * (1 - mean);
    }
    for (Index v = 0; v < n; ++v) sum[v] += map[v];
  }
  return sum;
}

}  // namespace

TEST_CASE("saliency is the steps of the papers") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const TriangleMesh mesh = jittered(entry.mesh, 0.02, 3);
    const ScalarField field(mesh, random_values(mesh.vertex_count(), 7));
    const double unit = 0.1 * mesh.bounding_box().diagonal();
    const std::vector<double> scales = {unit, 1.5 * unit, 2 * unit};
    for (const bool suppress : {true, false}) {
      morse::SaliencyOptions options;
      options.suppression = suppress ? morse::Suppression::itti : morse::Suppression::none;
      options.scales.clear();
      for (const double scale : scales) options.scales.push_back(core::Length::absolute(scale));
      const morse::SaliencyResult result = morse::saliency(field, options);
      const std::vector<double> expected = slow_saliency(field, scales, suppress);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        CHECK(result.field.value(v) == Approx(expected[v]).margin(1e-13));
      CHECK(result.scales == scales);
      CHECK(result.factors.size() == 3);
    }
  }
}

TEST_CASE("saliency without suppression of a single peak by hand") {
  // Sides 3, 4, 5: at σ = 1 no vertex has neighbours, but in the coarse map vertex 0 reaches 3 and 4.
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const core::MethodResult result =
      apply_saliency({mesh, {6, 0, 0}}, {{"scales", "1"}, {"suppression", "none"}});
  const double w1 = std::exp(-9.0 / 8);
  const double w2 = std::exp(-2.0);
  CHECK(result.field.value(0) == Approx(6 - 6 / (1 + w1 + w2)));
  CHECK(result.field.value(1) == Approx(6 * w1 / (1 + w1)));
  CHECK(result.field.value(2) == Approx(6 * w2 / (1 + w2)));
  // Normalised, the highest value is the only local maximum: m̄ = 0.
  CHECK(apply_saliency({mesh, {6, 0, 0}}, {{"scales", "1"}}).field.max() == 1);
}

TEST_CASE("saliency of a constant is zero") {
  for (const char* suppression : {"itti", "none"}) {
    const TriangleMesh mesh = sphere(2).mesh();
    const ScalarField field(mesh, std::vector<double>(mesh.vertex_count(), 3.25));
    const ScalarField result =
        apply_saliency(field, {{"suppression", suppression}, {"scales", "9eps/20eps"}}).field;
    CHECK(result.min() == 0);
    CHECK(result.max() == 0);
  }
}

TEST_CASE("suppressed saliency has no unit and does not turn with the mesh") {
  const TriangleMesh mesh = jittered(torus(30, 20).mesh(), 0.05, 3);
  const std::vector<double> values = random_values(mesh.vertex_count(), 5);
  std::vector<double> other = values;
  for (double& value : other) value = 8 * value - 100;
  const Given given = {{"scales", "0.3/0.4"}};
  const ScalarField a = apply_saliency({mesh, values}, given).field;
  const ScalarField b = apply_saliency({mesh, other}, given).field;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  const ScalarField c =
      apply_saliency({moved(mesh, 3 * turn, {7, -4, 2}), values}, {{"scales", "0.9/1.2"}}).field;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(b.value(v) == Approx(a.value(v)).margin(1e-10));
    CHECK(c.value(v) == Approx(a.value(v)).margin(1e-10));
  }
}

TEST_CASE("saliency reports its scales and gives the same bits for every number of threads") {
  const TriangleMesh mesh = sphere(4).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 5));
  const core::MethodResult result = apply_saliency(field, {{"scales", "0.1/0.25"}, {"suppression", "none"}});
  CHECK(result.parameters == core::Parameters{{"scales", "0.1/0.25"},
                                              {"suppression", "none"},
                                              {"support", 2.0},
                                              {"weights", "none"},
                                              {"ball", "euclidean"}});
  CHECK(result.details == core::Parameters{{"factors", "1/1"}});
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return values_of(apply_saliency(field, {{"ball", "connected"}}).field);
  };
  CHECK(run(1) == run(4));
}

TEST_CASE("saliency refuses what is out of range") {
  const ScalarField field(octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3});
  const Given bad = {{"scales", "0"},           {"scales", "2eps/-1eps"}, {"scales", "2eps//3eps"},
                     {"scales", "2 eps"},       {"scales", ""},           {"support", "0"},
                     {"suppression", "strong"}, {"sigma", "8eps"},        {"ball", "flat"}};
  for (const auto& [key, value] : bad) {
    INFO(key << "=" << value);
    CHECK_THROWS_AS(apply_saliency(field, {{key, value}}), core::InvalidArgument);
    CHECK_THROWS_WITH(apply_saliency(field, {{key, value}}), Catch::Contains(key));
  }
  morse::SaliencyOptions none;
  none.scales.clear();
  CHECK_THROWS_AS(morse::saliency(field, none), core::InvalidArgument);
  const ScalarField point(field.mesh().with_positions(std::vector<Point>(6, Point(1, 2, 3))),
                          {1, 2, 3, 4, 5, 6});
  CHECK_THROWS_AS(morse::saliency(point), core::BadInput);
}

TEST_CASE("counts of saliency on the samples") {
  const auto total = [](const char* file, Given given) {
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    return morse::classify(apply_saliency(field, std::move(given)).field).total();
  };
  const std::string published = "2eps/3eps/4eps/5eps/6eps";
  CHECK(total("lion-head.off", {{"scales", published}}) == 1539);
  CHECK(total("lion-head.off", {{"scales", published}, {"suppression", "none"}}) == 1641);
  CHECK(total("bunny00.off", {{"scales", published}}) == 3702);
}
