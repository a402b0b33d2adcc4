#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "morsel/mscomplex/hierarchy.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/html/arc_paths.h"
#include "morsel/tools/html/arc_reach.h"
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

/// The straight pieces of the polylines, each with its reach: read as the page reads them.
std::multimap<Piece, double> drawn(const TriangleMesh& mesh, const ArcPaths& paths, mscomplex::ArcKind kind) {
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
    for (std::size_t i = 1; i < line.size(); ++i) pieces.emplace(piece(line[i - 1], line[i]), paths.reach[p]);
  }
  REQUIRE(first == paths.cells.size());
  return pieces;
}

/// The pieces of all arcs as the complex traces them.
std::set<Piece> traced(const mscomplex::MorseSmaleComplex& complex, mscomplex::ArcKind kind) {
  std::set<Piece> pieces;
  std::vector<Point> line;
  for (Index arc = 0; arc < complex.arc_count(); ++arc) {
    if (mscomplex::MorseSmaleComplex::arc_kind(arc) != kind) continue;
    complex.trace(arc, line);
    for (std::size_t i = 1; i < line.size(); ++i) pieces.insert(piece(line[i - 1], line[i]));
  }
  return pieces;
}

/// Pieces without a direction, and without those that end at one of `left_out`.
template <class Pieces>
std::set<Piece> compared(const Pieces& pieces, const std::set<std::array<double, 3>>& left_out) {
  std::set<Piece> result;
  for (const Piece& p : pieces) {
    std::array<double, 3> a = {p[0], p[1], p[2]}, b = {p[3], p[4], p[5]};
    if (left_out.count(a) > 0 || left_out.count(b) > 0) continue;
    if (b < a) std::swap(a, b);
    result.insert({a[0], a[1], a[2], b[0], b[1], b[2]});
  }
  return result;
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

ArcPaths paths_of(const mscomplex::PersistenceHierarchy& hierarchy, mscomplex::ArcKind kind) {
  const std::vector<double> reach = tools::html::arc_reach(hierarchy, kind);
  return kind == mscomplex::ArcKind::descending ? tools::html::descending_paths(hierarchy.complex(), reach)
                                                : tools::html::ascending_paths(hierarchy.complex(), reach);
}

/// At level 0 the pieces are those of the complex, each once.
void check_paths(const mscomplex::PersistenceHierarchy& hierarchy) {
  for (const auto kind : {mscomplex::ArcKind::descending, mscomplex::ArcKind::ascending}) {
    const auto got = drawn(hierarchy.complex().mesh(), paths_of(hierarchy, kind), kind);
    const std::set<Piece> expected = traced(hierarchy.complex(), kind);
    REQUIRE(got.size() == expected.size());
    REQUIRE(std::equal(got.begin(), got.end(), expected.begin(),
                       [](const auto& one, const Piece& other) { return one.first == other; }));
  }
}

/// The saddles whose arcs of a kind those of a level are concatenated of, followed arc by arc.
std::set<Index> concatenated(const mscomplex::PersistenceHierarchy& hierarchy, mscomplex::ArcKind kind,
                             Index level) {
  std::map<Index, Index> cancelled_by;  // node of an extremum: cancellation
  std::vector<Index> turn(hierarchy.complex().saddle_count(), core::kNone);
  for (Index i = 0; i < hierarchy.cancellations().size(); ++i) {
    cancelled_by[hierarchy.cancellations()[i].extremum] = i;
    turn[hierarchy.cancellations()[i].arc / 4] = i;
  }
  std::set<Index> used;
  const std::function<void(Index, Index)> follow = [&](Index saddle, Index time) {
    used.insert(saddle);
    for (Index arc = 4 * saddle; arc < 4 * saddle + 4; ++arc) {
      if (mscomplex::MorseSmaleComplex::arc_kind(arc) != kind) continue;
      Index end = hierarchy.complex().arc_end(arc);
      for (auto at = cancelled_by.find(end); at != cancelled_by.end() && at->second < time;
           at = cancelled_by.find(end)) {
        const mscomplex::Cancellation& c = hierarchy.cancellations()[at->second];
        follow(c.arc / 4, at->second);
        end = c.survivor;
      }
      REQUIRE(end == hierarchy.arc_end(arc, time));
    }
  };
  for (Index s = 0; s < turn.size(); ++s)
    if (turn[s] == core::kNone || turn[s] >= level) follow(s, level);
  return used;
}

/// Above a threshold the arcs are those that a level's are concatenated of, and along them run those of the
/// complex in the gradient with cancelled V-paths turned round; but for the last steps to what is cancelled,
/// where ascending lines go by the saddle's vertex instead of the middle of its edge.
void check_level(const core::ScalarField& field, const mscomplex::PersistenceHierarchy& hierarchy,
                 double threshold) {
  const TriangleMesh& mesh = field.mesh();
  const Index level = hierarchy.level_above(threshold);
  const mscomplex::MorseSmaleComplex simple(field, hierarchy.gradient(level));
  std::set<std::array<double, 3>> cancelled;
  const auto add = [&](const Point& p) { cancelled.insert({p[0], p[1], p[2]}); };
  for (Index i = 0; i < level; ++i) {
    const mscomplex::Cancellation& c = hierarchy.cancellations()[i];
    const mscomplex::CriticalCell& saddle = hierarchy.complex().gradient().saddles()[c.arc / 4];
    const auto ends = mesh.edge_vertices(saddle.cell);
    add(mesh.position(saddle.vertex));
    add((mesh.position(ends[0]) + mesh.position(ends[1])) / 2);
    if (mscomplex::MorseSmaleComplex::arc_kind(c.arc) == mscomplex::ArcKind::ascending)
      add(mesh.position(hierarchy.complex().node(c.extremum).vertex));
  }
  for (const auto kind : {mscomplex::ArcKind::descending, mscomplex::ArcKind::ascending}) {
    const std::vector<double> reach = tools::html::arc_reach(hierarchy, kind);
    std::set<Index> reaching;
    for (Index s = 0; s < reach.size(); ++s)
      if (reach[s] > threshold) reaching.insert(s);
    REQUIRE(reaching == concatenated(hierarchy, kind, level));

    std::set<Piece> shown;
    for (const auto& [p, until] : drawn(mesh, paths_of(hierarchy, kind), kind))
      if (until > threshold) shown.insert(p);
    const std::set<std::array<double, 3>> none;
    const auto& left_out = kind == mscomplex::ArcKind::ascending ? cancelled : none;
    const std::set<Piece> got = compared(shown, left_out),
                          expected = compared(traced(simple, kind), left_out);
    REQUIRE(std::includes(got.begin(), got.end(), expected.begin(), expected.end()));
  }
}

void check_levels(const core::ScalarField& field) {
  const mscomplex::PersistenceHierarchy hierarchy(field);
  check_paths(hierarchy);
  const std::size_t count = hierarchy.cancellations().size();
  for (const std::size_t i : {count / 4, count / 2, count - count / 8})
    if (i < count) check_level(field, hierarchy, hierarchy.cancellations()[i].persistence);
  check_level(field, hierarchy, std::numeric_limits<double>::max());
}

}  // namespace

TEST_CASE(
    "a page's polylines are the arcs, each piece once, and above a threshold those of the cancelled "
    "complex") {
  for (const auto& [mesh_name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 7)) {
      INFO(mesh_name << ", " << field_name);
      check_paths(mscomplex::PersistenceHierarchy(field));
    }
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TriangleMesh mesh = in_general_position(random_surface(seed), seed);
    INFO("random surface " << seed);
    check_levels({mesh, random_values(mesh.vertex_count(), seed)});
    check_levels({mesh, tied_values(mesh.vertex_count(), 3, seed)});
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
