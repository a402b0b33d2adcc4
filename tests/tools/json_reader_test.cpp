#include "morsel/tools/formats/json_reader.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <sstream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/report/report_reader.h"

using namespace morsel;
using Catch::Contains;
using tools::Json;
using tools::JsonView;
using tools::read_json;

namespace {

std::string nested(std::size_t depth, const std::string& innermost = "") {
  return std::string(depth, '[') + innermost + std::string(depth, ']');
}

/// The message of reading; it is the project's own, whatever the library throws.
std::string refusal(std::string_view text, const tools::JsonLimits& limits = {}) {
  try {
    static_cast<void>(read_json(text, "x.json", limits));
  } catch (const core::BadInput& error) {
    CHECK_THAT(error.what(),
               Contains("x.json is not JSON that can be read: ") && !Contains("json.exception"));
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a document is read as it is") {
  const std::string text =
      R"( {"a": [1, -2, 18446744073709551615, 0.1, 1e300, true, false, null, "\u00e9\n", {}],
       "b": {"c": []}, "a": 2} )";
  const Json expected = Json::parse(text);
  CHECK(read_json(text, "x") == expected);
  std::istringstream in(text);
  CHECK(read_json(in, "x") == expected);
  CHECK(read_json("7", "x") == 7);
  CHECK(read_json("[0.1, 5e-324, 1.7976931348623157e308]", "x") ==
        Json({0.1, 5e-324, 1.7976931348623157e308}));
  const std::string large =
      "[" + std::string(200000, ' ') + "\"" + std::string(100000, 'x') + "\"]";  // several pieces
  std::istringstream again(large);
  CHECK(read_json(large, "x") == read_json(again, "x"));
}

TEST_CASE("what is not JSON is refused with the place") {
  CHECK_THAT(refusal(""), Contains("cut off"));
  CHECK_THAT(refusal("{\"a\": [1, 2"), Contains("cut off, or wrong at its end, after 11 bytes"));
  CHECK_THAT(refusal("{\"a\": nul, \"b\": 1}  "), Contains("byte 10 is unexpected"));
  CHECK_THAT(refusal("[1] 2  "), Contains("byte 5 is unexpected"));
  CHECK_THAT(refusal("[1e999]"), Contains("the number that ends at byte 6 is too large"));
  CHECK_THAT(refusal("[\"\xff\"] "), Contains("byte 3 is unexpected"));
  CHECK_THAT(refusal("[\"\\ud800\"] "), Contains("is unexpected"));
  CHECK_THAT(refusal("[NaN] "), Contains("is unexpected"));
  CHECK_THAT(refusal(std::string("[\0]", 3)), Contains("byte 2"));
}

TEST_CASE("bug: a document nested 105,000 deep ended the program") {
  CHECK(refusal(nested(64)).empty());
  CHECK(refusal(nested(63, "{}")).empty());
  CHECK_THAT(refusal(nested(65)), Contains("at byte 65 it is nested deeper than 64 levels"));
  CHECK_THAT(refusal(nested(64, "{}")), Contains("at byte 65"));
  CHECK_THAT(refusal(nested(105'000)), Contains("nested deeper"));
  std::string objects;
  for (int i = 0; i < 105'000; ++i) objects += "{\"a\":";
  CHECK_THAT(refusal(objects), Contains("nested deeper"));
}

TEST_CASE("texts, objects and documents have limits") {
  const tools::JsonLimits limits{.depth = 4, .token = 100'000, .members = 3, .bytes = 300'000};
  CHECK(refusal("[\"" + std::string(100'000, 'x') + "\"]", limits).empty());
  CHECK_THAT(refusal("[\"" + std::string(100'001, 'x') + "\"]", limits), Contains("more than 100000 bytes"));
  CHECK_THAT(refusal("{\"" + std::string(100'001, 'x') + "\": 1}", limits),
             Contains("more than 100000 bytes"));
  CHECK_THAT(refusal("[" + std::string(250'000, ' ') + "]", limits), Contains("more than 100000 bytes"));
  CHECK_THAT(refusal("[" + std::string(250'000, '1') + "]", limits), Contains("more than 100000 bytes"));
  CHECK(refusal(R"({"a": 1, "b": 2, "c": 3, "a": 4})", limits).empty());
  CHECK_THAT(refusal(R"({"a": 1, "b": 2, "c": 3, "d": 4})", limits), Contains("more than 3 members"));
  std::string list = "[0";
  while (list.size() < 299'990) list += ",0";
  CHECK(refusal(list + "]", limits).empty());
  CHECK_THAT(refusal(list + std::string(20, ' ') + "]", limits), Contains("more than 300000 bytes"));
}

TEST_CASE("whatever a document has, it is refused or read in linear time", "[slow]") {
  const auto seconds = [](const std::string& text) {
    const auto begin = std::chrono::steady_clock::now();
    static_cast<void>(refusal(text));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto repeated = [](const std::string& piece, std::size_t bytes) {
    std::string text = "[";
    while (text.size() < bytes) text += piece;
    return text;
  };
  std::string full_object = "{";
  for (int i = 0; i < 512; ++i) full_object += (i == 0 ? "\"k" : ",\"k") + std::to_string(1000 + i) + "\":0";
  full_object += "},";
  for (const std::string& piece : {full_object, std::string("[[[],[]]],"), std::string("\"\\u0000\","),
                                   std::string("1e5,"), std::string("{\"a\":{}},")}) {
    const double small = seconds(repeated(piece, 1'000'000));
    const double large = seconds(repeated(piece, 16'000'000));
    CHECK(large < 16 * 6 * small + 1);  // 256 times if it were quadratic
  }
}

TEST_CASE("a view refuses what has another type, with its place") {
  const Json document = read_json(
      R"({"methods": [{"name": "a"}, {}, {"name": 5}], "n": 3, "neg": -1, "x": 1.5,
          "big": 18446744073709551615,
          "path": "a\u0000b", "none": null, "yes": true, "text": "t"})",
      "x");
  const JsonView view(document, "r.json is a damaged report");
  CHECK(view["methods"].list()[0]["name"].text() == "a");
  CHECK_THROWS_WITH(view["methods"].list()[2]["name"].text(),
                    "r.json is a damaged report: methods[2].name is not a text");
  CHECK_THROWS_WITH(view["methods"].list()[1]["name"],
                    "r.json is a damaged report: methods[1] lacks \"name\"");
  CHECK_THROWS_WITH(view["absent"], "r.json is a damaged report: it lacks \"absent\"");
  CHECK_THROWS_WITH(view["n"]["x"], "r.json is a damaged report: n is not an object");
  CHECK_THROWS_WITH(view["n"].list(), Contains("n is not a list"));
  CHECK_THROWS_WITH(view["methods"].list(4), Contains("methods has 3 entries, not at least 4"));
  CHECK_THROWS_WITH(view["methods"].list(0, 2), Contains("methods has 3 entries, not at most 2"));
  CHECK_THROWS_WITH(view["methods"].list(2, 2), Contains("methods has 3 entries, not 2"));
  CHECK(view["n"].count() == 3);
  CHECK_THROWS_WITH(view["n"].count(2), Contains("n is out of range"));
  CHECK_THROWS_WITH(view["neg"].count(), Contains("neg is below 0"));
  CHECK_THROWS_WITH(view["x"].count(), Contains("x is not a whole number"));
  CHECK_THROWS_WITH(view["big"].count(), Contains("big is out of range"));
  CHECK_THROWS_WITH(view["big"].integer(0, 5), Contains("big is out of range"));
  CHECK(view["neg"].integer(-1, 5) == -1);
  CHECK_THROWS_WITH(view["neg"].integer(0, 5), Contains("neg is out of range"));
  CHECK(view["x"].number() == 1.5);
  CHECK_THROWS_WITH(view["x"].number(2), Contains("x is out of range"));
  CHECK_THROWS_WITH(view["text"].number(), Contains("text is not a number"));
  CHECK_THROWS_WITH(view["path"].path(), Contains("path is not a path"));
  CHECK_THROWS_WITH(view["none"].truth(), Contains("none is neither true nor false"));
  CHECK(view["yes"].truth());
  CHECK_THROWS_WITH(view["text"].text_of({"a", "b"}), Contains("text is none of a, b"));
  CHECK_FALSE(view.find("absent"));
}

TEST_CASE("bug: a report whose method has a number as its name was an internal error") {
  const auto read = [](const std::string& methods) {
    std::istringstream in(
        R"({"schema": "morsel.comparison/1", "request": {"field": "f", "methods": ["m"], "repair": false},
      "mesh": {"path": "p", "sha256": "s"}, "methods": )" +
        methods + "}");
    return tools::read_report(in, "r.json");
  };
  CHECK(read(R"([{"name": "m"}])").request.methods == std::vector<std::string>{"m"});
  CHECK_THROWS_WITH(read(R"([{"name": 5}])"), "r.json is a damaged report: methods[0].name is not a text");
  CHECK_THROWS_WITH(read("5"), "r.json is a damaged report: methods is not a list");
  std::string many = "[0";
  for (int i = 0; i < 3'000'000; ++i) many += ",0";
  CHECK_THROWS_WITH(read(many + ",{\"items\": [1]}]"),
                    Contains("methods has 3000002 entries, not at most 10000"));
}

TEST_CASE("another document is refused by its schema, as soon as that is known") {
  const auto read = [](const std::string& text) {
    std::istringstream in(text);
    return tools::read_report(in, "r.json");
  };
  CHECK_THROWS_AS(read(R"({"schema": "morsel.cut/1", "rest": )"), tools::OtherDocument);
  CHECK_THROWS_AS(read("{}"), tools::OtherDocument);
  CHECK_THROWS_AS(read("5"), tools::OtherDocument);
  CHECK_THROWS_AS(read(R"({"schema": 5})"), tools::OtherDocument);
}
