#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/difference.h"
#include "morsel/tools/report/hashed_mesh.h"

using namespace morsel;
using tools::Json;

namespace {

tools::ReportDocument document(const Json& report) {
  std::istringstream in(report.dump());
  return tools::parse_report(in);
}

std::vector<tools::Difference> differences(const Json& before, const Json& after) {
  return tools::report_differences(document(before), document(after));
}

/// Any finite double, the whole range and round ones.
double some_double(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  const auto small = static_cast<double>(static_cast<std::int64_t>(random()) % 2000);
  const double any = std::bit_cast<double>(random());
  const double of_a_field = small * 1e-3 * std::ldexp(static_cast<double>(random() >> 11), -53);
  return bits % 4 == 0 || !std::isfinite(any) ? small
         : bits % 4 == 1                      ? small / 8
         : bits % 4 == 2                      ? any
                                              : of_a_field;
}

/// A report as compare writes it, with two methods, to `json`.
void write_report(tools::JsonSink& json) {
  json.begin_object();
  json.member("schema", "morsel.comparison/1");
  json.member("field", {{"name", "height"}, {"min", -100.0}, {"max", 50.0}});
  json.begin_array("methods");
  for (const char* name : {"conventional", "tps"}) {
    json.begin_object();
    json.member("name", name);
    json.begin_object("persistence");
    json.member("pairs", 3);
    json.begin_array("diagram");
    for (unsigned i = 0; i < 3; ++i)
      json.row({{"kind", std::string_view("saddle-cap")}, {"birth", 0.5 * i}, {"death", nullptr}});
    json.end_array();
    json.end_object();
    json.begin_array("items");
    for (unsigned i = 0; i < 5000; ++i) {
      const std::array<double, 3> position = {1.0 * i, 0.1, -1e300};
      json.row({{"vertex", i}, {"position", std::span<const double, 3>(position)}, {"value", 0.1 * i}});
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
  json.member("path", "caf\xe9.off");
  json.member("timings", {{"total", 1.0}});
  json.end_object();
}

}  // namespace

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
  stream.row({{"x", 1u}});
  stream.row({});
  stream.end_array();
  stream.begin_object("inner");
  stream.member("deep", true);
  stream.end_object();
  stream.end_object();
  const Json expected = {{"text", "quote \" and \\ and ü"},           {"number", 0.1},
                         {"nested", {{"a", {1, 2}}, {"b", nullptr}}}, {"empty", Json::array()},
                         {"items", {{{"x", 1}}, Json::object()}},     {"inner", {{"deep", true}}}};
  CHECK(Json::parse(out.str()) == expected);
}

TEST_CASE("a row is the text of the object it stands for") {
  std::mt19937_64 random(3);
  for (int run = 0; run < 20000; ++run) {
    const std::uint64_t whole = random() >> (random() % 64);
    const double real = some_double(random);
    const std::array<double, 3> point = {some_double(random), some_double(random), some_double(random)};
    const std::string text = run % 3 == 0   ? "saddle"
                             : run % 3 == 1 ? "a \"\\\n ü \x7f"
                                            : std::string("caf\xe9\0", 5);
    std::ostringstream out;
    tools::JsonStream stream(out);
    stream.begin_array();
    stream.row({{"whole", whole},
                {"real", real},
                {"point", std::span<const double, 3>(point)},
                {"te\"xt", std::string_view(text)},
                {"null", nullptr},
                {"infinite", std::numeric_limits<double>::infinity()}});
    stream.end_array();
    const Json object = {{"whole", whole}, {"real", real},    {"point", point},
                         {"te\"xt", text}, {"null", nullptr}, {"infinite", nullptr}};
    REQUIRE(out.str() == "[\n  " + tools::json_text(object) + "\n]\n");
  }
}

TEST_CASE("documents have no characters that act on a terminal") {
  const std::string name =
      "a\xc2\x9b"
      "31m\xe2\x80\xae\x7f.off";
  const std::string expected = R"("a\u009b31m\u202e\u007f.off")";
  CHECK(tools::json_text(Json(name)) == expected);
  CHECK(Json::parse(expected) == name);
  std::ostringstream out;
  tools::JsonStream stream(out);
  stream.begin_object();
  stream.member(name, {{name, name}});
  stream.begin_array(name);
  stream.row({{name, std::string_view(name)}});
  stream.end_array();
  stream.end_object();
  CHECK(out.str() == "{\n  " + expected + ": {\n    " + expected + ": " + expected + "\n  },\n  " + expected +
                         ": [\n    {" + expected + ":" + expected + "}\n  ]\n}\n");
}

TEST_CASE("rows within a row are an array of objects in it") {
  const tools::MakeRow inner = [](std::size_t i, const tools::TakeRow& take) {
    take({{"j", i}, {"x", 0.5}});
  };
  const tools::MakeRow outer = [&](std::size_t i, const tools::TakeRow& take) {
    take({{"i", i}, {"list", tools::NestedRows{i, inner}}, {"text", "after"}});
  };
  std::ostringstream out;
  tools::JsonStream stream(out);
  tools::ReportCollector collector;
  for (tools::JsonSink* sink :
       {static_cast<tools::JsonSink*>(&stream), static_cast<tools::JsonSink*>(&collector)}) {
    sink->begin_object();
    sink->begin_array("rows");
    sink->rows(3, outer);
    sink->end_array();
    sink->end_object();
  }
  const Json none = Json::array();
  const Json one = {{"j", 0}, {"x", 0.5}};
  const Json two = {{"j", 1}, {"x", 0.5}};
  const Json expected = {{"rows",
                          {{{"i", 0}, {"list", none}, {"text", "after"}},
                           {{"i", 1}, {"list", Json::array({one})}, {"text", "after"}},
                           {{"i", 2}, {"list", Json::array({one, two})}, {"text", "after"}}}}};
  CHECK(Json::parse(out.str()) == expected);
  CHECK(collector.take().head == expected);
}

TEST_CASE("many rows at once are the same text as one after the other") {
  const core::ThreadLimit limit(4);
  for (const std::size_t count : {0u, 1u, 511u, 512u, 513u, 40000u, 65536u}) {
    for (const bool first : {true, false}) {
      std::ostringstream at_once;
      std::ostringstream one_by_one;
      tools::JsonStream a(at_once);
      tools::JsonStream b(one_by_one);
      for (tools::JsonStream* stream : {&a, &b}) {
        stream->begin_object();
        stream->begin_array("rows");
        if (!first) stream->row({{"first", 1u}});
      }
      const auto make = [](std::size_t i, const tools::TakeRow& take) {
        take({{"i", i}, {"x", 0.1 * static_cast<double>(i)}});
      };
      a.rows(count, make);
      for (std::size_t i = 0; i < count; ++i) make(i, [&](tools::Row row) { b.row(row); });
      for (tools::JsonStream* stream : {&a, &b}) {
        stream->row({});
        stream->end_array();
        stream->end_object();
      }
      REQUIRE(at_once.str() == one_by_one.str());
    }
  }
}

TEST_CASE("a mesh and its hash are read together and errors are the reader's") {
  const auto path = std::filesystem::temp_directory_path() / "morsel_hashed_mesh_test.off";
  std::ofstream(path) << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    const tools::HashedMesh mesh = tools::read_hashed_mesh(path);
    CHECK(mesh.loaded.mesh.vertex_count() == 4);
    CHECK(mesh.sha256 == tools::sha256_of_file(path));
  }
  std::filesystem::remove(path);
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    CHECK_THROWS_WITH(tools::read_hashed_mesh(path), Catch::Contains("No such file"));
  }
}

TEST_CASE("rows are packed and come back as they were") {
  tools::PackedRows rows;
  std::vector<Json> expected;
  std::mt19937_64 random(5);
  for (int i = 0; i < 10000; ++i) {
    Json row = {{"vertex", random() >> (random() % 64)},
                {"value", some_double(random)},
                {"delta", -static_cast<std::int64_t>(random() >> 1)},
                {"list", {some_double(random), nullptr, "x"}}};
    if (i % 97 == 1)
      row = some_double(random);
    else if (i % 89 == 1)
      row.erase("value");
    else if (i % 83 == 1)
      row = Json::array({1, {{"a", true}}});
    expected.push_back(row);
    rows.add(row);
  }
  REQUIRE(rows.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(rows[i].dump() == expected[i].dump());
    REQUIRE(rows.has_equal(i, rows));
  }
}

TEST_CASE("a report collected is the report written and read") {
  std::ostringstream text;
  tools::JsonStream stream(text);
  write_report(stream);
  tools::ReportCollector collector;
  write_report(collector);
  const tools::ReportDocument collected = collector.take();
  std::istringstream in(text.str());
  const tools::ReportDocument read = tools::parse_report(in);
  CHECK(read.head.dump() == collected.head.dump());
  CHECK(read.head["methods"][1]["items"] == Json::array());
  REQUIRE(read.methods.size() == 2);
  for (std::size_t m = 0; m < 2; ++m) {
    const tools::MethodRows& a = read.methods[m];
    const tools::MethodRows& b = collected.methods[m];
    REQUIRE((a.items.size() == 5000 && b.items.size() == 5000));
    REQUIRE((a.diagram.size() == 3 && b.diagram.size() == 3));
    for (std::size_t i = 0; i < 5000; ++i) REQUIRE(a.items.has_equal(i, b.items));
    for (std::size_t i = 0; i < 3; ++i) REQUIRE(a.diagram.has_equal(i, b.diagram));
  }
  CHECK(tools::report_differences(read, collected).empty());
}

TEST_CASE("differences in the rows of a report are reported like all others") {
  std::ostringstream text;
  tools::JsonStream stream(text);
  write_report(stream);
  const Json report = Json::parse(text.str());
  Json other = report;
  other["methods"][1]["items"][4999]["position"][1] = 0.2;
  other["methods"][1]["items"][4999]["value"] = 499.9 + 1e-11;
  other["methods"][0]["items"].erase(7);
  other["methods"][0]["persistence"]["diagram"][2]["kind"] = "x";
  const auto found = differences(report, other);
  REQUIRE(found.size() > 4);
  CHECK(found[0].where == "methods[0] (conventional): persistence.diagram[2].kind");
  CHECK(found[0].before == "\"saddle-cap\"");
  CHECK(found[1].where == "methods[0] (conventional): items");
  CHECK(found[1].before == "5000 entries");
  CHECK(found[1].after == "4999 entries");
  CHECK(found[2].where == "methods[0] (conventional): items[7].vertex");
  CHECK(found.back().where == "methods[1] (tps): items[4999].position[1]");
  CHECK(found.back().after == "0.2");

  // Laid out in another way it is the same report.
  const Json sorted = nlohmann::json(report);
  CHECK(sorted.begin().key() != report.begin().key());
  CHECK(differences(report, sorted).empty());

  Json without = report;
  without["methods"][1].erase("items");
  const auto missing = differences(report, without);
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].where == "methods[1] (tps): items");
  CHECK(missing[0].before == "[5000 entries]");
  CHECK(missing[0].after == "absent");
  without["methods"][1]["items"] = {{"methods", {{{"items", {1, 2}}}}}};
  CHECK(differences(report, without).size() == 1);
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
  CHECK(differences(report, report).empty());
  Json other = report;
  other["timings"]["total"] = 7;
  other["timings"]["new"] = 1;
  other["tool"]["version"] = "2";
  other["methods"][0]["value"] = 1.0 + 1e-11;
  CHECK(differences(report, other).empty());

  other["methods"][0]["critical_points"]["total"] = 6;
  other["methods"][0]["value"] = 1.0 + 1e-6;
  other["mesh"]["added"] = "x";
  other["field"].erase("max");
  const auto found = differences(report, other);
  REQUIRE(found.size() == 4);
  CHECK(found[0].where == "mesh.added");
  CHECK(found[1].where == "field.max");
  CHECK(found[1].after == "absent");
  CHECK(found[2].where == "methods[0] (tps): critical_points.total");
  CHECK(found[2].before == "5");
  CHECK(found[2].after == "6");
  CHECK(found[3].where == "methods[0] (tps): value");
}

TEST_CASE("null is not zero and a text is not a number") {
  CHECK(differences({{"a", nullptr}}, {{"a", 0}}).size() == 1);
  CHECK(differences({{"a", "1"}}, {{"a", 1}}).size() == 1);
  CHECK(differences({{"a", 1}}, {{"a", 1.0}}).empty());
  CHECK(differences({{"a", {1, 2}}}, {{"a", {1, 2, 3}}}).size() == 1);
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
