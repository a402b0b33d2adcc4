#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <thread>

#include "morsel/core/error.h"
#include "morsel/tools/batch/collection.h"
#include "morsel/tools/batch/distributions.h"
#include "morsel/tools/batch/page.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/batch/scheduler.h"
#include "morsel/tools/batch/state.h"
#include "morsel/tools/batch/summary.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/markup.h"
#include "morsel/tools/results/result_folder.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::tools;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> names(const std::vector<batch::CollectionMesh>& meshes) {
  std::vector<std::string> list;
  for (const auto& mesh : meshes) list.push_back(mesh.name);
  return list;
}

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "sh", "-c", script}; }

/// How each script ends.
std::vector<batch::ChildEnd> ends(const std::vector<std::string>& scripts, std::size_t jobs,
                                  const batch::ChildLimits& limits = {}) {
  std::vector<batch::ChildEnd> list(scripts.size());
  batch::run_children({scripts.size(), [&](std::size_t i) { return shell(scripts[i]); },
                       [&](std::size_t i, const batch::ChildEnd& end) { list[i] = end; }},
                      jobs, limits);
  return list;
}

}  // namespace

TEST_CASE("meshes are named by their paths within the collection", "[batch]") {
  CHECK(batch::mesh_name("a.off") == "a.off");
  CHECK(batch::mesh_name("./sub/../other//b.ply") == "other/b.ply");
  CHECK(batch::mesh_name("../up/c.off") == "up/c.off");
  CHECK(batch::mesh_name("/data/d.off") == "data/d.off");
  CHECK(batch::mesh_name("..").empty());
  CHECK(batch::mesh_name("folder/").empty());
}

TEST_CASE("a folder's meshes are found in all folders of it, by name", "[batch]") {
  const test::Scratch folder;
  for (const char* name : {"b.off", "a/z.STL", "a/y.obj", "c.ply", "note.txt", "a.off.json"})
    folder.file(name);
  const auto meshes = batch::read_collection(folder.path());
  CHECK(names(meshes) == std::vector<std::string>{"a/y.obj", "a/z.STL", "b.off", "c.ply"});
  CHECK(meshes[0].path == folder.path() / "a/y.obj");
}

TEST_CASE("a mesh named as a folder of another one is found among many, however deep", "[batch]") {
  const test::Scratch folder;
  std::string deep = "m.off";
  for (int i = 0; i < 100'000; ++i) deep = "a/" + deep;  // each of these folders might be a mesh's name
  std::string lines = deep + "\nx/y.off!z/b.off\nx/y.off-b.off\n";
  for (int i = 0; i < 1000; ++i) lines += "x/" + std::to_string(i) + ".off\n";
  CHECK(batch::read_collection(folder.file("apart", lines + "x/y.off\n")).size() == 1004);
  CHECK_THROWS_WITH(
      batch::read_collection(folder.file("within", lines + "x/y.off/c.off\nx/y.off\n")),
      Catch::Contains(
          "has a mesh that would be called x/y.off and one in a folder of that name, x/y.off/c.off"));
}

TEST_CASE("chosen meshes are those that the whole collection has by these names", "[batch]") {
  const test::Scratch folder;
  for (const char* name : {"all/b.off", "all/a/y.obj", "all/c.ply", "all/note.txt", "elsewhere/d.off"})
    folder.file(name);
  fs::create_directory_symlink(folder.path() / "elsewhere", folder.path() / "all/link");
  fs::create_symlink(folder.path() / "elsewhere/d.off", folder.path() / "all/d.off");
  const fs::path list =
      folder.file("all/list", "c.ply\n#b.off\nb.off\r\na/y.obj\n./d.off\n../elsewhere/./d.off\n");
  for (const fs::path& collection : {folder.path() / "all", list}) {
    const auto all = batch::read_collection(collection);
    for (const auto& mesh : all) CHECK(batch::read_collection(collection, {mesh.name}) == std::vector{mesh});
    CHECK(batch::read_collection(collection, {"c.ply", "d.off", "b.off", "a/y.obj", "c.ply"}) ==
          std::vector(all.begin(), all.begin() + 4));
    for (const char* absent : {"z.off", "link/d.off", "note.txt", "./b.off", "a", "y.obj", ""})
      CHECK_THROWS_AS(batch::read_collection(collection, {"b.off", absent}), core::InvalidArgument);
  }
  const fs::path twice = folder.file("twice", "a.off\nb.off\n../b.off\n");
  CHECK(names(batch::read_collection(twice, {"a.off"})) == std::vector<std::string>{"a.off"});
  CHECK_THROWS_AS(batch::read_collection(twice, {"b.off"}), core::BadInput);
}

TEST_CASE("a list's meshes are those of its lines", "[batch]") {
  const test::Scratch folder;
  const auto meshes =
      batch::read_collection(folder.file("list", "#comment\r\nb.off\r\n\n../x/a b.off\n/abs/c.off"));
  CHECK(names(meshes) == std::vector<std::string>{"b.off", "x/a b.off", "abs/c.off"});
  CHECK(meshes[0].path == folder.path() / "b.off");
  CHECK(meshes[2].path == "/abs/c.off");
  CHECK_THROWS_AS(batch::read_collection(folder.file("twice", "a.off\n../a.off\n")), core::BadInput);
  CHECK_THROWS_AS(batch::read_collection(folder.file("within", "a.off\n/a.off/b.off\n")), core::BadInput);
  CHECK_THROWS_AS(batch::read_collection(folder.file("up", "a.off\n..\n")), core::BadInput);
  CHECK_THROWS_AS(batch::read_collection(folder.file("empty")), core::BadInput);
  CHECK_THROWS_AS(batch::read_collection(folder.file("mesh.off", "OFF")), core::BadInput);
  CHECK_THROWS_AS(batch::read_collection(folder.path() / "absent"), core::BadInput);
}

TEST_CASE("exit codes and signals of children are reported", "[batch]") {
  const auto list = ends(
      {"exit 0", "echo out; printf 'morsel: bad\\nworse\\n' >&2; exit 3", "kill -SEGV $$", "kill -9 $$"}, 2);
  CHECK(list[0].exit_code == 0);
  CHECK(list[1].exit_code == 3);
  CHECK(list[1].message == "bad; worse");
  CHECK(list[2].signal == SIGSEGV);
  CHECK(list[3].signal == SIGKILL);
  CHECK_FALSE(list[3].timed_out);
  CHECK(batch::error_of(list[0], {}) == std::nullopt);
  CHECK(batch::error_of(list[1], {})->message == "bad; worse");
  CHECK_FALSE(batch::error_of(list[1], {})->may_pass());
  batch::ChildEnd odd = list[1];
  odd.message = "caf\xe9";
  CHECK(batch::error_of(odd, {})->message == "caf\xef\xbf\xbd");  // what its state has
  CHECK(batch::error_of(list[2], {})->kind == "signal");
  CHECK_FALSE(batch::error_of(list[2], {})->may_pass());
  CHECK(batch::error_of(list[3], {})->may_pass());
}

TEST_CASE("the end of a long error is kept", "[batch]") {
  const auto list = ends({"i=0; while [ $i -lt 3000 ]; do echo line $i >&2; i=$((i+1)); done; exit 1"}, 1);
  CHECK(list[0].message.ends_with("line 2998; line 2999"));
  CHECK(list[0].message.size() < 3000);
}

TEST_CASE("a missing program is reported as an end of the child", "[batch]") {
  batch::ChildEnd end;
  batch::run_children({1,
                       [](std::size_t) {
                         return std::vector<std::string>{"/nowhere/x", "x"};
                       },
                       [&](std::size_t, const batch::ChildEnd& e) { end = e; }},
                      1, {});
  CHECK(end.exit_code == 127);
  CHECK(end.message == "the program cannot be run");
}

TEST_CASE("the time limit ends a child with all that it started", "[batch]") {
  const test::Scratch folder;
  const std::string late = (folder.path() / "late").string();
  const batch::Child::Clock::time_point begin = batch::Child::Clock::now();
  const auto list = ends({"(sleep 2; echo late > " + late + ") & sleep 30"}, 1, {0.2, 0});
  CHECK(list[0].timed_out);
  CHECK(batch::error_of(list[0], {0.2, 0})->kind == "time-limit");
  CHECK(batch::error_of(list[0], {0.2, 0})->message == "longer than the time limit of 0.2 s");
  CHECK(std::chrono::duration<double>(batch::Child::Clock::now() - begin).count() < 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(2200));
  CHECK_FALSE(fs::exists(late));
  CHECK(ends({"exit 0"}, 1, {60, 0})[0].exit_code == 0);
}

TEST_CASE("the memory limit is the child's", "[batch]") {
  CHECK(ends({"test $(ulimit -d) = 102400"}, 1, {0, 100})[0].exit_code == 0);
  CHECK(ends({"test $(ulimit -d) != 102400"}, 1)[0].exit_code == 0);
  batch::ChildEnd end;
  end.exit_code = 5;
  for (const char* message :
       {"out of memory", "pthread_create has failed: Resource temporarily unavailable"}) {
    end.message = message;
    CHECK(batch::error_of(end, {0, 100})->kind == "memory-limit");
    CHECK_FALSE(batch::error_of(end, {0, 100})->may_pass());
    CHECK(batch::error_of(end, {})->may_pass());
  }
  end.message = "cannot read a.off: Too many open files";
  CHECK(batch::error_of(end, {0, 100})->kind == "exit-code");
  CHECK(batch::error_of(end, {0, 100})->may_pass());
  end.exit_code = 3;
  end.message = "cannot read a.off: Input/output error";
  CHECK(batch::error_of(end, {})->may_pass());
  end.message = "cannot read a.off: it is empty";
  CHECK_FALSE(batch::error_of(end, {})->may_pass());
  batch::ChildEnd aborted;
  aborted.signal = SIGABRT;
  CHECK(batch::error_of(aborted, {0, 100})->kind == "signal");
}

TEST_CASE("no more children run than there are jobs, and all of them do", "[batch]") {
  const test::Scratch folder;
  std::size_t now = 0;
  std::size_t most = 0;
  std::set<std::size_t> ended;
  batch::run_children({20,
                       [&](std::size_t) {
                         most = std::max(most, ++now);
                         return shell("sleep 0.02");
                       },
                       [&](std::size_t i, const batch::ChildEnd&) {
                         --now;
                         ended.insert(i);
                       }},
                      3, {});
  CHECK(most == 3);
  CHECK(ended.size() == 20);
}

TEST_CASE("a stop ends the children at once", "[batch]") {
  std::stop_source stop;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  const auto begin = batch::Child::Clock::now();
  CHECK_THROWS_AS(
      batch::run_children({2, [](std::size_t) { return shell("sleep 30"); },
                           [](std::size_t, const batch::ChildEnd&) { FAIL("it did not end by itself"); }},
                          2, {}, stop.get_token()),
      core::Cancelled);
  later.join();
  CHECK(std::chrono::duration<double>(batch::Child::Clock::now() - begin).count() < 10);
}

namespace {

Json result_of_a_mesh() {
  return Json::parse(R"({
    "mesh": {"path": "a.off", "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef",
      "vertices": 6, "edges": 12, "faces": 8, "components": 1,
       "boundary_loops": 0, "euler_characteristic": 2, "genus": 0,
      "bbox_diagonal": 3.5, "repairs": [{"action": "drop", "count": 1}]},
    "field": {"name": "height", "parameters": {"axis": "z"}, "min": -1.0, "max": 1.0},
    "methods": [{"name": "conventional", "parameters": {}, "field": {"min": -1.0, "max": 1.0},
      "critical_points": {"minima": 1, "saddles": 0, "saddle_multiplicity": 0, "maxima": 1, "total": 2},
      "ms_complex": {"minima": 1, "saddles": 0, "maxima": 1, "caps": 0, "arcs": 0, "quads": 0,
        "segments": {"descending": 1, "ascending": 1, "morse_smale": 1}},
      "compared_to_first": {"kept": 2, "moved": 0, "added": 0, "removed": 0},
      "persistence": {"pairs": 0, "infinite_pairs": 0, "essential_saddles": 0, "max": null,
        "above": [{"percent": 0.1, "pairs": 0}, {"percent": 1.0, "pairs": 0},
                  {"percent": 5.0, "pairs": 0}]}}]})");
}

/// Calls `visit` with each value within a document, and what sets it.
void for_each_value(Json& document,
                    const std::function<void(Json& value, const std::string& key, Json& parent)>& visit) {
  if (document.is_array())
    for (std::size_t i = 0; i < document.size(); ++i) {
      for_each_value(document[i], visit);
      visit(document[i], "", document);
    }
  if (!document.is_object()) return;
  std::vector<std::string> keys;
  for (const auto& [key, value] : document.items()) keys.push_back(key);
  for (const std::string& key : keys) {
    for_each_value(document[key], visit);
    visit(document[key], key, document);
  }
}

}  // namespace

TEST_CASE("a state is read back as it was written; another version's is ignored", "[batch]") {
  const test::Scratch folder;
  const batch::OutFolder out(folder.path());
  const Json key = {{"request", {{"methods", {"conventional"}}}}, {"sha256", "ab"}};
  batch::BatchRequest request;
  request.figures = true;
  const auto products = batch::products_of("sub/a.off", request, out);
  batch::MeshState state;
  state.key = key;
  state.seconds = 1.5;
  state.result = result_of_a_mesh();
  state.timings = {{"load", 0.5}, {"methods", {{{"name", "conventional"}, {"method", 0.25}}}}};
  state.files = {"figures/sheet.png", "report.json", "thumbnail.first.png", "thumbnail.last.png"};
  fs::create_directories(folder.path() / "state/sub");
  batch::write_state(out.state("sub/a.off"), state);
  auto read = batch::read_state(folder.path() / "state/sub/a.off.json");
  REQUIRE(read);
  CHECK(read->key == key);
  CHECK(read->result == state.result);
  CHECK(read->seconds == 1.5);
  CHECK_FALSE(read->error);

  CHECK(read->files == state.files);

  // done is what has its files
  for (const char* file : {"reports/sub/a.off.json", "thumbnails/sub/a.off.first.png",
                           "thumbnails/sub/a.off.last.png", "figures/sub/a.off/sheet.png"}) {
    CHECK_FALSE(batch::is_settled(*read, key, {}, products));
    folder.file(file);
  }
  CHECK(batch::is_settled(*read, key, {}, products));
  CHECK(batch::is_settled(*read, key, {1, 1}, products));
  for (std::size_t i = 0; i < state.files.size(); ++i) {
    batch::MeshState less = *read;
    less.files.erase(less.files.begin() + static_cast<std::ptrdiff_t>(i));
    CHECK_FALSE(batch::is_settled(less, key, {}, products));
  }
  Json other = key;
  other["sha256"] = "cd";
  CHECK_FALSE(batch::is_settled(*read, other, {}, products));

  // failed is what failed within the same limits
  state.error = batch::MeshError{"time-limit", -1, 9, "late"};
  state.limits = {2.5, 0};
  batch::write_state(out.state("sub/a.off"), state);
  read = batch::read_state(out.state("sub/a.off"));
  REQUIRE(read);
  REQUIRE(read->error);
  CHECK(batch::to_json(*read->error) == batch::to_json(*state.error));
  CHECK(read->limits == state.limits);
  CHECK(batch::is_settled(*read, key, {2.5, 0}, products));
  CHECK_FALSE(batch::is_settled(*read, key, {3, 0}, products));

  CHECK_FALSE(batch::read_state(folder.path() / "absent"));
  CHECK_THROWS_AS(batch::read_state(folder.file("damaged", "{\"schema\": \"morsel.batch-state/1\"")),
                  core::BadInput);
  CHECK_FALSE(batch::read_state(folder.file("other", "{\"schema\": \"other\"}")));
}

TEST_CASE("bug: a state whose result lacked a member was an internal error, for good", "[batch]") {
  Json state = {{"schema", "morsel.batch-state/1"},
                {"key", {{"request", {{"methods", {"conventional"}}}}}},
                {"status", "done"},
                {"files", {"report.json"}},
                {"result", result_of_a_mesh()},
                {"timings", {{"methods", {{{"name", "conventional"}, {"method", 0.25}}}}}},
                {"seconds", 1.5}};
  REQUIRE(batch::parse_state(state.dump(), "s"));
  std::size_t refused = 0;
  const auto tried = [&] {
    try {
      static_cast<void>(batch::parse_state(state.dump(), "s"));
    } catch (const core::BadInput& error) {
      ++refused;
      CHECK(std::string(error.what()).find("json.exception") == std::string::npos);
    }
  };
  std::size_t without = 0;
  for_each_value(state["result"], [&](Json& value, const std::string& key, Json& parent) {
    const Json whole = parent;
    for (const Json& other : {Json(), Json(5), Json("x"), Json::array(), Json::object()}) {
      value = other;
      tried();
    }
    parent = whole;
    if (key.empty()) return;
    const std::size_t before = refused;
    parent.erase(key);
    tried();
    without += refused - before;
    parent = whole;
  });
  CHECK(without == 59);  // all members but "axis", which another field does not have
  CHECK(refused > 200);
  REQUIRE(batch::parse_state(state.dump(), "s"));
  for (const char* file : {"", "/etc/passwd", "../x", "figures/../../x", "figures/", "."}) {
    state["files"] = {"report.json", file};
    CHECK_THROWS_WITH(batch::parse_state(state.dump(), "s"),
                      Catch::Contains("files[1] is not a file of the mesh's own"));
  }
  CHECK_THROWS_WITH(batch::parse_state(std::string(105'000, '['), "s"), Catch::Contains("nested deeper"));
}

TEST_CASE("the key has everything that determines a report", "[batch]") {
  const test::Scratch folder;
  const std::string values = folder.file("values", "1\n").string();
  batch::BatchRequest request;
  request.comparison.field = "vertex-scalar:file=" + core::escape(values);
  const Json key = batch::common_key(request);
  REQUIRE(key["files"].size() == 1);
  CHECK(key["files"][0]["path"] == values);
  CHECK(batch::mesh_key(key, folder.path() / "absent")["sha256"].is_null());
  std::vector<batch::BatchRequest> changed(13, request);
  changed[0].comparison.field = "height";
  changed[1].comparison.methods.pop_back();
  changed[2].comparison.target = 10;
  changed[3].comparison.snap = true;
  changed[4].build.repair = true;
  changed[5].items = false;
  changed[6].thumbnails = false;
  changed[7].pages = true;
  changed[8].figures = true;
  changed[9].exports = true;
  changed[10].figure.camera.view = "left";
  changed[11].figure.camera.up = render::UpAxis::z;
  changed[12].build.weld = core::Length::absolute(0);
  for (const batch::BatchRequest& other : changed) CHECK(batch::common_key(other) != key);
  batch::BatchRequest unseen = request;  // by thumbnails
  unseen.figure.size = "10x10";
  unseen.figure.camera.inset = "3";
  CHECK(batch::common_key(unseen) == key);
  unseen.figures = true;
  CHECK(batch::common_key(unseen) != batch::common_key(changed[8]));
  folder.file("values", "2\n");
  CHECK(batch::common_key(request) != key);
}

TEST_CASE("each product of a mesh has its place", "[batch]") {
  const test::Scratch folder;
  const batch::OutFolder out("o");
  batch::BatchRequest request;
  request.thumbnails = false;
  request.figures = true;
  const auto products = batch::products_of("a/b.off", request, out);
  for (const char* file : {"report.json", "figures/two.png", "figures/one.png", "page.html"})
    folder.file(file);
  CHECK(batch::made_files(products, folder.path()) ==
        std::vector<std::string>{"figures/one.png", "figures/two.png", "report.json"});
  CHECK(batch::place_of("figures/one.png", products) == "o/figures/a/b.off/one.png");
  CHECK(batch::place_of("page.html", products) == "o/pages/a/b.off.html");
  CHECK(batch::place_of("other", products).empty());
}

TEST_CASE("a mesh whose results would have too long a name is refused by itself", "[batch]") {
  const test::Scratch folder;
  const batch::OutFolder out(folder / "not there yet");
  const std::string longest(245, 'a');  // and ".first.png"
  CHECK(out.refusal(longest).empty());
  CHECK(out.refusal(longest + "a").find("246 bytes") != std::string::npos);
  const auto in_folder = [](std::size_t letters) { return std::string(letters, 'a').append("/b.off"); };
  CHECK(out.refusal(in_folder(255)).empty());
  CHECK_FALSE(out.refusal(in_folder(256)).empty());
  std::string deep = "b.off";
  while (deep.size() < 4000) deep.insert(0, std::string(100, 'd').append("/"));
  CHECK(out.refusal(deep).find("4096") != std::string::npos);
}

TEST_CASE("texts are written as tables and pages need them", "[batch]") {
  CHECK(tools::csv_field("plain text") == "plain text");
  CHECK(tools::csv_field("a,\"b\"") == "\"a,\"\"b\"\"\"");
  CHECK(markup_text("<a href=\"x\">&") == "&lt;a href=&quot;x&quot;&gt;&amp;");
  CHECK(path_text("a b/\xc3\xa9#?%.off") == "a%20b/%C3%A9%23%3F%25.off");
}

TEST_CASE("histograms count every mesh once", "[batch]") {
  const std::vector<double> totals = {1, 2, 9.99, 10, 10.01, 1000, 999.9, 5};
  const std::vector<double> edges = batch::logarithmic_bins(totals);
  CHECK(edges.front() == 1);
  CHECK(edges.back() > 1000);
  CHECK(std::is_sorted(edges.begin(), edges.end()));
  const plot::Plot plot = batch::histogram({{"m", totals, totals}, {"n", {3}, {3}}});
  const auto& series = plot.panels.front().series;
  REQUIRE(series.size() == 2);
  CHECK(std::accumulate(series[0].y.begin(), series[0].y.end(), 0.) == 8);
  CHECK(std::accumulate(series[1].y.begin(), series[1].y.end(), 0.) == 1);
  CHECK(series[0].y.back() == 0);
  for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin)
    CHECK(series[0].y[bin] == std::count_if(totals.begin(), totals.end(), [&](double total) {
            return edges[bin] <= total && total < edges[bin + 1];
          }));
}

TEST_CASE("the cumulative distribution ends at all meshes", "[batch]") {
  const plot::Plot plot = batch::cumulative({{"m", {1, 1, 1, 1}, {7, 3, 7, 20}}});
  const plot::Series& series = plot.panels.front().series.front();
  CHECK(series.x == std::vector<double>{3, 3, 7, 7, 20});
  CHECK(series.y == std::vector<double>{0, 25, 50, 75, 100});
}
