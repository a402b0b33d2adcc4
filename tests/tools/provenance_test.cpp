#include "morsel/tools/report/provenance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/tools/formats/base64.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/markup.h"

using namespace morsel;
using Catch::Contains;
using tools::Json;
using tools::Provenance;

namespace {

/// With all characters that formats must escape.
Provenance awkward() {
  Provenance provenance("morsel field 'a\"b -- <&>\\.off' --method salient",
                        {{"field", "vertex-scalar:file=x\\,y\nz"}, {"target", 7}},
                        {{"dir/\xc3\xa9.off", std::string(64, '0')}, {"not \xff UTF-8 }{\"", "1"}});
  tools::StepOutcome step{"salient", {{"sigma", 0.1}, {"range", std::string("1std,\"")}}, {}, {}};
  provenance.add_method({step});
  step.name = "tps";
  provenance.add_method({step, step});
  return provenance;
}

/// As the string of a .vtp file.
std::string in_array(const std::string& json) {
  const std::uint64_t size = json.size() + 1;
  return tools::base64(std::string(reinterpret_cast<const char*>(&size), sizeof size) + json + '\0');
}

}  // namespace

TEST_CASE("a provenance is one line of ASCII that any markup can hold") {
  const std::string json = awkward().json();
  for (const char c : json) CHECK((c >= ' ' && c <= '~' && c != '<' && c != '>' && c != '&'));
  const Json document = Json::parse(json);
  CHECK(document["schema"] == "morsel.provenance/1");
  CHECK(document["command"] == "morsel field 'a\"b -- <&>\\.off' --method salient");
  CHECK(document["inputs"][0] == Json({{"path", "dir/\xc3\xa9.off"}, {"sha256", std::string(64, '0')}}));
  CHECK(document["request"]["field"] == "vertex-scalar:file=x\\,y\nz");
  CHECK(document["methods"][0]["parameters"] == Json({{"sigma", 0.1}, {"range", "1std,\""}}));
  CHECK(document["methods"][1]["name"] == "tps+tps");
}

TEST_CASE("a provenance is split into short lines that join to it") {
  const Provenance provenance = awkward();
  std::string joined;
  for (const std::string& line : provenance.lines()) {
    CHECK(line.size() <= 150);
    joined += line;
  }
  CHECK(joined == provenance.json());
  CHECK(provenance.lines().size() > 3);
  // What cannot be cut stays whole.
  const Provenance with_long_text("morsel " + std::string(400, ','), {}, {});
  CHECK(
      std::ranges::any_of(with_long_text.lines(), [](const std::string& line) { return line.size() > 400; }));
}

TEST_CASE("a provenance is found in every kind of file") {
  const Provenance provenance = awkward();
  const Json expected = Json::parse(provenance.json());
  std::string ply = "ply\nformat ascii 1.0\n";
  std::string dos = "OFF\r\n";
  for (const std::string& line : provenance.lines()) {
    ply += "comment " + line + "\n";
    dos += "# " + line + "\r\n";
  }
  const std::string json = provenance.json();
  CHECK(tools::find_provenance(json) == expected);
  CHECK(tools::find_provenance(provenance.text_comment() + "1\n2\n") == expected);
  CHECK(tools::find_provenance(provenance.text_comment()) == expected);
  CHECK(tools::find_provenance(ply + "comment } {\nelement vertex 0\nend_header\n") == expected);
  CHECK(tools::find_provenance(dos + "0 0 0\r\n") == expected);
  CHECK(tools::find_provenance("<svg><metadata>" + json + "</metadata></svg>") == expected);
  CHECK(tools::find_provenance(std::string("\x89PNG\0tEXtComment\0", 17) + json + "\x01\x02{}") == expected);
  CHECK(tools::find_provenance("<html></html>\n" + provenance.html_comment()) == expected);
  CHECK(tools::find_provenance("vertex,provenance\n1," + tools::csv_field(json) + "\n2,\n") == expected);
  CHECK(tools::find_provenance("vertex,provenance\n1," + tools::csv_field(json)) == expected);
  CHECK(tools::find_provenance("vertex\n1\n" + provenance.text_comment()) == expected);
  CHECK(tools::find_provenance("<data key=\"key0\">" + tools::markup_text(json) + "</data>") == expected);
  CHECK(tools::find_provenance("glTF..JSON{\"asset\":{\"extras\":{\"provenance\":" + json + "}}}") ==
        expected);
  CHECK(tools::find_provenance("<Array>\n" + in_array(json) + "\n</Array>") == expected);
}

TEST_CASE("an HTML comment contains nothing that ends it") {
  const std::string comment = awkward().html_comment();
  CHECK(comment.starts_with("<!-- {"));
  CHECK(comment.find("--", 4) == comment.size() - 4);
}

TEST_CASE("a file without provenance gives null, a damaged one is refused") {
  const std::string json = awkward().json();
  CHECK(tools::find_provenance("").is_null());
  CHECK(tools::find_provenance("OFF\n0 0 0\n").is_null());
  const std::size_t known = std::string_view("{\"schema\":\"morsel.provenance/1\"").size();
  for (std::size_t size = 0; size < json.size(); ++size) {
    const std::string cut = json.substr(0, size);
    const std::string in_table = "1," + tools::csv_field(cut);
    const std::string in_markup = tools::markup_text(cut) + "</data>";
    const std::string of_array = in_array(cut) + "\n";
    if (size < known) {
      CHECK(tools::find_provenance(cut).is_null());
      CHECK(tools::find_provenance(in_table).is_null());
      CHECK(tools::find_provenance(in_markup).is_null());
      CHECK(tools::find_provenance(of_array).is_null());
    } else {
      CHECK_THROWS_AS(tools::find_provenance(cut), core::BadInput);
      CHECK_THROWS_AS(tools::find_provenance(in_table), core::BadInput);
      CHECK_THROWS_AS(tools::find_provenance(in_markup), core::BadInput);
      CHECK_THROWS_AS(tools::find_provenance(of_array), core::BadInput);
      CHECK_THROWS_AS(tools::find_provenance(of_array.substr(0, of_array.size() - 2)), core::BadInput);
    }
  }
  std::string damaged = json;
  damaged.replace(damaged.find("\"tool\""), 6, "tool\"\"");
  CHECK_THROWS_AS(tools::find_provenance(damaged), core::BadInput);
}

TEST_CASE("bug: a provenance nested 105,000 deep ended the program") {
  const std::string deep = "{\"schema\":\"morsel.provenance/1\",\"x\":" + std::string(105'000, '[') +
                           std::string(105'000, ']') + "}";
  for (const std::string& text :
       {deep, "# " + deep + "\n0\n", "comment " + deep + "\r\n", "<!-- " + deep + " -->",
        "1," + tools::csv_field(deep), tools::markup_text(deep), in_array(deep)})
    CHECK_THROWS_WITH(tools::find_provenance(text), Contains("nested deeper than 64 levels"));
  const std::string long_one =
      "{\"schema\":\"morsel.provenance/1\",\"x\":\"" + std::string(1 << 20, 'x') + "\"}";
  CHECK_THROWS_AS(tools::find_provenance(long_one), core::BadInput);
}

TEST_CASE("a provenance has all members that it is read for, with their types") {
  const Json whole = Json::parse(awkward().json());
  for (const auto& [key, value] : whole.items()) {
    if (key == "schema") continue;
    Json without = whole;
    without.erase(key);
    if (key != "methods" && key != "field")
      CHECK_THROWS_AS(tools::find_provenance(without.dump()), core::BadInput);
    for (const Json& other : {Json(), Json(5), Json(true)}) {
      Json wrong = whole;
      wrong[key] = other;
      CHECK_THROWS_AS(tools::find_provenance(wrong.dump()), core::BadInput);
    }
  }
}
