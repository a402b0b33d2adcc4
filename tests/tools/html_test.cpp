#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <map>
#include <span>
#include <vector>

#include "morsel/persistence/pairing.h"
#include "morsel/tools/html/arc_paths.h"
#include "morsel/tools/html/command_line.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using tools::html::ArcPaths;

namespace {

using Piece = std::array<double, 6>;

Piece piece(const Point& a, const Point& b) { return {a[0], a[1], a[2], b[0], b[1], b[2]}; }

/// The straight pieces of the polylines, each with its saddle's persistence: read as the page reads them.
std::multimap<Piece, double> drawn(const TriangleMesh& mesh, const ArcPaths& paths, mscomplex::ArcKind kind,
                                   const std::vector<double>& persistence) {
  const auto middle = [&](Index h) -> Point {
    return (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))) / 2;
  };
  const auto center = [&](Index t) -> Point {
    const auto& [a, b, c] = mesh.triangle(t);
    return (mesh.position(a) + mesh.position(b) + mesh.position(c)) / 3;
  };
  std::multimap<Piece, double> pieces;
  std::size_t first = 0;
  for (std::size_t p = 0; p < paths.saddle.size(); ++p) {
    const auto cells = std::span(paths.cells).subspan(first, paths.length[p]);
    first += paths.length[p];
    std::vector<Point> line;
    if (kind == mscomplex::ArcKind::descending) {
      for (const Index v : cells) line.push_back(mesh.position(v));
    } else {
      line.push_back(mesh.position(paths.saddle[p]));
      const Index end = paths.end[p];
      for (std::size_t i = 0; i < cells.size() && end < ArcPaths::kOnlySide; ++i) {
        for (Index h = 3 * cells[i]; i > 0 && h < 3 * cells[i] + 3; ++h)
          if (mesh.twin(h) != core::kNone && TriangleMesh::triangle_of(mesh.twin(h)) == cells[i - 1])
            line.push_back(middle(mesh.twin(h)));
        line.push_back(center(cells[i]));
      }
      if (end >= ArcPaths::kEndSide)
        line.push_back(middle(3 * cells.back() + (end - ArcPaths::kEndSide) % 3));
      else if (end >= ArcPaths::kEndCorner)
        line.push_back(mesh.position(mesh.triangle(cells.back())[end - ArcPaths::kEndCorner]));
    }
    for (std::size_t i = 1; i < line.size(); ++i)
      pieces.emplace(piece(line[i - 1], line[i]), persistence[paths.saddle[p]]);
  }
  REQUIRE(first == paths.cells.size());
  return pieces;
}

/// The pieces of all arcs as the complex traces them, each with the largest persistence of a saddle whose arc goes
/// there.
std::map<Piece, double> traced(const mscomplex::MorseSmaleComplex& complex, mscomplex::ArcKind kind,
                               const std::vector<double>& persistence) {
  std::map<Piece, double> pieces;
  std::vector<Point> line;
  for (Index arc = 0; arc < complex.arc_count(); ++arc) {
    if (mscomplex::MorseSmaleComplex::arc_kind(arc) != kind) continue;
    complex.trace(arc, line);
    const double own = persistence[complex.node(complex.arc_saddle(arc)).vertex];
    for (std::size_t i = 1; i < line.size(); ++i) {
      const auto at = pieces.emplace(piece(line[i - 1], line[i]), own).first;
      at->second = std::max(at->second, own);
    }
  }
  return pieces;
}

/// The same triangles with each piece of their lines in a place of its own.
TriangleMesh in_general_position(const TriangleMesh& mesh, unsigned seed) {
  const std::vector<double> values = random_values(3 * mesh.vertex_count(), seed);
  std::vector<Point> positions;
  std::vector<core::Triangle> triangles;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    positions.emplace_back(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    triangles.push_back(mesh.triangle(static_cast<Index>(t)));
  return {std::move(positions), std::move(triangles)};
}

void check_paths(const core::ScalarField& field) {
  const mscomplex::MorseSmaleComplex complex(field);
  const std::vector<double> persistence =
      persistence::vertex_persistence(persistence::pair_extrema(field), field.mesh().vertex_count());
  for (const auto kind : {mscomplex::ArcKind::descending, mscomplex::ArcKind::ascending}) {
    const ArcPaths paths = kind == mscomplex::ArcKind::descending
                               ? tools::html::descending_paths(complex, persistence)
                               : tools::html::ascending_paths(complex, persistence);
    const auto got = drawn(field.mesh(), paths, kind, persistence);
    const auto expected = traced(complex, kind, persistence);
    REQUIRE(got.size() == expected.size());
    REQUIRE(std::equal(got.begin(), got.end(), expected.begin()));
  }
}

}  // namespace

TEST_CASE(
    "a page's polylines are the arcs, each piece once, with the most persistent saddle that leads there") {
  for (const auto& [mesh_name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 7)) {
      INFO(mesh_name << ", " << field_name);
      check_paths(field);
    }
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TriangleMesh mesh = in_general_position(random_surface(seed), seed);
    INFO("random surface " << seed);
    check_paths({mesh, random_values(mesh.vertex_count(), seed)});
    check_paths({mesh, tied_values(mesh.vertex_count(), 3, seed)});
  }
}

TEST_CASE("a command line is read by a shell as the words that it was made of") {
  CHECK(tools::command_line({"morsel", "compare", "a.off", "--method", "tps:threshold=0.1%+salient"}) ==
        "morsel compare a.off --method tps:threshold=0.1%+salient");
  const std::vector<std::string> words = {"it's", "a b", "",    "$HOME `x` \\ \"", "*", "two\nlines",
                                          "~",    "-",   "\xe9"};
  const Scratch scratch;
  const std::string script =
      "printf '%s\\0' " + tools::command_line(words) + " > " + (scratch / "out").string();
  REQUIRE(std::system(("sh " + scratch.file("script", script).string()).c_str()) == 0);
  std::string expected;
  for (const std::string& word : words) expected += word + '\0';
  CHECK(contents(scratch / "out") == expected);
}
