// The parts of a reproduction: finding meshes, regions, and close-ups. Pictures are compared by
// tests/cli/test_reproduce.py.
#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <random>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/tools/formats/base64.h"
#include "morsel/tools/render/inset.h"
#include "morsel/tools/reproduce/region.h"
#include "morsel/tools/reproduce/reproduction.h"
#include "morsel/tools/reproduce/table.h"
#include "morsel/tools/reproduce/torus.h"

#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using namespace morsel::tools;
using namespace morsel::tools::reproduce;
using morse::CriticalPoints;
using morse::CriticalType;

namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("morsel-reproduce-" + std::to_string(std::random_device()()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void add(const std::string& name) const { core::write_file(path / name, ""); }
};

void add_samples(const Folder& folder) {
  for (const ModelRecipe& model : models())
    if (model.make == nullptr) folder.add(std::string(model.sample));
}

CriticalPoints points_at(const std::vector<Index>& vertices) {
  CriticalPoints points;
  for (const Index v : vertices) points.points.push_back({v, CriticalType::saddle, 1});
  points.saddles = points.saddle_multiplicity = vertices.size();
  return points;
}

std::size_t within(const TriangleMesh& mesh, const CriticalPoints& points, Index center, double radius) {
  return static_cast<std::size_t>(std::ranges::count_if(points.points, [&](const morse::CriticalPoint& p) {
    return (mesh.position(p.vertex) - mesh.position(center)).norm() <= radius;
  }));
}

}  // namespace

TEST_CASE("base64 of RFC 4648's examples") {
  const std::vector<std::pair<std::string, std::string>> examples = {{"", ""},
                                                                     {"f", "Zg=="},
                                                                     {"fo", "Zm8="},
                                                                     {"foo", "Zm9v"},
                                                                     {"foob", "Zm9vYg=="},
                                                                     {"fooba", "Zm9vYmE="},
                                                                     {"foobar", "Zm9vYmFy"},
                                                                     {"\xff\xfe\xfd", "//79"}};
  for (const auto& [bytes, text] : examples) CHECK(base64(bytes) == text);
}

TEST_CASE("meshes are found by name, and by a word in it") {
  const Folder data, samples;
  add_samples(samples);
  for (const MeshFile& file : find_meshes({}, samples.path)) CHECK(file.is_sample != file.is_made);

  data.add("Old LION head.PLY");
  data.add("lion.txt");
  data.add("1BP2_surface.stl");
  std::vector<MeshFile> files = find_meshes(data.path, samples.path);
  CHECK(files[0].path.filename() == "Old LION head.PLY");
  CHECK(files[1].is_sample);
  CHECK(files[2].path.filename() == "1BP2_surface.stl");
  CHECK_FALSE(files[2].is_sample);

  data.add("lion2.off");  // two that may be it
  CHECK_THROWS_AS(find_meshes(data.path, samples.path), core::BadInput);
  data.add("lion.obj");  // one that is
  CHECK(find_meshes(data.path, samples.path)[0].path.filename() == "lion.obj");
  data.add("lion.off");  // and another
  CHECK_THROWS_AS(find_meshes(data.path, samples.path), core::BadInput);
}

TEST_CASE("all missing meshes are reported") {
  const Folder empty, samples;
  CHECK_THROWS_AS(find_meshes(empty.path, samples.path), core::BadInput);
  CHECK_THROWS_AS(find_meshes(empty.path / "gone", samples.path), core::BadInput);
  samples.add(std::string(models()[1].sample));
  try {
    find_meshes({}, samples.path);
    FAIL("two models have no mesh");
  } catch (const core::BadInput& error) {
    const std::string message = error.what();
    CHECK(message.find(models()[0].sample) != std::string::npos);
    CHECK(message.find(models()[1].sample) == std::string::npos);
    CHECK(message.find(models()[2].sample) != std::string::npos);
  }
}

TEST_CASE("every recipe can be read") {
  std::set<std::string> files;
  for (const FigureRecipe& figure : figures()) {
    CHECK(files.insert(figure.file_stem()).second);
    CHECK((figure.number > 0) == figure.section.empty());
    CHECK_NOTHROW(Registry::standard().make_function(figure.field));
    REQUIRE(figure.model < models().size());
    REQUIRE(figure.finding != nullptr);
    CHECK((!figure.panels.empty() && figure.panels.size() <= 26));
    if (figure.compared)
      for (const std::size_t panel : *figure.compared) CHECK(panel < figure.panels.size());
    for (const PanelRecipe& panel : figure.panels) {
      std::string method(panel.method);
      if (const std::size_t at = method.find('{'); at != std::string::npos) {
        const auto other = static_cast<std::size_t>(method.at(at + 1) - 'a');
        REQUIRE(other < figure.panels.size());
        CHECK(figure.panels[other].method.find('{') == std::string_view::npos);  // or it could go round
        method.replace(at, 3, "100");
      }
      CHECK_NOTHROW(Registry::standard().make_method(method));
      CHECK((panel.region == Region::none || figure.compared));
    }
  }
  for (const TableRow& row : table_rows()) {
    REQUIRE(row.model < models().size());
    for (const TableSetting& setting : table_settings())
      CHECK_NOTHROW(Registry::standard().make_method(method_of(row, setting)));
  }
}

TEST_CASE("views and axes are for all models or for one") {
  const Folder samples;
  add_samples(samples);
  Request request;
  request.samples = samples.path;
  request.views = {"front", "squirrel=10/20"};
  request.ups = {"protein=z"};
  const Prepared prepared = prepare(request);
  CHECK(prepared.pictures[0].camera.view == "front");
  CHECK(prepared.pictures[1].camera.view == "10/20");
  CHECK(prepared.pictures[2].camera.up == render::UpAxis::z);
  CHECK(prepared.pictures[0].camera.up == render::UpAxis::y);
  for (const char* wrong : {"below", "tiger=front", "lion=", "=front"}) {
    request.views = {wrong};
    CHECK_THROWS_AS(prepare(request), core::InvalidArgument);
  }
  request.views.clear();
  request.ups = {"lion=up"};
  CHECK_THROWS_AS(prepare(request), core::InvalidArgument);
}

TEST_CASE("the region of a comparison is the fullest one, whichever method keeps more there") {
  const TriangleMesh mesh = sphere(3).mesh();
  const std::size_t n = mesh.vertex_count();
  const core::Length radius = core::Length::absolute(0.4);
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    std::vector<Index> vertices(n);
    for (Index v = 0; v < n; ++v) vertices[v] = v;
    std::ranges::shuffle(vertices, random);
    const CriticalPoints all = points_at({vertices.begin(), vertices.begin() + 70});
    const CriticalPoints first = points_at({vertices.begin(), vertices.begin() + 40});
    const CriticalPoints second = points_at({vertices.begin() + 30, vertices.begin() + 60});
    std::vector<bool> places(n);
    for (std::size_t v = 0; v < n; ++v) places[v] = random() % 3 == 0;
    const ComparedRegion best = fullest_region(mesh, all, first, second, places, radius);
    REQUIRE(best.vertex != core::kNone);
    CHECK(places[best.vertex]);
    CHECK(best.all == within(mesh, all, best.vertex, 0.4));
    CHECK(best.first == within(mesh, first, best.vertex, 0.4));
    CHECK(best.second == within(mesh, second, best.vertex, 0.4));
    std::size_t count = 0;
    std::size_t more_of_first = 0;
    std::size_t more_of_second = 0;
    for (Index v = 0; v < n; ++v) {
      if (!places[v]) continue;
      CHECK(within(mesh, all, v, 0.4) <= best.all);
      const std::size_t a = within(mesh, first, v, 0.4);
      const std::size_t b = within(mesh, second, v, 0.4);
      ++count;
      more_of_first += a > b ? 1 : 0;
      more_of_second += b > a ? 1 : 0;
    }
    CHECK(best.places == count);
    CHECK(best.more_of_first == more_of_first);
    CHECK(best.more_of_second == more_of_second);
    // Neither is favoured: with the two exchanged it is the same place.
    const ComparedRegion turned = fullest_region(mesh, all, second, first, places, radius);
    CHECK(turned.vertex == best.vertex);
    CHECK(turned.first == best.second);
    CHECK(turned.more_of_first == best.more_of_second);
  }
  const std::vector<bool> none(n);
  CHECK(fullest_region(mesh, {}, {}, {}, none, radius).vertex == core::kNone);
}

TEST_CASE("the torus of section 3.1 stands, and its height has four critical points") {
  const TriangleMesh mesh = standing_torus();
  CHECK(mesh.genus() == 1);
  CHECK(mesh.is_closed());
  std::vector<double> height;
  for (const Point& p : mesh.positions()) height.push_back(p.z());
  const core::ScalarField field(mesh, height);
  const CriticalPoints points = morse::classify(field);
  CHECK((points.minima == 1 && points.saddles == 2 && points.maxima == 1));
  CHECK(mesh.position(field.order().back()).z() == Approx(1.4));
  CHECK(mesh.position(field.order().front()).z() == Approx(-1.4));
  const core::ScalarField curvature = morse::mean_curvature(mesh);
  CHECK(curvature.value(field.order().back()) == Approx(0.5 * (1 / 0.4 + 1 / 1.4)).epsilon(0.02));
}

TEST_CASE("controls begin with the paper's method and hold the others to its count") {
  REQUIRE(!controls().empty());
  CHECK(controls().front().method.find("{k}") == std::string_view::npos);
  CHECK_FALSE(controls().front().rank);
  for (const ControlRecipe& control : controls()) {
    std::string method(control.method);
    for (const char* word : {"{n}", "{k}"})
      if (const std::size_t at = method.find(word); at != std::string::npos) method.replace(at, 3, "10");
    CHECK_NOTHROW(Registry::standard().make_method(method));
  }
}

TEST_CASE("a view shows what faces it and what nothing hides") {
  const render::Studio studio(sphere(3).mesh());
  const render::View view = render::named_view("front");
  const TriangleMesh mesh = sphere(3).mesh();
  const Point camera = render::fit_camera(mesh.positions(), view, 1).eye;
  const std::vector<bool> half = studio.shown(view, 0.1);
  const std::vector<bool> middle = studio.shown(view, 0.8);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Point& p = mesh.position(v);
    const double cosine = p.normalized().dot((camera - p).normalized());
    if (cosine > 0.15) CHECK(half[v]);
    if (cosine < 0.05) CHECK_FALSE(half[v]);
    if (cosine < 0.75) CHECK_FALSE(middle[v]);
    if (cosine > 0.85) CHECK(middle[v]);
  }
  // A small sphere in front of a large one hides a part of it.
  Soup both = together(sphere(3), sphere(2));  // side by side
  const std::vector<Point> near = sphere(2).positions;
  for (std::size_t i = 0; i < near.size(); ++i)
    both.positions[mesh.vertex_count() + i] = 0.3 * near[i] + Point(0, 0, 3);
  const TriangleMesh two = both.mesh();
  const std::vector<bool> shown = render::Studio(two).shown(view, 0.1);
  const Point eye = render::fit_camera(two.positions(), view, 1).eye;
  int hidden = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Point& p = mesh.position(v);
    const Point way = (eye - p).normalized();
    const double past = (Point(0, 0, 3) - p).cross(way).norm();  // of the way to the small sphere's centre
    if (p.normalized().dot(way) < 0.15) continue;
    if (past < 0.27) CHECK_FALSE(shown[v]);
    if (past > 0.31) CHECK(shown[v]);
    hidden += past < 0.27 ? 1 : 0;
  }
  CHECK(hidden > 3);
}

TEST_CASE("a close-up's window extends to its radius") {
  const TriangleMesh mesh = sphere(3).mesh();
  for (const double aspect : {1., 1.5, 0.6}) {
    const render::Camera camera = render::fit_camera(mesh.positions(), render::named_view("30/10"), aspect);
    const Point center = camera.back;  // nearest to the camera
    const render::FilmWindow window = render::window_around(camera, center, 0.1);
    CHECK(window.x1 - window.x0 == Approx(window.y1 - window.y0));  // the film's own shape
    // The point at the radius along the picture's shorter side lies on the window's edge.
    const Point rim = center + 0.1 * (aspect >= 1 ? camera.up : camera.right);
    const Eigen::Vector2d at = camera.project(rim);
    CHECK((aspect >= 1 ? at[1] - window.y1 : at[0] - window.x1) == Approx(0).margin(1e-12));
    for (const double wrong : {0., -1., 1.5}) CHECK_THROWS(render::window_around(camera, center, wrong));
  }
}

TEST_CASE("a close-up holds no further region") {
  const TriangleMesh mesh = sphere(2).mesh();
  const core::ScalarField field(mesh, smooth_values(mesh, 3, 1));
  const render::Studio studio(mesh);
  render::PictureRequest request;
  request.size = {60, 50};
  request.samples = 1;
  request.points = false;
  request.close_up = render::Inset{3};
  const auto take = [&] {
    return studio.take(render::named_view("front"), {field, nullptr, {}, ""}, request);
  };
  const render::Image near = take();
  request.frame = render::Inset{3};
  CHECK_THROWS_AS(take(), core::InvalidArgument);
  request.close_up.reset();
  CHECK(take().bytes != near.bytes);
}
