#include "morsel/tools/report/document_origin.h"

#include <catch2/catch.hpp>
#include <string>

#include "morsel/core/error.h"

using namespace morsel;
using tools::Json;

TEST_CASE("a document's inputs are the files with hashes in it, each once") {
  const Json origin = tools::document_origin(
      R"({"schema":"morsel.points/1","tool":{"name":"morsel","version":"1.2"},"request":{"list":[1,2]},
          "mesh":{"path":"m.off","sha256":"aa","warnings":["x"]},
          "field":{"name":"f","parameters":{"file":"v.txt","file_sha256":"bb"}},
          "points":[{"path":"m.off","sha256":"aa"},{"path":"m.off","sha256":"cc"},{"path":"no hash"}]})",
      "d.json");
  CHECK(origin["schema"] == "morsel.points/1");
  CHECK(origin["tool"]["version"] == "1.2");
  CHECK(origin["request"]["list"] == Json({1, 2}));
  CHECK(origin["field"]["parameters"]["file"] == "v.txt");
  REQUIRE(origin["inputs"].size() == 3);
  CHECK(origin["inputs"][0] == Json({{"path", "m.off"}, {"sha256", "aa"}}));
  CHECK(origin["inputs"][1] == Json({{"path", "v.txt"}, {"sha256", "bb"}}));
  CHECK(origin["inputs"][2] == Json({{"path", "m.off"}, {"sha256", "cc"}}));
  CHECK_FALSE(origin.contains("points"));
}

TEST_CASE("JSON that is not of the program has no origin, and what lacks its members is refused") {
  for (const char* other : {"[1,2]", "{}", R"({"schema":"other/1","tool":{}})", R"({"schema":"morsel.x/1"})"})
    CHECK(tools::document_origin(other, "d.json").is_null());
  for (const char* damaged : {"{\"schema\":", R"({"schema":"morsel.x/1","tool":{"name":"morsel"}})",
                              R"({"schema":"morsel.x/1","tool":3})",
                              R"({"schema":"morsel.x/1","tool":{"name":"m","version":"1"},"request":[]})",
                              R"({"schema":"morsel.x/1","tool":{"name":"m","version":"1"},"field":{}})"})
    CHECK_THROWS_AS(tools::document_origin(damaged, "d.json"), core::BadInput);
  CHECK(tools::described_schema("morsel.cut/1").find("morsel cut") != std::string::npos);
  CHECK(tools::described_schema("morsel.other/9") == "a document of morsel");
}
