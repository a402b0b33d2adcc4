#include "morsel/morse/functions/vertex_scalar.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::BadInput;
using core::ScalarField;

namespace {

ScalarField read(const Scratch& scratch, std::string_view text, const core::MeshSource* source = nullptr) {
  return morse::vertex_scalar(square_pair().mesh(), source, {scratch.file("values.txt", text), ""});
}

/// Six vertices in the file: 1 was dropped, 4 was welded to 0.
core::MeshSource repaired_source() {
  core::MeshSource source;
  source.numbering = {6, {0, 2, 3, 5}, {0, core::kNone, 1, 2, 0, 3}};
  return source;
}

std::unique_ptr<core::MorseFunction> make(Given given) {
  return made(morse::make_vertex_scalar, "vertex-scalar", std::move(given));
}

}  // namespace

TEST_CASE("values are read line by line") {
  const Scratch scratch;
  const std::vector<double> expected = {1.5, -2, 3e-7, 0.1};
  CHECK(values_of(read(scratch, "1.5\n-2\n3e-7\n0.1\n")) == expected);
  CHECK(values_of(read(scratch, "1.5\n-2\n3e-7\n0.1")) == expected);
  CHECK(values_of(read(scratch, "1.5\r\n -2\t\r\n+3e-7\r\n0.1\r\n")) == expected);
  CHECK(values_of(read(scratch, "\xEF\xBB\xBF# heights\n\n1.5\n-2 # the lowest\n\n3e-7\n  \n0.1\n\n")) ==
        expected);
  CHECK(values_of(read(scratch, "4.9406564584124654e-324\n-0\n1.7976931348623157e308\n2\n"))[0] ==
        std::nextafter(0.0, 1.0));
}

TEST_CASE("what is odd in a file of values is a warning, also where values are missing") {
  const Scratch scratch;
  std::vector<std::string> warnings;
  const std::filesystem::path file = scratch.file("values.txt", "depth\n1\n2\n3\n4\n");
  const TriangleMesh mesh = square_pair().mesh();
  CHECK(values_of(morse::vertex_scalar(mesh, nullptr, {file, ""}, {}, &warnings)) ==
        std::vector<double>{1, 2, 3, 4});
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Catch::Contains("the line before the first number") && Catch::Contains("\"depth\""));
  CHECK(make({{"file", file.string()}})->evaluate(mesh, {}).warnings == warnings);
  CHECK_THROWS_WITH(read(scratch, "1,\n2\n3\n4\n"),
                    Catch::Contains("3 values, but") && Catch::Contains("skipped as a header: \"1,\""));
}

TEST_CASE("values go by the vertices of the file") {
  const Scratch scratch;
  const core::MeshSource source = repaired_source();
  CHECK(values_of(read(scratch, "0\n10\n20\n30\n40\n50\n", &source)) == std::vector<double>{0, 20, 30, 50});
  CHECK(values_of(read(scratch, "0\nnan\n20\n30\n-inf\n50\n", &source)) ==
        std::vector<double>{0, 20, 30, 50});
  CHECK_THROWS_WITH(read(scratch, "0\n20\n30\n50\n", &source),
                    Catch::Contains("4 values") && Catch::Contains("6 vertices"));
}

TEST_CASE("damaged value files are refused with file and line") {
  const Scratch scratch;
  // The message of the refusal.
  const auto refused = [&](std::string_view text) -> std::string {
    try {
      read(scratch, text);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  const auto says = [&](std::string_view text, const std::string& a, const std::string& b) {
    const std::string message = refused(text);
    INFO(message);
    CHECK(message.find("values.txt") != std::string::npos);
    CHECK(message.find(a) != std::string::npos);
    CHECK(message.find(b) != std::string::npos);
  };
  says("", "0 values", "4 vertices");
  says("1\n2\n3\n", "3 values", "4 vertices");
  says("1\n2\n3\n4\n5\n", "5 values", "4 vertices");
  says("1\n# two\n2\nthree\n4\n", "line 4", "\"three\"");
  says("1\n2 3\n4\n5\n", "line 2", "\"2 3\"");
  says("1\n2,5\n4\n5\n", "line 2", "\"2,5\"");
  says("1\n2\n0x10\n5\n", "line 3", "not one number");
  says("1\n+-2\n3\n5\n", "line 2", "not one number");
  says("1\n1e999\n3\n5\n", "line 2", "range");
  says(std::string("1\n\0\x01\n3\n5\n", 9), "line 2", "\"??\"");
  says("1\n\n\nnan\n3\ninf\n", "line 4: vertex 1 has the value nan", "first of 2");
  says(std::string(100'000, 'x'), "line 1", "…");
}

TEST_CASE("value files that cannot be read are refused") {
  const Scratch scratch;
  const TriangleMesh mesh = square_pair().mesh();
  CHECK_THROWS_AS(morse::vertex_scalar(mesh, nullptr, {scratch / "none.txt", ""}), BadInput);
  CHECK_THROWS_WITH(morse::vertex_scalar(mesh, nullptr, {scratch / "none.txt", ""}),
                    Catch::Contains("none.txt") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(morse::vertex_scalar(mesh, nullptr, {scratch.path(), ""}),
                    Catch::Contains("it is a directory"));
}

TEST_CASE("a property of the mesh file becomes a field") {
  core::MeshSource source = repaired_source();
  source.properties = {{"quality", {0, 1, 2, 3, 4, 5}},
                       {"broken", {0, 1, NAN, 3, 4, NAN}},
                       {"spotted", {0, NAN, 2, 3, 4, 5}},
                       {"short", {1, 2}}};
  const TriangleMesh mesh = square_pair().mesh();
  const auto take = [&](const std::string& name) { return morse::vertex_scalar(mesh, &source, {"", name}); };
  CHECK(values_of(take("quality")) == std::vector<double>{0, 2, 3, 5});
  CHECK(values_of(take("spotted")) == std::vector<double>{0, 2, 3, 5});
  CHECK_THROWS_WITH(take("broken"), Catch::Contains("broken") && Catch::Contains("vertex 2") &&
                                        Catch::Contains("first of 2"));
  CHECK_THROWS_AS(take("short"), BadInput);
  CHECK_THROWS_WITH(take("height"),
                    Catch::Contains("\"height\"") && Catch::Contains("quality, broken, spotted, short"));
  CHECK_THROWS_WITH(morse::vertex_scalar(mesh, nullptr, {"", "quality"}), Catch::Contains("none"));
}

TEST_CASE("vertex scalar keys are checked before any file is touched") {
  const Scratch scratch;
  const std::string file = scratch.file("values.txt", "1\n2\n3\n4\n").string();
  const TriangleMesh mesh = square_pair().mesh();
  const core::FunctionResult result = make({{"file", file}})->evaluate(mesh, {});
  CHECK(values_of(result.field) == std::vector<double>{1, 2, 3, 4});
  CHECK(result.parameters == core::Parameters{{"file", file}});
  CHECK_NOTHROW(make({{"file", "no such file"}}));
  CHECK_THROWS_AS(make({{"file", "no such file"}})->evaluate(mesh, {}), BadInput);

  core::MeshSource source;
  source.properties = {{"q", {4, 3, 2, 1}}};
  const core::FunctionResult property = make({{"property", "q"}})->evaluate(mesh, {&source, {}});
  CHECK(values_of(property.field) == std::vector<double>{4, 3, 2, 1});
  CHECK(property.parameters == core::Parameters{{"property", "q"}});

  const std::string table = scratch.file("table.csv", "a,b\n1,5\n2,6\n3,7\n4,8\n").string();
  const core::FunctionResult column = make({{"file", table}, {"column", "b"}})->evaluate(mesh, {});
  CHECK(values_of(column.field) == std::vector<double>{5, 6, 7, 8});
  CHECK(column.parameters == core::Parameters{{"file", table}, {"column", "b"}});
  CHECK(column.warnings.empty());
  CHECK_THROWS_AS(make({{"property", "q"}, {"column", "b"}}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::vertex_scalar(mesh, &source, {"", "q", "b"}), core::InvalidArgument);

  CHECK_THROWS_WITH(make({}), Catch::Contains("file=") && Catch::Contains("property"));
  CHECK_THROWS_WITH(make({{"file", "a"}, {"property", "b"}}), Catch::Contains("not both"));
  CHECK_THROWS_AS(make({{"file", ""}}), core::InvalidArgument);
  CHECK_THROWS_AS(make({{"property", ""}}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::vertex_scalar(mesh, nullptr, {"", ""}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::vertex_scalar(mesh, nullptr, {"a", "b"}), core::InvalidArgument);
  core::ParameterReader help = core::ParameterReader::for_help("vertex-scalar");
  CHECK_NOTHROW(morse::make_vertex_scalar(help));
  CHECK(help.declared().size() == 3);
}
