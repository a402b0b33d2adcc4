// Pictures: the colours of pixels.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/height.h"
#include "morsel/tools/color/surface_colors.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/glyphs.h"
#include "morsel/tools/render/picture.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/render/sheet.h"
#include "morsel/tools/render/tracer.h"

#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using namespace morsel::tools;
using namespace morsel::tools::render;

namespace {

using Rgba = std::array<int, 4>;
Rgba at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

bool near(const Rgba& a, const Color& color, int tolerance) {
  const auto b = to_bytes(color);
  for (int i = 0; i < 3; ++i)
    if (std::abs(a[i] - b[i]) > tolerance) return false;
  return true;
}

Image flat_picture(const Scene& scene, const char* view, Size size, bool transparent = false) {
  const Camera camera = fit_camera(scene.body.mesh.positions(), named_view(view),
                                   static_cast<double>(size.width) / size.height, 0.1);
  return Tracer(scene).trace(camera, {size, 16, transparent, false, {}});
}

/// A height field over the octahedron family, bent: a sphere with bumps.
core::ScalarField bumpy_field(int subdivisions) {
  Soup soup = sphere(subdivisions);
  for (Point& p : soup.positions)
    p *= 1 + 0.12 * std::sin(7 * p.x()) * std::cos(6 * p.y() + 1) + 0.05 * std::sin(11 * p.z());
  const TriangleMesh mesh = soup.mesh();
  return {mesh, smooth_values(mesh, 6, 5)};
}

Measurement measured(const core::ScalarField& field) {
  Timings timings;
  return measure(field, timings);
}

}  // namespace

TEST_CASE("a square is where it should be, in its colour") {
  Scene scene{make_body(square_pair().mesh())};
  scene.surface = from_hex(0x3366cc);
  const Point n = scene.body.normals[0];
  const char* view = std::abs(n.z()) > 0.5 ? "front" : std::abs(n.y()) > 0.5 ? "top" : "right";
  const Image image = flat_picture(scene, view, {40, 40});
  CHECK(at(image, 20, 20) == Rgba{0x33, 0x66, 0xcc, 255});
  CHECK(at(image, 6, 6) == Rgba{0x33, 0x66, 0xcc, 255});
  CHECK(at(image, 1, 1) == Rgba{255, 255, 255, 255});
  CHECK(at(image, 38, 20) == Rgba{255, 255, 255, 255});
  const Image clear = flat_picture(scene, view, {40, 40}, true);
  CHECK(at(clear, 1, 1)[3] == 0);
  CHECK(at(clear, 20, 20) == Rgba{0x33, 0x66, 0xcc, 255});
}

TEST_CASE("values are interpolated before they get their colour") {
  const TriangleMesh mesh = grid(2, 2).mesh();
  ValueColors colors{{}, Colormap("viridis")};
  const Body body = make_body(mesh);
  Point low = body.mesh.bounding_box().min, high = body.mesh.bounding_box().max;
  for (const Point& p : body.mesh.positions())
    colors.values.push_back(static_cast<float>((p.x() - low.x()) / (high.x() - low.x())));
  const Scene scene{body, colors};
  const Image image = flat_picture(scene, "front", {101, 101});
  for (const int x : {20, 35, 50, 65, 80}) {
    const double t = ((x + 0.5) / 101 * 2 - 1) / 0.8 / 2 + 0.5;  // the film's margin is a tenth
    CHECK(near(at(image, x, 30), Colormap("viridis")(t), 4));
  }
}

TEST_CASE("regions end at dual cells or at edges") {
  const Body body = make_body(grid(2, 2).mesh());
  RegionColors colors{std::vector<std::uint32_t>(6),
                      {from_hex(0xff0000), from_hex(0x00ff00), from_hex(0x0000ff), from_hex(0x808080)}};
  for (Index h = 0; h < 6; ++h) colors.corner[h] = body.mesh.origin(h);
  const Scene scene{body, colors};
  const Image image = flat_picture(scene, "front", {100, 100});
  for (Index v = 0; v < 4; ++v) {
    const Point p = body.mesh.position(v);
    const int x = p.x() < 0 ? 20 : 80, y = p.y() < 0 ? 80 : 20;
    CHECK(near(at(image, x, y), colors.palette[v], 0));
  }
}

TEST_CASE("spheres are seen in front of the surface and not behind it") {
  Scene scene{make_body(sphere(3).mesh())};
  const Image bare = flat_picture(scene, "front", {80, 80});
  scene.balls = {{Vec3(0, 0, -0.3f), 0.05f}};
  scene.ball_colors = {from_hex(0xff0000)};
  CHECK(flat_picture(scene, "front", {80, 80}).bytes == bare.bytes);
  const Image behind = flat_picture(scene, "back", {80, 80});
  CHECK(at(behind, 40, 40) == Rgba{255, 0, 0, 255});
  CHECK(at(behind, 40, 20) == at(bare, 40, 20));
}

TEST_CASE("tubes lie on the surface: none of those that face the viewer is hidden") {
  const core::ScalarField field = bumpy_field(4);
  const mscomplex::MorseSmaleComplex complex(field);
  REQUIRE(complex.saddle_count() > 3);
  for (const double freedom : {0., 0.001, 1.})
    for (const double radius : {0.0012, 0.0026}) {
      Scene scene{make_body(field.mesh())};
      add_arcs(scene, Rays(scene.body.mesh), complex, radius, freedom);
      REQUIRE(scene.capsules.size() >= complex.saddle_count());
      const Rays rays(scene.body.mesh, {}, scene.capsules);
      const Rays bare(scene.body.mesh);
      std::size_t hidden = 0;
      for (const Capsule& capsule : scene.capsules) {
        // Straight above each piece: the first thing on the way down must be a tube, and the surface right
        // below it.
        for (const float s : {0.f, 0.5f, 1.f}) {
          const Vec3 axis = (1 - s) * capsule.a + s * capsule.b;
          Hit on;
          Vec3 up = axis.normalized();  // the ball's way out
          const bool met = rays.first(axis + 0.2f * up, -up, 0, 1, on);
          REQUIRE(met);
          hidden += on.kind == Hit::Kind::capsule ? 0 : 1;
          Hit below;
          REQUIRE(bare.first(axis + 0.2f * up, -up, 0, 1, below));
          CHECK(std::abs(below.distance - 0.2f) < 2 * static_cast<float>(radius) + 0.004f);
        }
      }
      CAPTURE(freedom, radius, scene.capsules.size());
      CHECK(hidden == 0);
    }
}

TEST_CASE("arcs are not smoothed, and none is halved, at vertices of very large degree") {
  // Both poles of a bipyramid have as many triangles as it has sides, and all of its triangles are there.
  for (const int sides : {256, 257}) {
    const TriangleMesh mesh = bipyramid(sides).mesh();
    std::vector<double> values = random_values(mesh.vertex_count(), 5);
    values[0] = values[1] = 9;
    const mscomplex::MorseSmaleComplex complex({mesh, values});
    REQUIRE(complex.saddle_count() > 50);
    const auto capsules = [&](double freedom) {
      Scene scene{make_body(mesh)};
      add_arcs(scene, Rays(scene.body.mesh), complex, 0.0012, freedom);
      std::vector<std::array<float, 6>> ends;
      for (const Capsule& c : scene.capsules)
        ends.push_back({c.a[0], c.a[1], c.a[2], c.b[0], c.b[1], c.b[2]});
      return ends;
    };
    CHECK((capsules(1) == capsules(0)) == (sides > 256));
  }
}

TEST_CASE("arcs that merge are drawn once") {
  const core::ScalarField field = bumpy_field(3);
  const mscomplex::MorseSmaleComplex complex(field);
  Scene scene{make_body(field.mesh())};
  add_arcs(scene, Rays(scene.body.mesh), complex, 1, 0);  // so thick that nothing is halved
  CHECK(scene.capsules.size() <=
        field.mesh().vertex_count() + 2 * field.mesh().triangle_count() + 3 * complex.saddle_count());
  const auto less = [](const Capsule& a, const Capsule& b) {
    const auto key = [](const Capsule& c) {
      std::array<std::array<float, 3>, 2> ends = {{{c.a[0], c.a[1], c.a[2]}, {c.b[0], c.b[1], c.b[2]}}};
      std::sort(ends.begin(), ends.end());
      return ends;
    };
    return key(a) < key(b);
  };
  std::sort(scene.capsules.begin(), scene.capsules.end(), less);
  CHECK(std::adjacent_find(scene.capsules.begin(), scene.capsules.end(),
                           [&](const Capsule& a, const Capsule& b) { return !less(a, b) && !less(b, a); }) ==
        scene.capsules.end());
}

TEST_CASE("every mesh and field makes a picture, the same bytes with any number of threads") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    const core::ScalarField field(mesh, random_values(mesh.vertex_count(), 11));
    const Measurement measurement = measured(field);
    const Studio studio(mesh);
    for (const Show show : {Show::field, Show::morse_smale}) {
      CAPTURE(name, static_cast<int>(show));
      PictureRequest request;
      request.size = {64, 48};
      request.arcs = true;
      request.show = show;
      const Image image =
          studio.take(studio.view("30/20"), {field, &measurement, {"random", ""}, ""}, request);
      std::size_t covered = 0;
      for (std::size_t i = 0; i < image.bytes.size(); i += 4) covered += image.bytes[i] < 250 ? 1 : 0;
      CHECK(covered > 30);
    }
  }
  const core::ScalarField field = bumpy_field(4);
  const Measurement measurement = measured(field);
  PictureRequest request;
  request.size = {260, 200};
  request.samples = 8;
  request.arcs = true;
  request.inset = Inset{measurement.critical_points.points[0].vertex};
  std::string first;
  for (const int threads : {1, 2, 7}) {
    const core::ThreadLimit limit(threads);
    const Studio studio(field.mesh());
    const std::string png = encode_png(studio.take(
        studio.view("best"), {field, &measurement, {"x", "1/length"}, "caption\nsecond"}, request));
    if (first.empty()) first = png;
    CHECK(png == first);
  }
}

TEST_CASE("light is even on a plane and colours keep their hue") {
  Scene scene{make_body(grid(12, 12).mesh())};
  scene.surface = from_hex(0x4080c0);
  const Camera camera = fit_camera(scene.body.mesh.positions(), named_view("front"), 1, 0.1);
  const Image image = Tracer(scene).trace(camera, {{60, 60}, 16, false, true, {}});
  const Rgba middle = at(image, 30, 30);
  CHECK(middle[2] > middle[1]);
  CHECK(middle[1] > middle[0]);
  CHECK(middle[2] > 0xc0 * 0.8);
  for (int y = 12; y < 48; ++y)
    for (int x = 12; x < 48; ++x)
      for (int i = 0; i < 3; ++i) CHECK(std::abs(at(image, x, y)[i] - middle[i]) <= 2);  // no grain
}

TEST_CASE("what a picture cannot show is refused") {
  const core::ScalarField field = bumpy_field(2);
  const Measurement measurement = measured(field);
  const Studio studio(field.mesh());
  const View view = named_view("front");
  PictureRequest request;
  request.size = {40, 30};
  const Subject bare{field, nullptr, {}, ""};
  CHECK_THROWS_AS(studio.take(view, bare, request), core::InvalidArgument);
  request.points = false;
  CHECK_NOTHROW(studio.take(view, bare, request));
  request.show = Show::ascending;
  CHECK_THROWS_AS(studio.take(view, bare, request), core::InvalidArgument);
  request.show = Show::field;
  for (const int samples : {0, -1, 1025}) {
    request.samples = samples;
    CHECK_THROWS_AS(studio.take(view, bare, request), core::InvalidArgument);
  }
  request.samples = 1;
  for (const Size size : {Size{0, 10}, Size{10, -1}, Size{100000, 10}, Size{16384, 16384}}) {
    request.size = size;
    CHECK_THROWS_AS(studio.take(view, bare, request), core::InvalidArgument);
  }
  request.size = {40, 30};
  CHECK_THROWS_AS(studio.take(view, {field, nullptr, {}, "1\n2\n3\n4"}, request), core::InvalidArgument);
  CHECK_THROWS_AS(studio.take(view, {field, nullptr, {}, "\xff"}, request), core::InvalidArgument);
  const core::ScalarField other = bumpy_field(2);
  CHECK_THROWS_AS(studio.take(view, {other, nullptr, {}, ""}, request), core::InvalidArgument);
  CHECK_THROWS_AS(studio.view("below"), core::InvalidArgument);
  request.size = {200, 200};
  request.inset = Inset{0, core::Length::absolute(0)};
  CHECK_THROWS_AS(studio.take(view, bare, request), core::InvalidArgument);
}

TEST_CASE("an inset magnifies its vertex in the middle") {
  const core::ScalarField field = bumpy_field(4);
  const Measurement measurement = measured(field);
  const Studio studio(field.mesh());
  for (std::size_t i = 0; i < 2; ++i) {
    const morse::CriticalPoint& point = measurement.critical_points.points[i];
    const View view = view_from(field.mesh().position(point.vertex));
    PictureRequest request;
    request.size = {400, 300};
    request.samples = 4;
    request.legend = false;
    request.inset = Inset{point.vertex, core::Length::epsilons(12)};
    const Image image = studio.take(view, {field, &measurement, {}, ""}, request);
    // The largest patch of one of the three colours' hue is the magnified sphere: in a corner, 0.36 of the
    // height wide.
    const int side = 108, gap = static_cast<int>(0.8 * letter_size(request.size));
    bool found = false;
    const Color color = color_of(point.type);
    for (const int x : {gap, 400 - side - gap})
      for (const int y : {gap, 300 - side - gap}) {
        const Rgba p = at(image, x + side / 2, y + side / 2);
        Eigen::Index strongest = 0;
        color.maxCoeff(&strongest);
        bool is = true;
        for (int k = 0; k < 3; ++k) is = is && (k == strongest || p[strongest] > p[k] + 50);
        found = found || is;
      }
    CHECK(found);
  }
}

TEST_CASE("sheets and captions have room for everything") {
  Image red({30, 20}, false);
  for (std::size_t i = 0; i < red.bytes.size(); i += 4) red.bytes[i + 1] = red.bytes[i + 2] = 0;
  const Image captioned = with_caption(red, "one\ntwo");
  CHECK(captioned.size.width == 30);
  CHECK(captioned.size.height > 20 + 2 * 9);
  CHECK(at(captioned, 29, 19) == Rgba{255, 0, 0, 255});
  CHECK(at(captioned, 0, 21) == Rgba{255, 255, 255, 255});
  for (const std::size_t count : {1, 2, 3, 4, 5, 30}) {
    const Image sheet = make_sheet(std::vector<Panel>(count, {red, "x"}));
    const int columns = count == 4 ? 2 : static_cast<int>(std::min<std::size_t>(count, 3));
    CHECK(sheet.size.width / 30 == columns);
    CHECK(at(sheet, 1, 1) == Rgba{255, 0, 0, 255});
  }
  CHECK_THROWS_AS(make_sheet({}), core::InvalidArgument);
  CHECK(halved(red).size == Size{15, 10});
  CHECK(at(halved(red), 7, 5) == Rgba{255, 0, 0, 255});
  CHECK(counts_line(1, 0, 1234) == "1,235 critical points: 1 minimum, 0 saddles, 1,234 maxima");
}

TEST_CASE("ticks are round and few") {
  CHECK(ticks(0, 10) == std::vector<double>{0, 2, 4, 6, 8, 10});
  for (const auto& [low, high] :
       {std::pair(-31.2, 31.2), std::pair(0.001, 0.0013), std::pair(1e8, 3e8), std::pair(-1e-9, 2e-9)}) {
    const std::vector<double> at = ticks(low, high);
    CHECK(at.size() >= 3);
    CHECK(at.size() <= 9);
    CHECK(at.front() >= low - 1e-9 * (high - low));
    CHECK(at.back() <= high + 1e-9 * (high - low));
  }
  CHECK(tick_text(-20, 20) == "\u221220");
  CHECK(tick_text(0.5, 0.25) == "0.5");
  const auto quantity = [](const char* field, const char* method) {
    const tools::NamedFunction function = tools::Registry::standard().make_function(field);
    return quantity_of(function.name, function.unit,
                       tools::Registry::standard().make_method(method).quantity());
  };
  CHECK(quantity("mean-curvature", "conventional").words == "mean curvature");
  CHECK(quantity("mean-curvature", "conventional").unit == "1/length");
  CHECK(quantity("gaussian-curvature", "salient+tps").unit == "1/length²");
  CHECK(quantity("shape-index", "salient").unit.empty());
  CHECK(quantity("mean-curvature", "saliency").words == "saliency of mean curvature");
  CHECK(quantity("mean-curvature", "saliency").unit.empty());
}

TEST_CASE("what a picture shows is named as the segments are") {
  CHECK(to_string(Show::field) == "field");
  CHECK(to_string(Show::plain) == "plain");
  CHECK(to_string(Show::morse_smale) == "morse-smale");
  CHECK_FALSE(segments_of(Show::field));
  CHECK_FALSE(segments_of(Show::plain));
  CHECK(segments_of(Show::descending) == mscomplex::SegmentKind::descending);
  CHECK(segments_of(Show::ascending) == mscomplex::SegmentKind::ascending);
}

TEST_CASE("requests are read from text") {
  CHECK(parse_size("1200x900") == Size{1200, 900});
  for (const char* wrong :
       {"", "1200", "x", "0x10", "10x0", "100000x100000", "-3x4", "1.5x2", "10x10x10", "16384x16384"})
    CHECK_THROWS_AS(parse_size(wrong), core::InvalidArgument);
  CHECK(parse_inset("12").vertex == 12);
  CHECK(parse_inset("12:4eps").radius.value == 4);
  for (const char* wrong : {"", "a", "1:", "1:x", ":3"})
    CHECK_THROWS_AS(parse_inset(wrong), core::InvalidArgument);
}
