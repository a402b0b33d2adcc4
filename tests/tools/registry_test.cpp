#include "morsel/tools/study/registry.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/text/specification.h"
#include "morsel/morse/functions/height.h"
#include "morsel/morse/smoothing/conventional.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/iteration_levels.h"
#include "morsel/tools/study/made_points.h"
#include "morsel/tools/study/stability.h"

using namespace morsel;
using Catch::Contains;

TEST_CASE("every entry can be made with its defaults or reports the missing keys") {
  for (const auto& entry : tools::Registry::standard().functions()) {
    core::ParameterReader reader = core::ParameterReader::for_help(std::string(entry.name));
    CHECK(entry.make(reader) != nullptr);
    CHECK_FALSE(entry.summary.empty());
  }
  for (const auto& entry : tools::Registry::standard().methods())
    CHECK(tools::Registry::standard().make_method(entry.name).steps.size() == 1);
}

TEST_CASE("names are unique") {
  std::set<std::string_view> names;
  for (const auto& entry : tools::Registry::standard().functions()) CHECK(names.insert(entry.name).second);
  names.clear();
  for (const auto& entry : tools::Registry::standard().methods()) CHECK(names.insert(entry.name).second);
}

TEST_CASE("a chain keeps its steps in order") {
  const tools::MethodChain chain =
      tools::Registry::standard().make_method("salient:iterations=5+tps:count=150+conventional");
  CHECK(chain.name == "salient+tps+conventional");
  REQUIRE(chain.steps.size() == 3);
  CHECK(chain.steps[1].name == "tps");
}

TEST_CASE("a method that ignores its input can only begin a chain") {
  CHECK(tools::Registry::standard().make_method("denoise:iterations=2+salient+tps").steps.size() == 3);
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("salient+denoise"),
                    Contains("first step") && Contains("salient"));
  CHECK_THROWS_AS(tools::Registry::standard().make_method("denoise+denoise"), core::InvalidArgument);
  // Of salient it depends on the scale.
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("tps+salient:scale=2edges"),
                    Contains("salient:scale=2edges") && Contains("first step") && Contains("tps"));
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("salient+salient:preset=robust"),
                    Contains("first step"));
  CHECK(tools::Registry::standard().make_method("salient+salient:preset=robust,scale=0").steps.size() == 2);
  CHECK(tools::Registry::standard()
            .make_method("salient:preset=robust+tps")
            .steps[0]
            .method->traits()
            .reevaluates_function);
  CHECK_FALSE(
      tools::Registry::standard().make_method("salient").steps[0].method->traits().reevaluates_function);
}

TEST_CASE("unknown names and keys list the valid ones") {
  CHECK_THROWS_WITH(
      tools::Registry::standard().make_method("foo"),
      Contains("foo") && Contains("conventional, ") && Contains(", salient, ") && Contains(", tps"));
  CHECK_THROWS_WITH(tools::Registry::standard().make_function("foo"),
                    Contains("height, ") && Contains("vertex-scalar"));
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("salient:foo=1"),
                    Contains("\"foo\"") && Contains("iterations, ") && Contains("sigma, range"));
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("salient:sigma=1,sigma=2"), Contains("twice"));
  CHECK_THROWS_AS(tools::Registry::standard().make_method("salient+"), core::InvalidArgument);
  CHECK_THROWS_AS(tools::Registry::standard().make_function("height+height"), core::InvalidArgument);
}

TEST_CASE("errors of a specification say whose it is") {
  const tools::Registry& registry = tools::Registry::standard();
  CHECK_THROWS_WITH(registry.make_function("height+height"),
                    Catch::StartsWith("the Morse function \"height+height\" is a chain"));
  CHECK_THROWS_WITH(registry.make_method(":"), Catch::StartsWith("the method \":\" has an empty name"));
  tools::PointsRequest points;
  points.fill = "a+b";
  CHECK_THROWS_WITH(tools::prepare(points),
                    Catch::StartsWith("the Morse function that fills up \"a+b\" is a chain"));
  tools::StabilityRequest request;
  request.reference = ":";
  CHECK_THROWS_WITH(tools::prepare(request), Catch::StartsWith("the reference method \":\""));
  request = {};
  request.reference_field = ":";
  CHECK_THROWS_WITH(tools::prepare(request), Catch::StartsWith("the reference Morse function \":\""));
  request = {};
  request.fields = {":"};
  CHECK_THROWS_WITH(tools::prepare(request), Catch::StartsWith("the Morse function \":\""));
}

TEST_CASE("a user adds functions and methods of their own to a copy") {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::MethodEntry{
      "own", "mine", [](core::ParameterReader& reader) { return morse::make_conventional(reader); }});
  CHECK(registry.make_method("salient+own").name == "salient+own");
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("own"), Contains("there is no method \"own\""));
  const auto make = [](core::ParameterReader& reader) { return morse::make_height(reader); };
  CHECK_THROWS_WITH(registry.add(tools::FunctionEntry{"height", "taken", make}), Contains("already"));
  for (const char* name : {"", "two words", "a+b", "a:b", "Big"})
    CHECK_THROWS_AS(registry.add(tools::FunctionEntry{name, "no name", make}), core::InvalidArgument);
  registry.add(tools::FunctionEntry{"height-2", "mine", make});
  CHECK(registry.make_function("height-2:axis=x").name == "height-2");
  CHECK(registry.functions().size() == tools::Registry::standard().functions().size() + 1);
  CHECK(tools::prepare({.field = "height-2", .methods = {"own"}, .target = {}}, registry).chains.size() == 1);
}

TEST_CASE("a function of a user's own has a unit and files, and may need the vertices of the file") {
  class Own : public core::MorseFunction {
   public:
    core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                  const core::FunctionContext&) const override {
      return {core::ScalarField(mesh, std::vector<double>(mesh.vertex_count())), {}};
    }
    core::FunctionTraits traits() const override { return {.needs_input_vertices = true}; }
  };
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::FunctionEntry{"own", "mine",
                                    [](core::ParameterReader& reader) {
                                      reader.file("table", nullptr, "values");
                                      return std::make_unique<Own>();
                                    },
                                    "K"});
  const tools::NamedFunction function = registry.make_function("own:table=t.txt");
  CHECK(function.unit == "K");
  REQUIRE(function.files.size() == 1);
  CHECK(function.files.front().key == "table");
  CHECK(function.files.front().path == "t.txt");
  tools::StabilityRequest request;
  request.fields = {"own:table=t.txt"};
  CHECK(tools::prepare(request, registry).functions.size() == 1);
  request.subdivide = {2};
  CHECK_THROWS_WITH(tools::prepare(request, registry), Contains("own has no values for the vertices"));

  const std::filesystem::path table = std::filesystem::temp_directory_path() / "morsel-own-table.txt";
  std::ofstream(table) << "1\n";
  const std::string text = "own:table=" + core::escape(table.string());
  CHECK(tools::named_files(text, registry) ==
        std::vector<std::pair<std::string, std::string>>{{"own:table", table.string()}});
  const std::vector<tools::HashedFile> hashed = tools::input_files({text, "height"}, registry);
  REQUIRE(hashed.size() == 1);
  CHECK(hashed.front().sha256 == tools::sha256_of_file(table));
  CHECK_THROWS_AS(tools::input_files({text}), core::InvalidArgument);
  std::filesystem::remove(table);
}

TEST_CASE("a method iterates if its traits say so, whatever its keys are called") {
  tools::Registry registry = tools::Registry::standard();
  registry.add(tools::MethodEntry{"own", "mine", [](core::ParameterReader& reader) {
                                    reader.text("iterations", nullptr, "no number");
                                    return morse::make_conventional(reader);
                                  }});
  CHECK_FALSE(registry.traits_of_method("own").iterates);
  CHECK(registry.traits_of_method("salient").iterates);
  CHECK_THROWS_WITH(tools::with_iterations("own:iterations=many", 3, registry),
                    Contains("own has no iterations") && Contains("gaussian, laplacian, salient"));
  CHECK_THROWS_AS(registry.traits_of_method("none"), core::InvalidArgument);
}

TEST_CASE("help names every key with its default") {
  const std::string text = tools::Registry::standard().describe_method("salient");
  for (const char* key : {"iterations=10", "sigma=8eps", "range=1std", "support=2"})
    CHECK_THAT(text, Contains(key));
  CHECK_THAT(tools::Registry::standard().describe_method("tps"), Contains("threshold=0.1%"));
  CHECK_THAT(tools::Registry::standard().describe_function("height"), Contains("axis=z"));
  CHECK_THROWS_AS(tools::Registry::standard().describe_method("height"), core::InvalidArgument);
}
