#include "morsel/tools/formats/csv.h"

#include <catch2/catch.hpp>

#include <sstream>
#include <stdexcept>

using namespace morsel;
using tools::csv_field;
using tools::csv_path;

TEST_CASE("bug: fields of a table were formulas of a spreadsheet") {
  CHECK(csv_path("=cmd|' /C calc'!A0.off") == "./=cmd|' /C calc'!A0.off");
  CHECK(csv_path("@a,b.off") == "\"./@a,b.off\"");
  CHECK(csv_path("-1") == "./-1");
  CHECK(csv_path("sub/=a.off") == "sub/=a.off");
  CHECK(csv_path("") == "");
  for (const char* begin : {"=", "+", "-", "@", "\t", "\r", "\n"}) {
    const std::string text = std::string(begin) + "cmd";
    CHECK(csv_field(text).find_first_not_of('"') == csv_field(text).find('\''));
    CHECK(csv_field("x" + text).find('\'') == std::string::npos);
  }
  CHECK(csv_field("=1+1") == "'=1+1");
  CHECK(csv_field("-2eps") == "'-2eps");
}

TEST_CASE("numbers of a table stay numbers") {
  for (const char* number : {"-1", "+1", "-0.5", "-1e-300", "1", "-.5"}) CHECK(csv_field(number) == number);
  tools::CsvLine line;
  line.add(-0.25);
  line.add("-0.25");
  line.add_path("=a");
  line.add_json(-3);
  line.add_json("=a");
  CHECK(line.text() == "-0.25,-0.25,./=a,-3,'=a");
}

TEST_CASE("a table has its names first and its comments last") {
  std::ostringstream out;
  tools::CsvTable table(out, {"vertex", "type, or \"kind\"", "value"});
  tools::CsvLine row;
  row.add(std::uint64_t{7});
  row.add("a#b");
  CHECK_THROWS_AS(table.add(row), std::logic_error);
  row.add(0.5);
  table.add(row);
  table.end({"{\"made\":", "\"by\"}"});
  CHECK(out.str() == "vertex,\"type, or \"\"kind\"\"\",value\n7,\"a#b\",0.5\n# {\"made\":\n# \"by\"}\n");
}
