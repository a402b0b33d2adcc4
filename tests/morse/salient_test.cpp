#include "morsel/morse/smoothing/salient.h"

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
#include "support/meshes.h"
#include "support/salient_reference.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::Length;
using core::ScalarField;
using morse::SalientOptions;
using morse::ValueRange;

namespace {

ValueRange range(const char* text) { return morse::parse_value_range(text, "range"); }

SalientOptions options(int iterations, double sigma, const char* range_text, double support = 2) {
  SalientOptions result;
  result.iterations = iterations;
  result.sigma = Length::absolute(sigma);
  result.range = range(range_text);
  result.support = support;
  return result;
}

/// The population's standard deviation, plainly.
double deviation(const ScalarField& field) {
  double mean = 0;
  for (const double f : field.values()) mean += f / field.mesh().vertex_count();
  double square = 0;
  for (const double f : field.values()) square += (f - mean) * (f - mean) / field.mesh().vertex_count();
  return std::sqrt(square);
}

}  // namespace

TEST_CASE("one salient iteration is the formula") {
  // A triangle with sides 3, 4, 5; support 2 of σ = 2 takes in the sides 3 and 4 (at the cut-off) but not 5.
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const auto result = morse::salient({mesh, {1, 2, 5}}, options(1, 2, "4"));
  const double w1 = std::exp(-9.0 / 8) * std::exp(-1.0 / 32);
  const double w2 = std::exp(-16.0 / 8) * std::exp(-16.0 / 32);
  CHECK(result.field.value(0) == Approx(1 + (w1 + 4 * w2) / (1 + w1 + w2)).epsilon(1e-15));
  CHECK(result.field.value(1) == Approx(2 - w1 / (1 + w1)).epsilon(1e-15));
  CHECK(result.field.value(2) == Approx(5 - 4 * w2 / (1 + w2)).epsilon(1e-15));
  CHECK(result.pairs == 7);
  CHECK(result.sigma == 2);
  CHECK(result.sigma_s == 4.0);
}

TEST_CASE("the neighbourhood includes its rim and nothing beyond it") {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const ScalarField field(mesh, {1, 2, 5});
  CHECK(morse::salient(field, options(1, 1.5, "1", 2)).pairs == 5);
  CHECK(morse::salient(field, options(1, std::nextafter(1.5, 0.0), "1", 2)).pairs == 3);
  CHECK(morse::salient(field, options(1, 5, "1", 1)).pairs == 9);
  CHECK(morse::salient(field, options(1, std::nextafter(5.0, 0.0), "1", 1)).pairs == 7);
}

TEST_CASE("salient smoothing agrees with the listing on every field of every mesh") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 21)) {
      const double sigma = 0.1 * entry.mesh.bounding_box().diagonal();
      for (const double support : {2.0, 1.0})
        for (const char* text : {"1std", "0.3std", "local", "literal", "0.25"}) {
          INFO(entry.name << ", " << f.name << ", " << text << ", support " << support);
          const auto result = morse::salient(f.field, options(4, sigma, text, support));
          SalientReferenceOptions slow{4, sigma, support, {}};
          const ValueRange chosen = range(text);
          if (chosen.kind == ValueRange::Kind::deviations) slow.sigma_s = chosen.value * deviation(f.field);
          if (chosen.kind == ValueRange::Kind::literal) slow.sigma_s = sigma;
          if (chosen.kind == ValueRange::Kind::fixed) slow.sigma_s = chosen.value;
          std::vector<double> saliency;
          const std::vector<double> expected =
              salient_reference(entry.mesh.positions(), values_of(f.field), slow, &saliency);
          REQUIRE(result.sigma_s.has_value() == slow.sigma_s.has_value());
          if (slow.sigma_s) CHECK(*result.sigma_s == Approx(*slow.sigma_s).epsilon(1e-12).margin(1e-14));
          const double scale = std::max(std::abs(f.field.min()), std::abs(f.field.max()));
          double worst = 0;
          for (Index v = 0; v < entry.mesh.vertex_count(); ++v)
            worst = std::max(worst, std::abs(result.field.value(v) - expected[v]));
          CHECK(worst <= 1e-12 * scale);
          SalientOptions last = options(4, sigma, text, support);
          last.return_saliency = true;
          const ScalarField shown = morse::salient(f.field, last).field;
          for (Index v = 0; v < entry.mesh.vertex_count(); ++v)
            worst = std::max(worst, std::abs(shown.value(v) - saliency[v]));
          CHECK(worst <= 1e-12 * scale);
        }
    }
}

TEST_CASE("every instruction set and precision agrees with the listing on every field of every mesh") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 24)) {
      const double sigma = 0.1 * entry.mesh.bounding_box().diagonal();
      const double extent = f.field.max() - f.field.min();
      const double scale = std::max(std::abs(f.field.min()), std::abs(f.field.max()));
      for (const char* text : {"1std", "local"}) {
        SalientOptions chosen = options(3, sigma, text);
        SalientReferenceOptions slow{3, sigma, 2, {}};
        if (range(text).kind == ValueRange::Kind::deviations) slow.sigma_s = deviation(f.field);
        const auto expected = salient_reference(entry.mesh.positions(), values_of(f.field), slow);
        std::uint64_t pairs = 0;
        for (const morse::InstructionSet set : morse::instruction_sets())
          for (const morse::Precision precision : {morse::Precision::float64, morse::Precision::float32}) {
            INFO(entry.name << ", " << f.name << ", " << text << ", " << to_string(set) << ", "
                            << (precision == morse::Precision::float64 ? "double" : "single"));
            chosen.instructions = set;
            chosen.precision = precision;
            const auto result = morse::salient(f.field, chosen);
            if (pairs == 0) pairs = result.pairs;
            CHECK(result.pairs == pairs);
            double worst = 0;
            for (Index v = 0; v < entry.mesh.vertex_count(); ++v)
              worst = std::max(worst, std::abs(result.field.value(v) - expected[v]));
            CHECK(worst <= 1e-12 * scale + (precision == morse::Precision::float64 ? 0 : 1e-6 * extent));
          }
      }
    }
}

TEST_CASE("instruction sets with fused multiply-adds give the same bits") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 9);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 4));
  for (const char* text : {"1std", "local"})
    for (const morse::Precision precision : {morse::Precision::float64, morse::Precision::float32}) {
      std::vector<double> expected;
      for (const morse::InstructionSet set : morse::instruction_sets()) {
        if (set == morse::InstructionSet::baseline) continue;
        SalientOptions chosen = options(4, 0.1, text);
        chosen.instructions = set;
        chosen.precision = precision;
        const std::vector<double> values = values_of(morse::salient(field, chosen).field);
        if (expected.empty()) expected = values;
        CHECK(values == expected);
      }
    }
  for (const char* text : {"1std", "local", "none"}) {
    std::vector<double> expected;
    for (const morse::InstructionSet set : morse::instruction_sets()) {
      if (set == morse::InstructionSet::baseline) continue;
      SalientOptions chosen = options(4, 0.1, text);
      chosen.instructions = set;
      chosen.weights = morse::NeighborWeights::area;
      const std::vector<double> values = values_of(morse::salient(field, chosen).field);
      if (expected.empty()) expected = values;
      CHECK(values == expected);
    }
  }
}

TEST_CASE("ten iterations on real meshes keep to the listing in both precisions") {
  const ScalarField field = morse::mean_curvature(core::read_mesh(sample("lion-head.off")).mesh);
  const double extent = field.max() - field.min();
  for (const char* text : {"1std", "local"}) {
    SalientOptions chosen;
    chosen.range = range(text);
    const auto twice = morse::salient(field, chosen);
    const auto expected = salient_reference(field.mesh().positions(), values_of(field),
                                            {10, twice.sigma, chosen.support, twice.sigma_s});
    const auto total = morse::classify({field.mesh(), expected}).total();
    for (const morse::InstructionSet set : morse::instruction_sets())
      for (const morse::Precision precision : {morse::Precision::float64, morse::Precision::float32}) {
        INFO(text << ", " << to_string(set));
        const bool single = precision == morse::Precision::float32;
        chosen.instructions = set;
        chosen.precision = precision;
        const ScalarField found = morse::salient(field, chosen).field;
        double worst = 0;
        for (Index v = 0; v < field.mesh().vertex_count(); ++v)
          worst = std::max(worst, std::abs(found.value(v) - expected[v]));
        CHECK(worst <= (single ? 1e-6 : 1e-10) * extent);
        const auto points = static_cast<double>(morse::classify(found).total());
        CHECK(points == Approx(total).epsilon(0).margin(single ? std::max(6.0, 0.06 * total)
                                                               : std::max(2.0, 0.005 * total)));
      }
  }
}

TEST_CASE("single precision holds where a mesh is wide compared with sigma") {
  // A tiny sphere far from a large one.
  Soup far = sphere(3);
  for (Point& p : far.positions) p = 1e-3 * p + Point(1000, 2000, -500);
  const TriangleMesh mesh = together(far, sphere(3)).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 12));
  for (const double sigma : {2e-4, 0.1})
    for (const char* text : {"1std", "local", "1e-3", "1e-12", "1e6"}) {
      INFO(sigma << ", " << text);
      SalientOptions chosen = options(5, sigma, text);
      const auto expected = morse::salient(field, chosen);
      chosen.precision = morse::Precision::float32;
      const auto found = morse::salient(field, chosen);
      CHECK(found.pairs == expected.pairs);
      double worst = 0;
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        worst = std::max(worst, std::abs(found.field.value(v) - expected.field.value(v)));
      CHECK(worst <= 1e-6);
    }
}

TEST_CASE("single precision gives the same bits for every number of threads and any memory") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 9);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 4));
  for (const char* text : {"1std", "local"}) {
    std::vector<double> expected;
    for (const int threads : {1, 2, 7})
      for (const std::size_t memory : {std::size_t{0}, std::size_t{100'000}, std::size_t{1} << 30}) {
        const core::ThreadLimit limit(threads);
        SalientOptions chosen = options(4, 0.1, text);
        chosen.memory = memory;
        chosen.precision = morse::Precision::float32;
        const std::vector<double> values = values_of(morse::salient(field, chosen).field);
        if (expected.empty()) expected = values;
        CHECK(values == expected);
      }
  }
}

TEST_CASE("every field that salient smoothing returns obeys the Euler identity") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 22))
      for (const char* text : {"1std", "local", "literal"})
        for (const bool saliency : {false, true}) {
          INFO(entry.name << ", " << f.name << ", " << text << (saliency ? ", saliency" : ""));
          SalientOptions chosen = options(3, 0.08 * entry.mesh.bounding_box().diagonal(), text);
          chosen.return_saliency = saliency;
          const auto points = morse::classify(morse::salient(f.field, chosen).field);
          CHECK(static_cast<long>(points.minima + points.maxima) -
                    static_cast<long>(points.saddle_multiplicity) ==
                entry.mesh.euler_characteristic());
        }
}

TEST_CASE("a constant field stays as it is") {
  const TriangleMesh mesh = sphere(2).mesh();
  for (const double value : {0.0, 0.1, -7e300, 3e-310})
    for (const char* text : {"1std", "local", "literal", "0.5"}) {
      const ScalarField field(mesh, std::vector<double>(mesh.vertex_count(), value));
      const auto result = morse::salient(field, options(3, 0.5, text));
      CHECK(values_of(result.field) == values_of(field));
      if (range(text).kind == ValueRange::Kind::deviations) CHECK(result.sigma_s == 0.0);
    }
}

TEST_CASE("a ball without spread has no saliency") {
  // Two spheres far apart, one of them constant.
  const TriangleMesh mesh = together(sphere(1), sphere(1)).mesh();
  std::vector<double> values = random_values(mesh.vertex_count(), 3);
  std::fill(values.begin(), values.begin() + mesh.vertex_count() / 2, 0.1);
  const auto result = morse::salient({mesh, values}, options(2, 0.4, "local"));
  for (Index v = 0; v < mesh.vertex_count() / 2; ++v) CHECK(result.field.value(v) == 0.1);
  CHECK(result.field.value(mesh.vertex_count() - 1) != values.back());
}

TEST_CASE("salient smoothing gives the same bits for every number of threads and any memory") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 9);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 4));
  for (const char* text : {"1std", "local"}) {
    const auto run = [&](int threads, std::size_t memory) {
      const core::ThreadLimit limit(threads);
      SalientOptions chosen = options(4, 0.1, text);
      chosen.memory = memory;
      const auto result = morse::salient(field, chosen);
      return std::pair(values_of(result.field), result.pairs);
    };
    const auto expected = run(1, std::size_t{1} << 30);
    CHECK(expected.second > 20 * std::size_t{mesh.vertex_count()});
    for (const int threads : {1, 2, 7})
      for (const std::size_t memory :
           {std::size_t{0}, std::size_t{3}, std::size_t{100'000}, std::size_t{1} << 30})
        CHECK(run(threads, memory) == expected);
  }
}

TEST_CASE("every iteration can be observed and is what fewer iterations return") {
  const TriangleMesh mesh = torus(20, 15).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 5));
  std::vector<std::vector<double>> seen = {values_of(field)};
  std::vector<std::vector<double>> saliency = {{}};
  SalientOptions chosen = options(5, 0.4, "local");
  chosen.on_iteration = [&](const morse::SalientIteration& iteration) {
    CHECK(iteration.number == static_cast<int>(seen.size()));
    seen.emplace_back(iteration.values.begin(), iteration.values.end());
    saliency.emplace_back(iteration.saliency.begin(), iteration.saliency.end());
    return true;
  };
  morse::salient(field, chosen);
  REQUIRE(seen.size() == 6);
  for (int k = 0; k <= 5; ++k) {
    SalientOptions fewer = options(k, 0.4, "local");
    CHECK(values_of(morse::salient(field, fewer).field) == seen[k]);
    if (k == 0) continue;
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(seen[k][v] == seen[k - 1][v] + saliency[k][v]);
    fewer.return_saliency = true;
    CHECK(values_of(morse::salient(field, fewer).field) == saliency[k]);
  }
}

TEST_CASE("negating before or after salient smoothing is the same") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 23))
      for (const char* text : {"1std", "local"}) {
        INFO(entry.name << ", " << f.name << ", " << text);
        const SalientOptions chosen = options(2, 0.08 * entry.mesh.bounding_box().diagonal(), text);
        // The standard deviation is taken from the minimum up, which rounds differently.
        const ScalarField before = morse::salient(f.field.negated(), chosen).field;
        const ScalarField after = morse::salient(f.field, chosen).field.negated();
        double worst = 0;
        for (Index v = 0; v < entry.mesh.vertex_count(); ++v)
          worst = std::max(worst, std::abs(before.value(v) - after.value(v)));
        CHECK(worst <= 1e-13 * std::max(std::abs(f.field.min()), std::abs(f.field.max())));
        if (range(text).kind != ValueRange::Kind::local) continue;
        CHECK(values_of(before) == values_of(after));
        CHECK(std::equal(before.ranks().begin(), before.ranks().end(), after.ranks().begin()));
      }
}

TEST_CASE("salient critical points do not change when the mesh is moved turned scaled or renumbered") {
  const Soup soup = sphere(3);
  const TriangleMesh mesh = jittered(soup.mesh(), 0.02, 7);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 8));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Point(2, 1, -1).normalized()).toRotationMatrix();
  Soup moved{{mesh.positions().begin(), mesh.positions().end()}, soup.triangles};
  for (Point& p : moved.positions) p = 40 * (turn * p) + Point(3, -50, 11);
  std::vector<Index> new_number;
  const TriangleMesh other = shuffled(moved, 6, &new_number).mesh();
  std::vector<double> other_values(field.values().size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) other_values[new_number[v]] = 5 * field.value(v) - 2;
  for (const char* text : {"1std", "0.5std", "local"})
    for (const int iterations : {1, 5}) {
      INFO(text << ", " << iterations);
      const ScalarField a = morse::salient(field, options(iterations, 0.1, text)).field;
      const ScalarField b = morse::salient({other, other_values}, options(iterations, 4, text)).field;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(b.value(new_number[v]) == Approx(5 * a.value(v) - 2).margin(1e-11));
        const morse::CriticalPoint p = morse::classify_vertex(a, v);
        const morse::CriticalPoint q = morse::classify_vertex(b, new_number[v]);
        CHECK(q.type == p.type);
        CHECK(q.multiplicity == p.multiplicity);
      }
    }
}

TEST_CASE("salient smoothing is exact under powers of two and survives the ends of the range") {
  const TriangleMesh mesh = jittered(sphere(2).mesh(), 0.02, 3);
  const std::vector<double> values = random_values(mesh.vertex_count(), 9);
  for (const char* text : {"1std", "local"}) {
    const std::vector<double> expected =
        values_of(morse::salient({mesh, values}, options(3, 0.3, text)).field);
    for (const int exponent : {-900, -1, 30, 1020}) {
      std::vector<double> other = values;
      for (double& f : other) f = std::ldexp(f, exponent);
      std::vector<double> result = values_of(morse::salient({mesh, other}, options(3, 0.3, text)).field);
      for (double& f : result) f = std::ldexp(f, -exponent);
      CHECK(result == expected);
    }
    for (const int exponent : {-300, 400})
      CHECK(values_of(morse::salient({scaled(mesh, std::ldexp(1.0, exponent)), values},
                                     options(3, std::ldexp(0.3, exponent), text))
                          .field) == expected);
  }
  // Differences that overflow, standard deviations that vanish: finite, and within the field's extent.
  std::vector<double> extreme = values;
  for (std::size_t v = 0; v < extreme.size(); ++v) extreme[v] = v % 2 == 0 ? 1.7e308 : -1.7e308;
  for (const char* text : {"1std", "local", "literal", "5e-324", "1e-200", "1e308", "1e-320std"}) {
    INFO(text);
    const ScalarField result = morse::salient({mesh, extreme}, options(3, 0.3, text)).field;
    CHECK(result.min() >= -1.7e308);
    CHECK(result.max() <= 1.7e308);
    const ScalarField plain = morse::salient({mesh, values}, options(3, 0.3, text)).field;
    CHECK(plain.min() >= 0);
    CHECK(plain.max() <= 1);
  }
}

TEST_CASE("no iteration returns the field as it is") {
  const TriangleMesh mesh = square_pair().mesh();
  const ScalarField field(mesh, {1, 1, 0, 1}, {3, 2, 0, 1});
  const ScalarField same = morse::salient(field, options(0, 1, "1std")).field;
  CHECK(values_of(same) == values_of(field));
  CHECK(std::equal(same.ranks().begin(), same.ranks().end(), field.ranks().begin()));
}

TEST_CASE("equal values keep the order that they came with") {
  const TriangleMesh mesh = square_pair().mesh();
  const ScalarField field(mesh, {1, 1, 1, 1}, {3, 2, 0, 1});
  const ScalarField same = morse::salient(field, options(3, 1, "1std")).field;
  CHECK(std::equal(same.ranks().begin(), same.ranks().end(), field.ranks().begin()));
}

TEST_CASE("salient options out of range are refused") {
  const TriangleMesh mesh = octahedron().mesh();
  const ScalarField field(mesh, {1, -1, 0, 0.1, 0.2, 0.3});
  const auto refused = [&](const SalientOptions& chosen) {
    CHECK_THROWS_AS(morse::salient(field, chosen), core::InvalidArgument);
  };
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    refused(options(1, bad, "1std"));
    refused(options(1, 1, "1std", bad));
    SalientOptions chosen = options(1, 1, "1std");
    for (const auto kind : {ValueRange::Kind::deviations, ValueRange::Kind::fixed}) {
      chosen.range = {kind, bad};
      refused(chosen);
    }
  }
  refused(options(-1, 1, "1std"));
  refused(options(1, 1e308, "1std", 2));
  refused(options(1, 1e-310, "1std"));
  SalientOptions nothing = options(0, 1, "1std");
  nothing.return_saliency = true;
  refused(nothing);

  const std::vector<Point> one_place(6, Point(1, 2, 3));
  const ScalarField collapsed(mesh.with_positions(one_place), values_of(field));
  CHECK_THROWS_AS(morse::salient(collapsed), core::BadInput);
  CHECK_NOTHROW(morse::salient(collapsed, options(2, 1, "1std")));
}

TEST_CASE("ranges are read and written") {
  for (const char* text : {"1std", "0.5std", "local", "literal", "0.25"})
    CHECK(to_string(range(text)) == text);
  CHECK(range("2std") == ValueRange{ValueRange::Kind::deviations, 2});
  CHECK(range("3e-4") == ValueRange{ValueRange::Kind::fixed, 3e-4});
  for (const char* text :
       {"", "std", "0std", "-1std", "1 std", "Local", "nan", "inf", "nanstd", "0", "-2", "1%"})
    CHECK_THROWS_AS(range(text), core::InvalidArgument);
  CHECK_THROWS_WITH(range("wide"), Catch::Contains("\"wide\"") && Catch::Contains("local"));
}

TEST_CASE("salient smoothing reports its progress and can be cancelled") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 1));
  double last = 0;
  int calls = 0;
  const core::Progress watch([&](std::string_view step, double fraction) {
    CHECK(step == "salient smoothing");
    CHECK(fraction >= last);
    last = fraction;
    ++calls;
  });
  morse::salient(field, options(6, 0.2, "1std"), watch);
  CHECK(last == 1);
  CHECK(calls >= 7);
  std::stop_source stop;
  SalientOptions chosen = options(1000, 0.2, "1std");
  chosen.on_iteration = [&](const morse::SalientIteration& iteration) {
    CHECK(iteration.number <= 2);
    if (iteration.number == 2) stop.request_stop();
    return true;
  };
  CHECK_THROWS_AS(morse::salient(field, chosen, core::Progress({}, stop.get_token())), core::Cancelled);
}
