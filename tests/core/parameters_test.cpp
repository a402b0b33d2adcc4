#include "morsel/core/text/parameters.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "morsel/core/error.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::InvalidArgument;
using core::Length;
using core::ParameterReader;

namespace {

ParameterReader reader(std::vector<std::pair<std::string, std::string>> given) {
  return ParameterReader({"salient", std::move(given)});
}

}  // namespace

TEST_CASE("parameters are read by kind and default where not given") {
  ParameterReader r =
      reader({{"a", "-2.5e-3"}, {"b", "12"}, {"c", "8eps"}, {"d", "no"}, {"e", "local"}, {"f", "x=y"}});
  CHECK(r.number("a", 1, {}, "") == -2.5e-3);
  CHECK(r.number("a2", 0.1, {}, "") == 0.1);
  CHECK(r.count("b", 1, 0, 12, "") == 12);
  CHECK(r.count("b2", 5, 0, 12, "") == 5);
  const Length c = r.length("c", Length::absolute(1), core::kPositive, "");
  CHECK(c.value == 8);
  CHECK(c.unit == core::LengthUnit::epsilon);
  const Length share = core::parse_length("2.5%", "");
  CHECK(share.value == 2.5);
  CHECK(share.unit == core::LengthUnit::percent);
  CHECK(core::to_string(share) == "2.5%");
  CHECK(r.length("c2", Length::absolute(1), core::kPositive, "").unit == core::LengthUnit::mesh);
  CHECK_FALSE(r.flag("d", true, ""));
  CHECK(r.flag("d2", true, ""));
  CHECK(r.choice("e", "1std", {"1std", "local"}, "") == "local");
  CHECK(r.choice("e2", "1std", {"1std", "local"}, "") == "1std");
  CHECK(r.text("f", "none", "") == "x=y");
  CHECK(r.text("f2", "none", "") == "none");
  CHECK(r.given("a"));
  CHECK_FALSE(r.given("a2"));
  CHECK_NOTHROW(r.finish());
  CHECK(r.declared().size() == 12);
  CHECK(r.declared()[1].default_value == "0.1");
}

TEST_CASE("a declared key says what its value is") {
  using core::ParameterKind;
  ParameterReader help = ParameterReader::for_help("salient");
  help.number("a", 1, {}, "");
  help.count("b", 1, 0, 9, "");
  help.length("c", Length::epsilons(8), {}, "");
  help.flag("d", false, "");
  help.choice("e", "x", {"x", "y"}, "which");
  help.text("f", "none", "");
  help.list("g", "1/2", "");
  const ParameterKind kinds[] = {ParameterKind::number, ParameterKind::count,  ParameterKind::length,
                                 ParameterKind::flag,   ParameterKind::choice, ParameterKind::text,
                                 ParameterKind::list};
  REQUIRE(help.declared().size() == std::size(kinds));
  for (std::size_t i = 0; i < std::size(kinds); ++i) CHECK(help.declared()[i].kind == kinds[i]);
  CHECK(help.declared()[3].choices == std::vector<std::string>{"yes", "no"});
  CHECK(help.declared()[4].choices == std::vector<std::string>{"x", "y"});
  CHECK(help.declared()[4].description == "which [x, y]");
  CHECK(help.declared()[6].choices.empty());
}

TEST_CASE("bad values are refused with owner and key and what is allowed") {
  const auto number = [](const char* text, core::Range range) {
    return reader({{"k", text}}).number("k", 1, range, "");
  };
  for (const char* text :
       {"", " 1", "1 ", "1x", "x", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "--1", "+-1", "+", "1e"}) {
    INFO(text);
    CHECK_THROWS_WITH(number(text, {}),
                      Catch::Contains("salient:k must be a finite number, not \"" + std::string(text)));
  }
  CHECK_THROWS_WITH(number("0", core::kPositive), "salient:k must be above 0, not 0");
  CHECK_THROWS_WITH(number("-1", core::kNonNegative), "salient:k must be at least 0, not -1");
  CHECK_THROWS_WITH(number("101", {0, true, 100}), "salient:k must be above 0 and at most 100, not 101");
  CHECK(number("100", {0, true, 100}) == 100);
  CHECK(number("+5", {}) == 5);

  const auto count = [](const char* text) { return reader({{"k", text}}).count("k", 1, 1, 10, ""); };
  for (const char* text : {"", "1.5", "1e1", "x", "99999999999999999999", "+-2"})
    CHECK_THROWS_AS(count(text), InvalidArgument);
  CHECK_THROWS_WITH(count("11"), "salient:k must be between 1 and 10, not 11");
  CHECK_THROWS_AS(count("0"), InvalidArgument);

  const auto length = [](const char* text) {
    return reader({{"k", text}}).length("k", Length::epsilons(8), core::kPositive, "");
  };
  for (const char* text : {"", "eps", "8 eps", "8EPS", "8epsilon", "nan", "infeps", "0", "-1eps", "edges",
                           "3 edges", "3edgess", "3epsedges", "0edges", "nanedge"})
    CHECK_THROWS_AS(length(text), InvalidArgument);

  CHECK_THROWS_AS(reader({{"k", "true"}}).flag("k", true, ""), InvalidArgument);
  CHECK_THROWS_WITH(reader({{"k", "other"}}).choice("k", "a", {"a", "b"}, ""),
                    "salient:k must be a or b, not \"other\"");
  CHECK_THROWS_WITH(reader({{"k", "taubn"}}).choice("k", "quadric", {"cotangent", "quadric", "taubin"}, ""),
                    "salient:k must be cotangent, quadric or taubin, not \"taubn\"; did you mean taubin?");
  CHECK_THROWS_WITH(reader({{"k", "yess"}}).flag("k", true, ""),
                    "salient:k must be yes or no, not \"yess\"; did you mean yes?");
}

TEST_CASE("keys that are options of a command are named as such") {
  ParameterReader options =
      ParameterReader::of_options({"molecule", {{"hetero", "residue"}, {"model", "0"}}});
  CHECK_THROWS_WITH(options.choice("hetero", "none", {"none", "residues", "all"}, ""),
                    "--hetero must be none, residues or all, not \"residue\"; did you mean residues?");
  CHECK_THROWS_WITH(options.count("model", 1, 1, 9, ""), "--model must be between 1 and 9, not 0");
}

TEST_CASE("a key that must be given is missed by name") {
  CHECK_THROWS_WITH(reader({}).text("file", nullptr, "the values"), Catch::Contains("salient needs file=…"));
  ParameterReader help = ParameterReader::for_help("salient");
  CHECK(help.text("file", nullptr, "the values").empty());
  CHECK(help.declared().front().default_value.empty());
}

TEST_CASE("files that keys name are listed") {
  ParameterReader given = reader({{"file", "a\\,b.txt"}, {"word", "c.txt"}});
  CHECK(given.file("file", nullptr, "the values") == "a,b.txt");
  CHECK(given.file("other", "", "none by default").empty());
  CHECK(given.text("word", "", "no file") == "c.txt");
  REQUIRE(given.files().size() == 1);
  CHECK(given.files().front().key == "file");
  CHECK(given.files().front().path == "a,b.txt");
  ParameterReader help = ParameterReader::for_help("salient");
  help.file("file", nullptr, "the values");
  CHECK(help.files().empty());
  CHECK(help.declared().front().key == "file");
}

TEST_CASE("unknown and doubled keys are refused with the known ones listed") {
  ParameterReader unknown = reader({{"sigma", "8eps"}, {"sgima", "1"}});
  unknown.length("sigma", Length::epsilons(8), core::kPositive, "");
  unknown.count("iterations", 10, 0, 100, "");
  CHECK_THROWS_WITH(unknown.finish(),
                    "salient has no parameter \"sgima\"; did you mean sigma? It takes: sigma, iterations");
  CHECK_THROWS_WITH(reader({{"k", "1"}}).finish(), "salient has no parameter \"k\"; it takes none");
  ParameterReader twice = reader({{"k", "1"}, {"k", "2"}});
  twice.number("k", 0, {}, "");
  CHECK_THROWS_WITH(twice.finish(), "salient:k is given twice");
}

TEST_CASE("regression: no length was the same however the mesh is turned, but those in edges") {
  const TriangleMesh mesh = jittered(sphere(2).mesh(), 0.1, 3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, core::Point(1, 2, -1).normalized()).toRotationMatrix();
  const TriangleMesh turned = moved(mesh, turn, {3, -2, 1});
  CHECK(Length::root_areas(0.02).on(turned) == Approx(Length::root_areas(0.02).on(mesh)).epsilon(1e-12));
  CHECK(Length::edges(2).on(turned) == Approx(Length::edges(2).on(mesh)).epsilon(1e-12));
  CHECK(Length::epsilons(8).on(turned) != Approx(Length::epsilons(8).on(mesh)).epsilon(1e-6));
  CHECK(core::root_area(grid(4, 5).mesh()) == Approx(std::sqrt(12.0)).epsilon(1e-14));
  CHECK(core::root_area(scaled(mesh, 0x1p-900)) == 0x1p-900 * core::root_area(mesh));
}

TEST_CASE("lengths are in the unit of the mesh, in epsilon, in edges or in roots of the area") {
  const TriangleMesh mesh = grid(4, 5).mesh();  // 3 by 4: a diagonal of 5
  CHECK(Length::absolute(0.25).on(mesh) == 0.25);
  CHECK(core::parse_length("3edge", "length").on(mesh) == Length::edges(3).on(mesh));
  // 4 rows of 4 edges, 5 columns of 3 edges, or the other way round, and 12 diagonals.
  CHECK(Length::edges(2).on(mesh) == Approx(2 * (31 + 12 * std::sqrt(2)) / 43).epsilon(1e-14));
  std::vector<core::Point> tiny(mesh.positions().begin(), mesh.positions().end());
  for (core::Point& p : tiny) p = p * 0x1p-900;
  const TriangleMesh shrunk = mesh.with_positions(std::move(tiny));
  CHECK(core::mean_edge_length(shrunk) == 0x1p-900 * core::mean_edge_length(mesh));
  CHECK(Length::epsilons(8).on(mesh) == Approx(8 * 0.003 * 5).epsilon(1e-15));
  for (const Length length : {Length::absolute(0.1), Length::epsilons(8), Length::epsilons(1.0 / 3),
                              Length::edges(3), Length::edges(1e-7), Length::root_areas(0.02)}) {
    const Length back = core::parse_length(core::to_string(length), "length");
    CHECK(back.value == length.value);
    CHECK(back.unit == length.unit);
  }
}

TEST_CASE("the shortest text of a number reads back the same") {
  for (const double value :
       {0.1, 1.0 / 3, 1e300, 5e-324, -0.0, 123456789.0, std::numeric_limits<double>::max()})
    CHECK(core::parse_number(core::shortest(value), "it") == value);
  CHECK(core::shortest(0.1) == "0.1");
}
