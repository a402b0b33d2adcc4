#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "morsel/core/error.h"
#include "morsel/tools/report/difference.h"
#include "morsel/tools/report/json_stream.h"
#include "morsel/tools/report/sha256.h"
#include "morsel/tools/report/text_table.h"

using namespace morsel;
using tools::Json;

TEST_CASE("a document written piece by piece is the document") {
  std::ostringstream out;
  tools::JsonStream stream(out);
  stream.begin_object();
  stream.member("text", "quote \" and \\ and ü");
  stream.member("number", 0.1);
  stream.member("nested", {{"a", {1, 2}}, {"b", nullptr}});
  stream.begin_array("empty");
  stream.end_array();
  stream.begin_array("items");
  stream.element({{"x", 1}});
  stream.element(2);
  stream.end_array();
  stream.begin_object("inner");
  stream.member("deep", true);
  stream.end_object();
  stream.end_object();
  const Json expected = {{"text", "quote \" and \\ and ü"},
                         {"number", 0.1},
                         {"nested", {{"a", {1, 2}}, {"b", nullptr}}},
                         {"empty", Json::array()},
                         {"items", {{{"x", 1}}, 2}},
                         {"inner", {{"deep", true}}}};
  CHECK(Json::parse(out.str()) == expected);
}

TEST_CASE("text that is not UTF-8 does not break a document") {
  std::ostringstream out;
  tools::JsonStream stream(out);
  stream.begin_object();
  stream.member("path", "caf\xe9.off");
  stream.end_object();
  CHECK(Json::parse(out.str())["path"].get<std::string>().starts_with("caf"));
}

TEST_CASE("reports differ where counts do and not where timings or last digits do") {
  const Json report = {{"schema", "morsel.comparison/1"},
                       {"tool", {{"name", "morsel"}, {"version", "1"}}},
                       {"mesh", {{"bbox_diagonal", 2.0}}},
                       {"field", {{"min", -100.0}, {"max", 50.0}}},
                       {"methods", {{{"name", "tps"}, {"critical_points", {{"total", 5}}}, {"value", 1.0}}}},
                       {"timings", {{"total", 1.0}}}};
  CHECK(tools::report_differences(report, report).empty());
  Json other = report;
  other["timings"]["total"] = 7;
  other["timings"]["new"] = 1;
  other["tool"]["version"] = "2";
  other["methods"][0]["value"] = 1.0 + 1e-11;
  CHECK(tools::report_differences(report, other).empty());

  other["methods"][0]["critical_points"]["total"] = 6;
  other["methods"][0]["value"] = 1.0 + 1e-6;
  other["mesh"]["added"] = "x";
  other["field"].erase("max");
  const auto differences = tools::report_differences(report, other);
  REQUIRE(differences.size() == 4);
  CHECK(differences[0].where == "mesh.added");
  CHECK(differences[1].where == "field.max");
  CHECK(differences[1].after == "absent");
  CHECK(differences[2].where == "methods[0] (tps): critical_points.total");
  CHECK(differences[2].before == "5");
  CHECK(differences[2].after == "6");
  CHECK(differences[3].where == "methods[0] (tps): value");
}

TEST_CASE("null is not zero and a text is not a number") {
  CHECK(tools::report_differences({{"a", nullptr}}, {{"a", 0}}).size() == 1);
  CHECK(tools::report_differences({{"a", "1"}}, {{"a", 1}}).size() == 1);
  CHECK(tools::report_differences({{"a", 1}}, {{"a", 1.0}}).empty());
  CHECK(tools::report_differences({{"a", {1, 2}}}, {{"a", {1, 2, 3}}}).size() == 1);
}

TEST_CASE("numbers for people") {
  CHECK(tools::grouped(0) == "0");
  CHECK(tools::grouped(999) == "999");
  CHECK(tools::grouped(1000) == "1,000");
  CHECK(tools::grouped(1234567890) == "1,234,567,890");
}

TEST_CASE("tables line up even with letters outside ASCII") {
  CHECK(tools::text_table({{"name", "n"}, {"ü", "10"}}) == "name   n\n----  --\nü     10\n");
}

TEST_CASE("SHA-256 of a file") {
  const auto path = std::filesystem::temp_directory_path() / "morsel_sha256_test.txt";
  std::ofstream(path) << "abc";
  CHECK(tools::sha256_of_file(path) == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::filesystem::remove(path);
  CHECK_THROWS_AS(tools::sha256_of_file(path), core::BadInput);
}
