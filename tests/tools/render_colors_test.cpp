// Colours of pictures: maps, scales, segments.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "morsel/core/error.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/color/colormap.h"
#include "morsel/tools/color/regions.h"
#include "morsel/tools/color/value_scale.h"

#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using namespace morsel::tools;

namespace {

std::uint32_t hex_of(const Color& color) {
  const auto [r, g, b] = to_bytes(color);
  return std::uint32_t{r} << 16 | std::uint32_t{g} << 8 | b;
}

/// A colour as seen without one kind of cones (Machado, Oliveira, Fernandes 2009).
Color seen_without(bool red, const Color& c) {
  Eigen::Matrix3f m;
  if (red)
    m << 0.152286f, 1.052583f, -0.204868f, 0.114503f, 0.786281f, 0.099216f, -0.003882f, -0.048116f, 1.051998f;
  else
    m << 0.367322f, 0.860646f, -0.227968f, 0.280085f, 0.672501f, 0.047413f, -0.011820f, 0.042940f, 0.968881f;
  return (m * c).cwiseMax(0.f).cwiseMin(1.f);
}

float distance(const Color& a, const Color& b) { return (to_oklab(a) - to_oklab(b)).norm(); }

}  // namespace

TEST_CASE("colours come back from bytes and from OKLab") {
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::uint32_t hex = i << 16 | (255 - i) << 8 | (i * 7 % 256);
    CHECK(hex_of(from_hex(hex)) == hex);
    CHECK(hex_of(from_oklab(to_oklab(from_hex(hex)))) == hex);
  }
  CHECK(to_oklab(from_hex(0xffffff))[0] == Approx(1).margin(1e-4));
  CHECK(to_oklab(from_hex(0x777777)).tail<2>().norm() < 1e-4f);
}

TEST_CASE("the published colour maps have their ends") {
  CHECK(hex_of(Colormap("viridis")(0)) == 0x440154);
  CHECK(hex_of(Colormap("viridis")(1)) == 0xfde725);
  CHECK(hex_of(Colormap("viridis")(0.5)) == 0x21908c);
  CHECK(hex_of(Colormap("cividis")(0)) == 0x00224e);
  CHECK(hex_of(Colormap("cividis")(1)) == 0xfee838);
  CHECK(hex_of(Colormap("cividis")(7)) == 0xfee838);  // beyond the end
  CHECK_THROWS_WITH(Colormap("jet"),
                    "there is no colour map \"jet\"; there are: blue-orange, purple-green, "
                    "viridis, cividis, sand");
  CHECK_THROWS_WITH(Colormap("viridi"), Catch::Contains("\"viridi\"; did you mean viridis? There are: "));
}

TEST_CASE("lightness of colour maps runs one way, or both ways from the middle, in even steps") {
  for (const std::string_view name : colormap_names()) {
    CAPTURE(name);
    const Colormap map(name);
    std::vector<float> light;
    float longest = 0, shortest = 1;
    for (int i = 0; i <= 64; ++i) {
      light.push_back(to_oklab(map(i / 64.))[0]);
      if (i == 0) continue;
      const float step = distance(map(i / 64.), map((i - 1) / 64.));
      longest = std::max(longest, step);
      shortest = std::min(shortest, step);
    }
    CHECK(longest < (name == "viridis" || name == "cividis" ? 2.6f : 1.25f) * shortest);
    const float sign = light[32] > light[0] ? 1 : -1;
    for (int i = 1; i <= 64; ++i)
      CHECK((map.is_diverging() && i > 32 ? -sign : sign) * (light[i] - light[i - 1]) > 0);
    if (map.is_diverging()) {
      for (int i = 0; i < 32; ++i) CHECK(std::abs(light[i] - light[64 - i]) < 0.01f);
      CHECK(to_oklab(map(0.5)).tail<2>().norm() < 0.01f);  // neutral
    }
  }
}

TEST_CASE("the colour-blind can tell the two sides of diverging maps apart") {
  for (const std::string_view name : colormap_names()) {
    const Colormap map(name);
    if (!map.is_diverging()) continue;
    CAPTURE(name);
    for (const bool red : {true, false})
      for (const double t : {0., 0.1, 0.2})
        CHECK(distance(seen_without(red, map(t)), seen_without(red, map(1 - t))) > 0.12f);
  }
}

TEST_CASE("a scale suits the signs of the values") {
  std::vector<double> values;
  for (int i = -100; i <= 300; ++i) values.push_back(i);
  const ValueScale both = choose_scale(values);
  CHECK(both.map.name() == "blue-orange");
  CHECK(both.center == 0.);
  CHECK(both.low == -both.high);
  CHECK(both.high == 292);  // 2 % of 401 values are cut off: 8
  CHECK(both.position(0) == 0.5);
  CHECK(both.clipped_above);
  CHECK_FALSE(both.clipped_below);

  for (double& v : values) v += 95;  // hardly any are negative now
  const ValueScale median = choose_scale(values);
  CHECK(median.center == 195.);
  CHECK(median.position(195) == 0.5);

  for (double& v : values) v += 5;
  const ValueScale positive = choose_scale(values);
  CHECK_FALSE(positive.center);
  CHECK_FALSE(positive.map.is_diverging());
  CHECK(positive.low == 8);
  CHECK(positive.high == 392);

  ScaleRequest request;
  parse_range("-2/5", request);
  CHECK(choose_scale(values, request).low == -2);
  CHECK(choose_scale(values, request).high == 5);
  request = {};
  parse_range("0%", request);
  CHECK(choose_scale(values, request).low == 0);
  CHECK_FALSE(choose_scale(values, request).clipped_above);
  request.center = ScaleRequest::Center::zero;
  request.colormap = "purple-green";
  CHECK(choose_scale(values, request).low == -400);
  CHECK(choose_scale(values, request).map.name() == "purple-green");

  for (const char* wrong : {"1", "5/2", "1/1", "a/b", "50%", "-1%", "nan/2", "%"})
    CHECK_THROWS_AS(parse_range(wrong, request), core::InvalidArgument);
}

TEST_CASE("constant values have a scale") {
  for (const double value : {0., -3., 1e300}) {
    const ValueScale scale = choose_scale(std::vector<double>(5, value));
    CHECK(scale.low < scale.high);
    CHECK(scale.position(value) == Approx(0.5));
  }
}

TEST_CASE("graphs are coloured properly, also where more colours are needed than the palette has") {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::mt19937 random(7);
  for (const std::uint32_t nodes : {1u, 2u, 40u, 300u}) {
    std::vector<Edge> edges;
    if (nodes == 40) {  // all with all
      for (std::uint32_t i = 0; i < nodes; ++i)
        for (std::uint32_t j = 0; j < i; ++j) edges.emplace_back(i, j);
    } else {
      for (std::uint32_t k = 0; k < 4 * nodes; ++k) edges.emplace_back(random() % nodes, random() % nodes);
    }
    std::vector<Color> palette;
    const std::vector<std::uint32_t> color = color_graph(nodes, edges, palette);
    REQUIRE(color.size() == nodes);
    for (const auto& [a, b] : edges) {
      if (a == b) continue;
      CHECK(color[a] != color[b]);
      if (nodes != 40) CHECK(distance(palette[color[a]], palette[color[b]]) > 0.05f);
    }
  }
}

TEST_CASE("segments have one colour each and their neighbours others") {
  for (const auto& [name, mesh] : mesh_zoo())
    for (const auto& [kind, field] : field_zoo(mesh, 3)) {
      const mscomplex::DiscreteGradient gradient(field);
      const mscomplex::Segmentation segments = mscomplex::segment(field, gradient);
      for (const mscomplex::SegmentKind which : mscomplex::kSegmentKinds) {
        CAPTURE(name, kind, static_cast<int>(which));
        const RegionColors colors = color_segments(mesh, segments, which);
        REQUIRE(colors.corner.size() == mesh.halfedge_count());
        const auto label = [&, &mesh = mesh](Index h) {
          return std::pair(
              which == mscomplex::SegmentKind::descending ? 0 : segments.ascending.vertex[mesh.origin(h)],
              which == mscomplex::SegmentKind::ascending ? 0 : segments.descending.triangle[h / 3]);
        };
        std::map<std::pair<Index, Index>, std::uint32_t> of_label;
        bool one_each = true, others = true;
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
          one_each &= of_label.emplace(label(h), colors.corner[h]).first->second == colors.corner[h];
          std::vector<Index> beside = {TriangleMesh::next(h)};
          if (mesh.twin(h) != core::kNone) beside.push_back(TriangleMesh::next(mesh.twin(h)));
          for (const Index g : beside) others &= label(g) == label(h) || colors.corner[g] != colors.corner[h];
        }
        CHECK(one_each);
        CHECK(others);
      }
    }
}
