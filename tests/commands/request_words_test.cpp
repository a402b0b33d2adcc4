// The words that requests are made into (tools/render/request_words.h), against the tables of options: each
// option that shapes a result is among them, and they are read back as the same request.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <vector>

#include "morsel/tools/batch/request.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/parser.h"
#include "morsel/tools/commands/points_options.h"
#include "morsel/tools/render/request_words.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools {
namespace {

using Words = std::vector<std::string>;

std::string name_of(const Option& row) {
  const Words names = row.all_names();
  return *std::ranges::find_if(names, [](const std::string& name) { return name.starts_with("--"); });
}

bool has(const Words& words, const std::string& name) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return word == name || word.starts_with(name + "="); });
}

/// Whether an option is among the words, a preset by the field and the methods that it stands for.
bool says(const Words& words, const std::string& name) {
  return name == "--preset" ? has(words, "--field") && has(words, "--method") : has(words, name);
}

/// The names of a command's options that shape its results, but --format, which is part of MESH.
Words shaping_options(const std::string& command) {
  Program program;
  add_commands(program);
  Words names;
  for (const Option& row : std::ranges::find(program.commands, command, &Command::name)->options())
    if (!row.is_argument() && row.shapes_result && !row.is_called("--format")) names.push_back(name_of(row));
  return names;
}

/// A value that is not the default. An option without one here fails the tests until it is given one.
Words words_that_give(const Option& row) {
  static const std::map<std::string, Words> kValues = {
      {"--field", {"height:axis=z"}},
      {"--target", {"7"}},
      {"--view", {"-30/20"}},
      {"--up", {"x"}},
      {"--size", {"320x200"}},
      {"--inset", {"5:3eps"}},
      {"--data", {"somewhere"}},
      {"--meshes", {"elsewhere"}},
      {"--samples", {"5"}},
      {"--method", {"tps", "salient:iterations=2+tps"}},
      {"--preset", {"noise"}},
      {"--points", {"7"}},
      {"--kind", {"saddles"}},
      {"--rank", {"salience"}},
      {"--spacing", {"3%"}},
      {"--fill", {"height:axis=x"}},
      {"--salience-scale", {"5eps"}},
      {"--weld", {"0.5eps"}},
      {"--mask", {"property=inside"}},
  };
  const std::string name = name_of(row);
  if (row.is_flag()) return {name};
  INFO("a value for " << name);
  REQUIRE(kValues.contains(name));
  Words words;
  for (const std::string& value : kValues.at(name)) words.push_back(name + "=" + value);
  return words;
}

/// What `compare` and `batch` ask for, with the tables that they make it from.
struct Asked {
  batch::BatchRequest request;
  CommonOptions common;
  PointsOptions points;
  bool no_items = false;
  bool no_thumbnails = false;
  Command command{"compare", "compares"};

  explicit Asked(const Words& words) {
    add_comparison_options(command, request.comparison);
    command.flag("--no-items", no_items, "no items");
    command.flag("--no-thumbnails", no_thumbnails, "no thumbnails");
    command.flag("--html", request.pages, "pages");
    command.flag("--figures", request.figures, "figures");
    command.flag("--export", request.exports, "exports");
    add_figure_options(command, request.figure);
    add_points_options(command, points);
    add_common_options(command, common);
    parse(command, words);
    request.build = common.build;
    request.comparison.points = points.request();
    request.items = !no_items;
    request.thumbnails = !no_thumbnails;
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("each option of compare that shapes its results is among the words of its request", "[commands]") {
  const Words names = shaping_options("compare");
  REQUIRE(has(names, "--snap"));
  REQUIRE_FALSE(has(names, "--threads"));
  const Json plain = batch::common_key(Asked({"--figures"}).request);
  for (const std::string& name : names) {
    INFO(name);
    Asked table({});
    const Option& option = table.command.option(name);
    // No batch chooses points, so its key is the same.
    const bool is_of_points =
        name == "--points" || std::ranges::count(option.needed, std::string("--points")) > 0;
    Words given = words_that_give(option);
    if (is_of_points && name != "--points") given.emplace_back("--points=7");
    if (name == "--salience-scale") given.emplace_back("--rank=salience");
    const Asked asked(with({"--figures"}, given));
    const Words words = batch::request_words(asked.request);
    CHECK(says(words, name));
    const Asked again(with({"--figures"}, words));
    CHECK(batch::request_words(again.request) == words);
    CHECK(batch::common_key(again.request) == batch::common_key(asked.request));
    if (!is_of_points) CHECK(batch::common_key(asked.request) != plain);
  }
}

TEST_CASE("each option of batch about what is made is among the words of its request", "[commands]") {
  // How it is run: which meshes, within which limits.
  const Words of_the_run = {"--jobs",       "--time-limit", "--memory-limit", "--retry",       "--only",
                            "--no-summary", "--plan",       "--summary-only", "--with-timings"};
  std::size_t count = 0;
  for (const std::string& name : shaping_options("batch")) {
    if (std::ranges::count(of_the_run, name) > 0) continue;
    INFO(name);
    Asked table({});
    Words given = words_that_give(table.command.option(name));
    if (name != "--figures") given.emplace_back("--figures");
    const Asked asked(given);
    const Words words = batch::batch_words(asked.request);
    CHECK(says(words, name));
    const Asked again(words);
    CHECK(batch::batch_words(again.request) == words);
    CHECK(batch::common_key(again.request) == batch::common_key(asked.request));
    ++count;
  }
  CHECK(count >= 13);
}

TEST_CASE("each option of render that shapes a picture is among the words of its request", "[commands]") {
  FieldRequest field{"height", "tps", 7};
  render::PictureRequest picture;
  picture.show = render::Show::descending;
  picture.points = picture.legend = false;
  picture.transparent = true;
  picture.scale = {"sand", ScaleRequest::Center::zero, 3, {}};
  picture.inset = picture.frame = render::Inset{5, core::Length::epsilons(3)};
  picture.close_up = render::Inset{4, core::Length::percent(2)};
  render::CameraText camera;
  camera.view = "-30/20";
  camera.up = render::UpAxis::x;
  core::VertexNumbering shifted;
  shifted.to_input = {10, 11, 12, 13, 14, 15};
  const Words words =
      with(words_of(field, {true, core::Length::absolute(0), core::VertexValues{"", "inside"}}),
           render::words_of(picture, camera, "auto", shifted));
  // With a flag of the opposite meaning: whichever is not the default.
  const std::map<std::string, std::string> opposite = {
      {"--points", "--no-points"}, {"--arcs", "--no-arcs"}, {"--legend", "--no-legend"}};
  for (const std::string& name : shaping_options("render")) {
    INFO(name);
    CHECK(has(words, opposite.contains(name) ? opposite.at(name) : name));
  }
  const auto value_of = [&](const std::string& name) {
    const auto found = std::ranges::find(words, name);
    return found == words.end() ? std::string() : *(found + 1);
  };
  CHECK(has(words, "--view=-30/20"));
  CHECK(value_of("--frame") == "15:3eps");
  CHECK(value_of("--close-up") == "14:2%");
  CHECK(value_of("--range") == "3%");
  picture.scale.limits = {-0.5, 2};
  picture.arcs = true;
  picture.show = render::Show::field;
  const Words other = render::words_of(picture, camera, "", shifted);
  CHECK(has(other, "--range=-0.5/2"));
  CHECK(has(other, "--arcs"));
  CHECK_FALSE(has(other, "--show"));
  CHECK_FALSE(has(other, "--caption"));
}

TEST_CASE("each option of reproduce that shapes its results is among its words", "[commands]") {
  reproduce::Request request;
  request.data = "models";
  request.views = {"-30/20", "lion=left"};
  request.ups = {"x"};
  request.build = {true, core::Length::epsilons(0.5)};
  const Words words = reproduce::command_words(request);
  for (const std::string& name : shaping_options("reproduce")) {
    INFO(name);
    CHECK(has(words, name));
  }
  CHECK(has(words, "--view=-30/20"));
}

}  // namespace morsel::tools
