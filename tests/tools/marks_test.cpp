#include "morsel/tools/study/marks.h"

#include <catch2/catch.hpp>

#include "morsel/core/error.h"
#include "support/meshes.h"

using namespace morsel;
using Catch::Contains;
using core::BadInput;
using core::Index;
using tools::find_marked_vertices;
using tools::Mark;
using tools::parse_marked_pairs;
using tools::parse_marks;

namespace {

std::vector<std::uint64_t> numbers(const std::string& text) {
  std::vector<std::uint64_t> result;
  for (const Mark& mark : parse_marks(text, "f")) result.push_back(mark.number);
  return result;
}

std::vector<std::string> pairs(const std::string& text) {
  std::vector<std::string> result;
  for (const tools::MarkedPair& pair : parse_marked_pairs(text, "list"))
    result.push_back(pair.mesh + " | " + pair.marks);
  return result;
}

using Numbers = std::vector<std::uint64_t>;
using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a list of marked meshes in every form") {
  CHECK(pairs("a.off b.txt\n# c\n\n  \t\nc/d.ply\te f.txt\n") == Texts{"a.off | b.txt", "c/d.ply | e f.txt"});
  CHECK(pairs("mesh,vertices\r\nwith space.off, b.txt \r\nx.off,y.txt") ==
        Texts{"with space.off | b.txt", "x.off | y.txt"});
  CHECK(pairs("  a.off   b.vts  ") == Texts{"a.off | b.vts"});
  CHECK(pairs("\"a, b.off\" , \"c \"\"d\"\".txt\"") == Texts{"a, b.off | c \"d\".txt"});
  CHECK(pairs("\"a b.off\" c.txt") == Texts{"a b.off | c.txt"});
  CHECK(pairs("a.off\tb, c.txt\n").size() == 1);   // the comma separates
  CHECK(pairs("a.off x\na.off y\n").size() == 2);  // two people marked it
}

TEST_CASE("bad lists are refused with the line") {
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "list lists no mesh"},
           {"# only\n", "list lists no mesh"},
           {"mesh marks\n", "list lists no mesh"},
           {"a.off b\na.off\n", "list, line 2: a mesh and a file of vertices are expected, not 1 field"},
           {"a b c\n", "line 1: a mesh and a file of vertices are expected, not 3 fields"},
           {"a,b,c\n", "not 3 fields"},
           {"a.off,\n", "line 1: a path is empty"},
           {"\n\"\",b\n", "line 2: a path is empty"},
           {"\"a.off b\n", "line 1: a quote is not closed"},
           {"\"a\"x b\n", "line 1: a quote"},
           {"a b\n\na b\n", "line 3: a with b is listed twice"},
           {std::string("a\0 b", 4), "NUL"}})
    CHECK_THROWS_WITH(pairs(text), Contains(what));
  CHECK_THROWS_AS(pairs("x"), BadInput);
}

TEST_CASE("files of vertices in every form") {
  CHECK(numbers("3\n1\n\n4\n") == Numbers{3, 1, 4});
  CHECK(numbers("3 1,4;1\t5 # six\n% no\n9") == Numbers{3, 1, 4, 1, 5, 9});
  CHECK(numbers("   1.2340000e+03\r\n   5.0\r\n") == Numbers{1234, 5});  // as numerical programs save them
  CHECK(numbers("1 2 3 4\n5 6 7 8\n") == Numbers{1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(numbers("1 2 3 -4\n5 6 7 8\n") == Numbers{1, 5});  // number and position
  CHECK(numbers("12 0.5 1 2\n13 0 0 0\n") == Numbers{12, 13});
  CHECK(numbers("vertex,x,y,z,type\n7,0.1,0.2,0.3,\"a, b\"\n8,1,2,3,maximum\n") == Numbers{7, 8});
  CHECK(numbers("vertex\n7\n") == Numbers{7});
  const std::vector<Mark> marks = parse_marks("# a\n5\n\n6 7\n", "f");
  CHECK((marks[0].line == 2 && marks[1].line == 4 && marks[2].line == 4));
}

TEST_CASE("bad files of vertices are refused with the line") {
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "f marks no vertex"},
           {"# 1\n", "f marks no vertex"},
           {"vertex\n", "f marks no vertex"},
           {"1\n2\nx\n", "f, line 3: \"x\" is not the number of a vertex"},
           {"1\n-2\n", "f, line 2: \"-2\""},
           {"1.5\n", "line 1: \"1.5\""},
           {"1 0.5 0.5\n", "\"0.5\""},
           {"1 0.5 0.5 0.5\n2 1 2 3 4\n", "line 1: \"0.5\""},
           {"-1 0.5 0.5 0.5\n", "\"-1\""},
           {"1e400\n", "1e400"},
           {"inf\n", "inf"},
           {"99999999999999999999\n", "99999999999999999999"}})
    CHECK_THROWS_WITH(numbers(text), Contains(what));
}

TEST_CASE("marked vertices are those of the mesh's file, each once") {
  const core::LoadedMesh plain{test::octahedron().mesh(), {}};
  const auto found = find_marked_vertices(parse_marks("5 0 5 5 3", "f"), 0, plain, "f");
  CHECK(found.vertices == std::vector<Index>{5, 0, 3});
  CHECK(found.warnings == Texts{"f marks 2 vertices again, counted once"});
  const auto from_one = find_marked_vertices(parse_marks("6 1", "f"), 1, plain, "f");
  CHECK(from_one.vertices == std::vector<Index>{5, 0});
  CHECK(from_one.warnings.empty());
  CHECK_THROWS_WITH(find_marked_vertices(parse_marks("1\n6", "f"), 0, plain, "f"),
                    Contains("f, line 2: there is no vertex 6 in the mesh, whose vertices are 0 to 5"));
  CHECK_THROWS_WITH(find_marked_vertices(parse_marks("0", "f"), 1, plain, "f"), Contains("are 1 to 6"));

  core::LoadedMesh repaired{test::single_triangle().mesh(), {}};
  repaired.source.numbering = {5, {0, 2, 4}, {0, core::kNone, 1, 0, 2}};  // 3 is at the place of 0
  const auto kept = find_marked_vertices(parse_marks("4 0 3", "f"), 0, repaired, "f");
  CHECK(kept.vertices == std::vector<Index>{2, 0});
  CHECK(kept.warnings.size() == 1);
  CHECK_THROWS_WITH(find_marked_vertices(parse_marks("1", "f"), 0, repaired, "f"),
                    Contains("vertex 1 is used by no face"));
  CHECK_THROWS_WITH(find_marked_vertices(parse_marks("5", "f"), 0, repaired, "f"), Contains("are 0 to 4"));
}
