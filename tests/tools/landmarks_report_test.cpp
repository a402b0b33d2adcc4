#include <catch2/catch.hpp>
#include <sstream>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/plot/landmarks_plots.h"
#include "morsel/tools/report/landmarks_journal.h"
#include "morsel/tools/report/landmarks_result.h"
#include "morsel/tools/report/landmarks_table.h"
#include "morsel/tools/report/landmarks_writer.h"
#include "support/scratch.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using tools::Json;
using tools::JsonView;
using tools::LandmarksJournal;
using tools::LandmarksOnMesh;
using tools::LandmarksPlan;
using tools::LandmarksRequest;
using tools::MarkedFiles;

namespace {

/// A list of two bodies in a folder of its own.
class Collection {
 public:
  Collection() {
    for (const char* name : {"a.off", "b.off"})
      core::write_off(folder / name,
                      jittered(with_tips({Point(1, 0, 0), Point(0, 0, 1)}, 2), 0.01, name[0] == 'a' ? 1 : 2));
    folder.file("a.txt", "0\n5\n");
    folder.file("b.txt", "1 2 3 1\n");
    folder.file("list", "a.off a.txt\nb.off,b.txt\n");
  }
  MarkedFiles files() const { return {folder / "list", 0, {}}; }

  const Scratch folder;
};

LandmarksRequest report_request() {
  LandmarksRequest result;
  result.fields = {"height", "mean-curvature"};
  result.methods = {"gaussian:iterations=1+tps:count=40"};
  result.choice.fill = "gaussian-curvature";
  result.choice.rank = morse::PointRank::salience;
  result.resamples = 200;
  return result;
}

Json section(const LandmarksOnMesh& result, const LandmarksPlan& plan) {
  return Json::parse(tools::json_text(tools::result_section(result, plan)));
}

}  // namespace

TEST_CASE("marked files are read with their hashes, and what is wrong with them is told") {
  const Collection collection;
  MarkedFiles files = collection.files();
  REQUIRE(files.size() == 2);
  const tools::MarkedMesh mesh = files.load(1, {});
  CHECK(mesh.marks == std::vector<core::Index>{1, 2, 3});
  CHECK(mesh.warnings.size() == 1);
  const Json section = files.section(1);
  CHECK(section["mesh"]["path"] == "b.off");  // as in the list, wherever that is
  CHECK(section["mesh"]["sha256"] == tools::sha256_of_file(collection.folder / "b.off"));
  CHECK(section["marks"]["sha256"] == tools::sha256_of("1 2 3 1\n"));
  files.load(0, {});
  CHECK(files.inputs().size() == 5);
  collection.folder.file("b.txt", "1000\n");
  MarkedFiles changed = collection.files();
  CHECK_THROWS_WITH(changed.load(1, {}), Contains("b.txt, line 1: there is no vertex 1000"));
  collection.folder.file("b.txt", "x\n");
  CHECK_THROWS_AS(collection.files(), core::BadInput);
  collection.folder.file("list", "a.off c.txt\n");
  CHECK_THROWS_WITH(collection.files(), Contains("c.txt"));
  CHECK_THROWS_WITH(MarkedFiles(collection.folder / "none", 0, {}), Contains("none"));
}

TEST_CASE("results of landmarks are read back as they were written, and others are refused") {
  const Collection collection;
  MarkedFiles files = collection.files();
  const LandmarksPlan plan = tools::prepare(report_request());
  for (const LandmarksOnMesh& result : run_landmarks(files, plan)) {
    const Json written = section(result, plan);
    CHECK(section(tools::read_result(JsonView(written, "a result"), plan), plan) == written);
    const auto refuse = [&](const auto& spoil) {
      Json other = written;
      spoil(other);
      CHECK_THROWS_AS(tools::read_result(JsonView(other, "a result"), plan), core::BadInput);
    };
    refuse([](Json& json) { json.erase("wanted"); });
    refuse([](Json& json) { json["marked"] = 0; });
    refuse([](Json& json) { json["radius"] = -1; });
    refuse([](Json& json) { json["fields"].erase(0); });
    refuse([](Json& json) { json["rows"].erase(0); });
    refuse([](Json& json) { json["rows"][0].erase("method"); });
    refuse([](Json& json) { json["rows"][0]["points"].erase(0); });
    refuse([](Json& json) { json["rows"][2]["sets"].erase(0); });
    refuse([](Json& json) { json["rows"][2]["points"] = {1}; });
    refuse([](Json& json) { json["rows"][0]["sets"][0]["points"] = 1000; });
    refuse([](Json& json) { json["rows"][0]["sets"][0]["matched"] = 1000; });
    refuse([](Json& json) { json["rows"][0]["sets"][0]["detected_within"].erase(0); });
    refuse([](Json& json) { json["rows"][3]["sets"][0]["detected_within"][0] = 1000; });
  }
}

TEST_CASE("a journal of landmarks gives back meshes whose files are the same") {
  const Collection collection;
  const LandmarksPlan plan = tools::prepare(report_request());
  const Json key = tools::landmarks_key(plan.request, {}, {});
  const auto path = collection.folder / "out.json.journal";
  std::vector<Json> whole;
  {
    MarkedFiles files = collection.files();
    tools::Journal journal(path, key);
    LandmarksJournal kept(journal, files, plan, {});
    CHECK(kept.count() == 0);
    for (const LandmarksOnMesh& result : run_landmarks(files, plan, {}, &kept))
      whole.push_back(section(result, plan));
  }
  {
    MarkedFiles files = collection.files();
    tools::Journal journal(path, key);
    LandmarksJournal kept(journal, files, plan, {});
    REQUIRE(kept.count() == 2);
    for (const std::size_t mesh : {0, 1}) {
      const std::optional<LandmarksOnMesh> found = kept.find(mesh);
      REQUIRE(found);
      CHECK(section(*found, plan) == whole[mesh]);
      CHECK(files.section(mesh)["mesh"]["path"] == (mesh == 0 ? "a.off" : "b.off"));
    }
  }
  {
    collection.folder.file("a.txt", "0\n6\n");
    MarkedFiles files = collection.files();
    tools::Journal journal(path, key);
    LandmarksJournal kept(journal, files, plan, {});
    CHECK_FALSE(kept.find(0));
    CHECK(kept.find(1));
  }
  MarkedFiles files = collection.files();
  LandmarksRequest other = report_request();
  other.methods = {"conventional"};
  const LandmarksPlan other_plan = tools::prepare(other);
  tools::Journal journal(path, tools::landmarks_key(other, {}, {}));
  CHECK(LandmarksJournal(journal, files, other_plan, {}).count() == 0);
  CHECK(journal.warnings().size() == 1);
}

TEST_CASE("the table, the CSV and the plots of landmarks have every row") {
  const Collection collection;
  MarkedFiles files = collection.files();
  const LandmarksPlan plan = tools::prepare(report_request());
  const auto meshes = run_landmarks(files, plan);
  const auto sums = summarize(plan, meshes);
  const std::string table = landmarks_table(plan, meshes, sums);
  CHECK_THAT(table, Contains("2 meshes, 5 marks; as many points as each mesh has marks (extrema by salience, "
                             "5% apart); hits within 5% along the surface; seed 1"));
  for (const char* row :
       {"\nheight, gaussian:", "\nmean-curvature, gaussian:", "\nrandom ", "\nfarthest points "})
    CHECK_THAT(table, Contains(row));
  CHECK_THAT(table, Contains("200 resamples"));

  std::ostringstream csv;
  tools::write_landmarks_csv(csv, {files, plan, meshes, sums, {}, 0});
  const std::string text = csv.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 2 * 4);

  const tools::plot::Plot errors = tools::plot::landmark_errors(plan, sums);
  REQUIRE(errors.panels.size() == 2);
  CHECK(errors.x.unit == "% of the diagonal");
  for (const tools::plot::Panel& panel : errors.panels) {
    REQUIRE(panel.series.size() == 4);
    CHECK(panel.series[2].name == "random");
    CHECK(panel.series[0].x.back() == 12);
  }
  CHECK(errors.panels[0].series[1].y == sums[1].false_negatives_within);
  CHECK(errors.panels[1].series[3].y == sums[3].false_positives_within);
  const tools::plot::Plot scores = tools::plot::landmark_scores(plan, meshes);
  REQUIRE(scores.panels.at(0).series.size() == 4);
  CHECK(scores.panels[0].series[0].y == std::vector<double>{1, 0.5, 0, 0});
}
