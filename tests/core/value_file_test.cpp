#include "morsel/core/io/value_file.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "support/corpus.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::parse_value_file;
using core::ValueFile;

namespace {

using Values = std::vector<double>;

Values values_in(const std::string& text, const std::string& name, const std::string& column = {}) {
  return parse_value_file(text, name, column).values;
}

std::string refusal(const std::string& text, const std::string& name, const std::string& column = {}) {
  try {
    parse_value_file(text, name, column);
  } catch (const core::BadInput& error) {
    return error.what();
  }
  return "not refused";
}

/// A .npy file of version 1.
std::string npy_file(const std::string& header, const std::string& data) {
  std::string text = "\x93NUMPY";
  text += '\x01';
  text += '\0';
  text += static_cast<char>(header.size());
  text += '\0';
  return text + header + data;
}

template <class T>
std::string bytes_of(std::vector<T> values, bool big) {
  std::string text;
  for (const T value : values) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (big == (std::endian::native == std::endian::little)) std::reverse(one.begin(), one.end());
    text += one;
  }
  return text;
}

}  // namespace

TEST_CASE("lines before the first number of a text are a header") {
  const ValueFile file = parse_value_file("thickness\n(mm)\n\n1.5\n2\n\n3\n", "t.txt");
  CHECK(file.values == Values{1.5, 2, 3});
  CHECK(file.place(0) == "line 4");
  CHECK(file.place(2) == "line 7");
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0] ==
        "t.txt: the 2 lines before the first number were skipped as a header, from \"thickness\" on");
  CHECK(parse_value_file("x\n1\n", "t.txt").warnings[0] ==
        "t.txt: the line before the first number was skipped as a header: \"x\"");
  CHECK_THAT(refusal("x\ny\n", "t.txt"), Catch::Contains("line 1: \"x\" is not one number"));
  CHECK_THAT(refusal("1\nx\n", "t.txt"), Catch::Contains("line 2: \"x\" is not one number"));
}

TEST_CASE("lines of a text end with \\r where it has no \\n") {
  CHECK(values_in("1\r2\r3\r", "t.txt") == Values{1, 2, 3});
  CHECK(values_in("a,b\r1,2\r3,4\r", "t.csv", "b") == Values{2, 4});
}

TEST_CASE("several columns of a text need the name of one") {
  CHECK_THAT(
      refusal("x y z\n1 2 3\n", "t.txt"),
      Catch::Contains("line 2: \"1 2 3\" is not one number but 3: choose a column by column=1 to column=3"));
  CHECK(values_in("x y z\n1 2 3\n 4\t5  6 \n", "t.txt", "2") == Values{2, 5});
  CHECK(values_in("x y z\n1 2 3\n 4\t5  6 \n", "t.txt", "z") == Values{3, 6});
  CHECK(values_in("# x y z\n1 2 3\n4 5 6\n", "t.txt", "y") == Values{2, 5});  // as numpy.savetxt has it
  CHECK(values_in("1\n2\n", "t.txt", "1") == Values{1, 2});
  CHECK_THAT(refusal("1 2\n", "t.txt", "3"),
             Catch::Contains("no column \"3\": choose one by column=1 to column=2"));
}

TEST_CASE("a column of a CSV file goes by name or number") {
  const std::string comma = "vertex,\"sulcal depth\",area\r\n0,1.5,2\r\n1,-2.5,\r\n\r\n2,\"3e1\",NA\r\n";
  CHECK(values_in(comma, "t.csv", "sulcal depth") == Values{1.5, -2.5, 30});
  CHECK(values_in(comma, "t.csv", "2") == Values{1.5, -2.5, 30});
  const ValueFile area = parse_value_file(comma, "t.csv", "area");
  CHECK(area.values[0] == 2);
  CHECK(std::isnan(area.values[1]));
  CHECK(std::isnan(area.values[2]));
  CHECK(area.place(2) == "line 5");
  CHECK(area.warnings ==
        std::vector<std::string>{"t.csv: 2 of 3 values are missing (empty or NA); they are nan"});
  CHECK(values_in("a;b\n1;2\n3;4\n", "t.csv", "b") == Values{2, 4});
  CHECK(values_in("a\tb\n1\t2\n3\t4\n", "t.tsv", "a") == Values{1, 3});
  CHECK(values_in("\xEF\xBB\xBF# made by hand\nvalue\n1\n2\n", "t.CSV") == Values{1, 2});
  CHECK(values_in("1\n2\n", "t.csv") == Values{1, 2});
  CHECK(values_in("\"say \"\"a, b\"\"\",\"two\nlines\"\n1,2\n3,4\n", "t.csv", "say \"a, b\"") ==
        Values{1, 3});
  CHECK(parse_value_file("a,\"two\nlines\"\n1,2\n3,4\n", "t.csv", "a").place(1) == "line 4");
  CHECK(values_in("2,1\n5,6\n7,8\n", "t.csv", "1") == Values{2, 5, 7});  // numbers are no names
  CHECK(values_in("2,a\n5,6\n7,8\n", "t.csv", "2") == Values{5, 7});
}

TEST_CASE("numbers in quotes are names where the values have none") {
  const std::string quoted = "\"1\",\"2\"\n10,20\n30,40\n";
  CHECK(values_in(quoted, "t.csv", "1") == Values{10, 30});
  CHECK(values_in(quoted, "t.csv", "2") == Values{20, 40});
  CHECK(values_in("\"2020\",\"2021\"\n1,2\n3,4\n", "t.csv", "2021") == Values{2, 4});
  CHECK(values_in("\"2020\",\"2021\"\n1,2\n3,4\n", "t.csv", "1") == Values{1, 3});
  CHECK(values_in("\"7\"\n1\n2\n", "t.csv") == Values{1, 2});
  // Where all cells have quotes they say nothing.
  CHECK(values_in("\"1\",\"2\"\n\"3\",\"4\"\n", "t.csv", "2") == Values{2, 4});
  CHECK(values_in("\"1\"\n", "t.csv") == Values{1});
}

TEST_CASE("bug: of columns of the same name the first was taken") {
  CHECK(refusal("a,x,b,x\n1,2,3,4\n", "t.csv", "x") ==
        "t.csv: the columns 2 and 4 are called \"x\": choose one by its number, as in column=2");
  CHECK(values_in("a,x,b,x\n1,2,3,4\n", "t.csv", "4") == Values{4});
  CHECK(values_in("a,x,b,x\n1,2,3,4\n", "t.csv", "b") == Values{3});
  CHECK_THAT(refusal("# x x x\n1 2 3\n", "t.txt", "x"), Catch::Contains("the columns 1, 2 and 3 are called"));
}

TEST_CASE("names that are numbers are chosen where they are no numbers of columns") {
  CHECK(values_in("2020,2021\n1,2\n3,4\n", "t.csv", "2021") == Values{2, 4});
  CHECK(values_in("2020 2021\n1 2\n3 4\n", "t.txt", "2020") == Values{1, 3});
  CHECK(values_in("2020,2021\n1,2\n3,4\n", "t.csv", "2") == Values{2021, 2, 4});
  CHECK_THAT(refusal("2020,2021\n1,2\n", "t.csv", "2022"), Catch::Contains("no column \"2022\""));
}

TEST_CASE("values too small for double precision are 0") {
  const Values values = values_in("1e-400\n-1e-400\n+2\n", "t.txt");
  CHECK(values == Values{0, 0, 2});
  CHECK(std::signbit(values[1]));
  CHECK(values_in("a,b\n1e-400,2\n", "t.csv", "a") == Values{0});
  CHECK_THAT(refusal("1e400\n", "t.txt"), Catch::Contains("beyond the range of double precision"));
}

TEST_CASE("CSV files that are damaged or leave a choice are refused") {
  CHECK_THAT(refusal("x,y\n1,2\n", "t.csv"),
             Catch::Contains("the columns \"x\", \"y\"") && Catch::Contains("column=NAME"));
  CHECK_THAT(refusal("x,y\n1,2\n", "t.csv", "z"), Catch::Contains("no column \"z\""));
  CHECK_THAT(refusal("x,y\n1,2\n3\n", "t.csv", "x"),
             Catch::Contains("line 3: it has 1 column, but the table has 2"));
  CHECK_THAT(refusal("x,y\n1,2\n3,4,5\n", "t.csv", "x"), Catch::Contains("line 3: it has 3 columns"));
  CHECK_THAT(refusal("x,y\n1,2\nq,4\n", "t.csv", "x"), Catch::Contains("line 3: \"q\" is not one number"));
  CHECK_THAT(refusal("x;y\n1,5;2\n", "t.csv", "x"), Catch::Contains("\"1,5\" is not one number"));
  CHECK_THAT(refusal("x,y\n1,\"2\n3,4\n", "t.csv", "x"), Catch::Contains("line 2: a quote is opened"));
  CHECK_THAT(refusal("x,y\n1,\"2\"3\n", "t.csv", "x"), Catch::Contains("line 2: a cell goes on"));
  CHECK(values_in("", "t.csv").empty());
  CHECK(values_in("x\n", "t.csv").empty());
}

TEST_CASE("arrays of NumPy are read in all types, orders and shapes") {
  const auto header = [](const std::string& type, const std::string& shape, bool fortran = false) {
    return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
           ", 'shape': " + shape + ", }          \n";
  };
  const auto both = [&](const std::string& type, const auto& values, const Values& expected) {
    CHECK(values_in(npy_file(header("<" + type, "(3,)"), bytes_of(values, false)), "a.npy") == expected);
    CHECK(values_in(npy_file(header(">" + type, "(3, 1)"), bytes_of(values, true)), "a.npy") == expected);
  };
  both("f8", std::vector<double>{0.1, -0.0, 1e300}, {0.1, -0.0, 1e300});
  both("f4", std::vector<float>{0.1f, 2, INFINITY}, {0.1f, 2, INFINITY});
  both("f2", std::vector<std::uint16_t>{0x3C00, 0xC000, 0x0001}, {1, -2, std::ldexp(1.0, -24)});
  both("i8", std::vector<std::int64_t>{-1, 2, 1 << 30}, {-1, 2, 1 << 30});
  both("u2", std::vector<std::uint16_t>{1, 65535, 3}, {1, 65535, 3});
  CHECK(values_in(npy_file(header("|b1", "(2,)"), std::string("\1\0", 2)), "a.npy") == Values{1, 0});
  CHECK(values_in(npy_file(header("|i1", "(2,)"), "\xFF\x02"), "any name") == Values{-1, 2});
  const std::string table = bytes_of(std::vector<float>{1, 2, 3, 4, 5, 6}, false);
  CHECK(values_in(npy_file(header("<f4", "(2, 3)"), table), "a.npy", "2") == Values{2, 5});
  CHECK(values_in(npy_file(header("<f4", "(2, 3)", true), table), "a.npy", "2") == Values{3, 4});
  CHECK_THAT(refusal(npy_file(header("<f4", "(2, 3)"), table), "a.npy"),
             Catch::Contains("3 columns: choose one by column=1 to column=3"));
  CHECK_THAT(refusal(npy_file(header("<f4", "(2, 3)"), table), "a.npy", "4"), Catch::Contains("no column"));
  CHECK_THAT(refusal(npy_file(header("<f4", "(7,)"), table), "a.npy"), Catch::Contains("bytes for only 6"));
  CHECK_THAT(refusal(npy_file(header("<f4", "(4294967296, 4294967296)"), table), "a.npy"),
             Catch::Contains("bytes for only 6"));
  CHECK_THAT(refusal(npy_file(header("<f4", "(1, 2, 3)"), table), "a.npy"), Catch::Contains("3 dimensions"));
  CHECK_THAT(refusal(npy_file(header("<f4", "()"), table), "a.npy"), Catch::Contains("0 dimensions"));
  CHECK_THAT(refusal(npy_file(header("<c8", "(3,)"), table), "a.npy"),
             Catch::Contains("of the type \"<c8\""));
  CHECK_THAT(refusal(npy_file("{'descr': [('x', '<f4')], ", table), "a.npy"), Catch::Contains("of records"));
  CHECK_THAT(refusal("1\n", "a.npy"), Catch::Contains("no NumPy array"));
  const ValueFile longer = parse_value_file(npy_file(header("<f4", "(4,)"), table), "a.npy");
  CHECK(longer.values == Values{1, 2, 3, 4});
  CHECK(longer.warnings == std::vector<std::string>{"a.npy: 8 bytes follow its array; they were not read"});
  CHECK(longer.place(3) == "entry 3");
}

TEST_CASE("an array of NumPy that is cut off or changed is read or refused") {
  const std::string whole = npy_file("{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }\n",
                                     bytes_of(std::vector<double>{1, 2, 3}, false));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CHECK(refusal(whole.substr(0, i), "a.npy") != "not refused");
    for (const char change : {'\0', '\xFF', '9', ' ', '\''}) {
      std::string changed = whole;
      changed[i] = change;
      REQUIRE_NOTHROW(refusal(changed, "a.npy"));
    }
  }
}

TEST_CASE("values are arrays of the points of a mesh file") {
  const std::string folder = corpus_folder() + "/meshes/";
  CHECK(core::read_value_file(folder + "inline_zlib.vtp", "a vector:1").values == Values{0, 0.5, 1, 1.5});
  CHECK(core::read_value_file(folder + "quality.ply", "red").values == Values{255, 0, 7, 8});
  CHECK_THROWS_WITH(core::read_value_file(folder + "quality.ply"),
                    Catch::Contains("3 arrays") && Catch::Contains("column=NAME: quality, red, time"));
  CHECK_THROWS_WITH(core::read_value_file(folder + "quality.ply", "blue"),
                    Catch::Contains("no array \"blue\""));
  CHECK_THROWS_WITH(core::read_value_file(folder + "tetrahedron.off"), Catch::Contains("0 arrays"));
}
