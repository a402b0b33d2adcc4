#include "morsel/mscomplex/cut.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/height.h"
#include "support/adversarial.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/plain_shortening.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::cut_open;
using mscomplex::CutGraph;
using mscomplex::CutMesh;
using mscomplex::CutPath;
using mscomplex::find_cut;
using mscomplex::glue;
using mscomplex::MorseSmaleComplex;
using mscomplex::shorten;
using mscomplex::ShortenedCut;

namespace {

CutGraph cut_by(const ScalarField& field) { return find_cut(MorseSmaleComplex(field), field); }

bool same_bits(const CutGraph& a, const CutGraph& b) {
  return a.edges == b.edges && a.length == b.length &&
         std::equal(a.paths.begin(), a.paths.end(), b.paths.begin(), b.paths.end(),
                    [](const CutPath& p, const CutPath& q) {
                      return p.vertices == q.vertices && p.length == q.length && p.component == q.component;
                    });
}

/// That gluing gives the mesh back, bit by bit.
void check_glued(const TriangleMesh& mesh, const CutMesh& opened) {
  REQUIRE(opened.original_count() == mesh.vertex_count());
  REQUIRE(std::is_sorted(opened.copied.begin(), opened.copied.end()));
  for (Index v = 0; v < opened.mesh.vertex_count(); ++v)
    REQUIRE(opened.mesh.position(v) == mesh.position(opened.original(v)));
  const TriangleMesh glued = glue(opened);
  REQUIRE(std::equal(glued.triangles().begin(), glued.triangles().end(), mesh.triangles().begin(),
                     mesh.triangles().end()));
  REQUIRE(std::equal(glued.positions().begin(), glued.positions().end(), mesh.positions().begin(),
                     mesh.positions().end()));
}

/// Everything that holds for every cut; returns the shortened one.
ShortenedCut check_cut(const ScalarField& field) {
  const TriangleMesh& mesh = field.mesh();
  const CutGraph cut = cut_by(field);
  cut.validate(mesh);
  check_glued(mesh, cut_open(mesh, cut.edges));
  ShortenedCut shorter = shorten(mesh, cut, {.rounds = 100});
  shorter.cut.validate(mesh);
  check_glued(mesh, cut_open(mesh, shorter.cut.edges));
  REQUIRE(shorter.is_settled);
  REQUIRE(shorter.cut.length <= cut.length);
  REQUIRE((shorter.replaced > 0) == (shorter.cut.length < cut.length));
  for (Index c = 0; c < mesh.component_count(); ++c) {
    const bool is_cut = std::any_of(cut.paths.begin(), cut.paths.end(),
                                    [&](const CutPath& path) { return path.component == c; });
    REQUIRE(is_cut == (mesh.euler_characteristic(c) != 1));
  }
  return shorter;
}

}  // namespace

TEST_CASE("cuts open every surface of the zoo into discs") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {81u, 82u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        check_cut(f.field);
      }
}

TEST_CASE("cuts open random surfaces into discs") {
  for (unsigned seed = 0; seed < 600; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    check_cut({mesh, random_values(mesh.vertex_count(), seed)});
    check_cut({mesh, tied_values(mesh.vertex_count(), 3, seed)});
  }
}

TEST_CASE("cuts open surfaces of genus 0 to 5") {
  for (int genus = 0; genus <= 5; ++genus) {
    INFO("genus " << genus);
    const TriangleMesh mesh = (genus == 0 ? sphere(3) : pierced_slab(genus)).mesh();
    REQUIRE(mesh.genus() == static_cast<Index>(genus));
    for (const NamedField& f : field_zoo(mesh, 83)) {
      INFO(f.name);
      check_cut(f.field);
    }
  }
}

TEST_CASE("a sphere is cut along two edges or more") {
  const auto z_of = [](const TriangleMesh& mesh) {
    std::vector<double> z;
    for (const core::Point& p : mesh.positions()) z.push_back(p.z());
    return z;
  };
  SECTION("from pole to pole") {
    const TriangleMesh mesh = octahedron().mesh();
    const CutGraph cut = cut_by({mesh, z_of(mesh)});
    REQUIRE(cut.paths.size() == 1);
    CHECK(cut.paths[0].vertices == std::vector<Index>{0, 2, 1});
    CHECK(cut.length == Approx(2 * std::sqrt(2.0)));
    const CutMesh opened = cut_open(mesh, cut.edges);
    CHECK(opened.copied == std::vector<Index>{2});
  }
  SECTION("where the lowest and the highest vertex are neighbours") {
    const TriangleMesh mesh = tetrahedron().mesh();
    const CutGraph cut = cut_by({mesh, {0, 1, 2, 3}});
    REQUIRE(cut.paths.size() == 1);
    REQUIRE(cut.paths[0].vertices.size() == 3);
    CHECK(cut.paths[0].vertices.front() == 0);
    CHECK(cut.paths[0].vertices.back() == 3);
    CHECK(cut_open(mesh, cut.edges).mesh.vertex_count() == 5);
  }
}

TEST_CASE("the smallest torus is cut open") {
  // Möbius' torus of seven vertices, each a neighbour of all others, in an arbitrary shape.
  Soup soup;
  for (int i = 0; i < 7; ++i) soup.positions.emplace_back(std::cos(i * i), std::sin(3.0 * i), 0.1 * i);
  for (Index i = 0; i < 7; ++i) {
    soup.triangles.push_back({i, (i + 1) % 7, (i + 3) % 7});
    soup.triangles.push_back({i, (i + 3) % 7, (i + 2) % 7});
  }
  const TriangleMesh mesh = soup.mesh();
  REQUIRE(mesh.genus() == 1);
  for (unsigned seed = 0; seed < 50; ++seed) {
    INFO("seed " << seed);
    check_cut({mesh, random_values(7, seed)});
  }
}

TEST_CASE("a disc is not cut") {
  const TriangleMesh mesh = grid(7, 5).mesh();
  const CutGraph cut = cut_by({mesh, random_values(mesh.vertex_count(), 3)});
  CHECK(cut.edges.empty());
  CHECK(cut_open(mesh, cut.edges).copied.empty());
}

TEST_CASE("an annulus is cut along a shortest path between its loops") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Soup soup = annulus(9, 5);
    for (std::size_t i = 0; const double x : random_values(soup.positions.size(), seed))
      soup.positions[i++] *= 1 + 0.3 * x;
    const TriangleMesh mesh = soup.mesh();
    // Bellman and Ford: lengths of paths from the first loop.
    std::vector<double> distance(mesh.vertex_count(), 1e9);
    for (const Index h : mesh.boundary_loop(0)) distance[mesh.origin(h)] = 0;
    for (Index round = 0; round < mesh.vertex_count(); ++round)
      for (Index e = 0; e < mesh.edge_count(); ++e) {
        const auto [a, b] = mesh.edge_vertices(e);
        const double length = (mesh.position(a) - mesh.position(b)).norm();
        distance[a] = std::min(distance[a], distance[b] + length);
        distance[b] = std::min(distance[b], distance[a] + length);
      }
    double shortest = 1e9;
    for (const Index h : mesh.boundary_loop(1)) shortest = std::min(shortest, distance[mesh.origin(h)]);
    const CutGraph cut = check_cut({mesh, random_values(mesh.vertex_count(), seed + 1)}).cut;
    CHECK(cut.paths.size() == 1);
    CHECK(cut.length == Approx(shortest).epsilon(1e-12));
  }
}

namespace {

/// Whether cutting along these edges makes a disc of each component.
bool opens(const TriangleMesh& mesh, const std::vector<Index>& edges) {
  const TriangleMesh opened = cut_open(mesh, edges).mesh;
  if (opened.component_count() != mesh.component_count()) return false;
  for (Index c = 0; c < opened.component_count(); ++c)
    if (opened.euler_characteristic(c) != 1) return false;
  return true;
}

/// Tries all paths of edges that are shorter than `bound`, in place of a path that was taken out of a cut.
class EveryPath {
 public:
  EveryPath(const TriangleMesh& mesh, std::vector<Index> rest, double bound)
      : mesh_(mesh), rest_(std::move(rest)), bound_(bound), is_rim_(mesh.vertex_count(), false) {
    for (const Index e : rest_)
      for (const Index v : mesh.edge_vertices(e)) is_rim_[v] = true;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.is_boundary_vertex(v)) is_rim_[v] = true;
    is_used_ = is_rim_;
  }
  bool one_opens() {
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (is_rim_[v] && extend(v, 0)) return true;
    return false;
  }

 private:
  bool extend(Index v, double length) {
    for (Index e = 0; e < mesh_.edge_count(); ++e) {
      const auto [a, b] = mesh_.edge_vertices(e);
      if ((a != v && b != v) || mesh_.is_boundary_edge(e)) continue;
      if (std::find(rest_.begin(), rest_.end(), e) != rest_.end()) continue;
      const Index w = a == v ? b : a;
      const double longer = length + (mesh_.position(a) - mesh_.position(b)).norm();
      if (longer >= bound_ * (1 - 1e-9) || (is_used_[w] && !is_rim_[w])) continue;
      if (std::find(path_.begin(), path_.end(), e) != path_.end()) continue;
      path_.push_back(e);
      bool found = false;
      if (is_rim_[w]) {
        std::vector<Index> edges = rest_;
        edges.insert(edges.end(), path_.begin(), path_.end());
        found = opens(mesh_, edges);
      } else {
        is_used_[w] = true;
        found = extend(w, longer);
        is_used_[w] = false;
      }
      path_.pop_back();
      if (found) return true;
    }
    return false;
  }

  const TriangleMesh& mesh_;
  std::vector<Index> rest_;
  double bound_;
  std::vector<bool> is_rim_;
  std::vector<bool> is_used_;
  std::vector<Index> path_;
};

/// Whether some path of the cut could be replaced by a shorter one.
bool can_be_shorter(const TriangleMesh& mesh, const CutGraph& cut) {
  for (const CutPath& path : cut.paths) {
    std::vector<Index> rest;
    for (const Index e : cut.edges) {
      const auto [a, b] = mesh.edge_vertices(e);
      bool is_in_path = false;
      for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
        const Index v = path.vertices[i], w = path.vertices[i + 1];
        is_in_path = is_in_path || (v == a && w == b) || (v == b && w == a);
      }
      if (!is_in_path) rest.push_back(e);
    }
    if (EveryPath(mesh, rest, path.length).one_opens()) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("no path of a shortened cut can be replaced by a shorter one") {
  int cuts = 0, shortened = 0;
  const auto check = [&](const TriangleMesh& mesh, unsigned seed) {
    const ScalarField field(mesh, random_values(mesh.vertex_count(), seed));
    const CutGraph cut = cut_by(field);
    const ShortenedCut shorter = shorten(mesh, cut);
    REQUIRE(shorter.is_settled);
    CHECK_FALSE(can_be_shorter(mesh, shorter.cut));
    CHECK(can_be_shorter(mesh, cut) == (shorter.replaced > 0));
    ++cuts;
    if (shorter.replaced > 0) ++shortened;
  };
  unsigned seed = 0;
  while (cuts < 40) {
    ++seed;
    const TriangleMesh mesh = random_surface(seed);
    const long euler = mesh.euler_characteristic();
    if (mesh.vertex_count() > 24 || euler > 0) continue;  // mostly tori, with holes and without, and annuli
    INFO("seed " << seed);
    check(mesh, seed);
  }
  CHECK(shortened > 10);
}

TEST_CASE("a shortened cut is that of decomposing the whole cut again after each change") {
  std::size_t replaced = 0;
  const auto check = [&](const ScalarField& field) {
    const CutGraph cut = cut_by(field);
    for (const int rounds : {1, 2, 100}) {
      const ShortenedCut fast = shorten(field.mesh(), cut, {.rounds = rounds});
      const ShortenedCut slow = plain_shorten(field.mesh(), cut, rounds);
      REQUIRE(same_bits(fast.cut, slow.cut));
      REQUIRE(fast.attempts == slow.attempts);
      REQUIRE(fast.replaced == slow.replaced);
      REQUIRE(fast.is_settled == slow.is_settled);
      replaced += fast.replaced;
    }
  };
  for (unsigned seed = 0; seed < 400; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    check({mesh, random_values(mesh.vertex_count(), seed)});
    check({mesh, tied_values(mesh.vertex_count(), 3, seed)});
  }
  for (const Soup& soup :
       {pierced_slab(5), punctured_sphere(4, 9), together(pierced_slab(2), pierced_slab(3)),
        together(torus(12, 8), together(octahedron(), annulus(9, 4)))})
    for (const NamedField& f : field_zoo(soup.mesh(), 86)) check(f.field);
  CHECK(replaced > 1000);
}

TEST_CASE("cutting a hundred thousand tetrahedra takes near-linear time") {
  constexpr Index kCount = 100000;
  const TriangleMesh mesh = adversarial::tetrahedra(kCount);
  const CutGraph cut = cut_by({mesh, random_values(mesh.vertex_count(), 87)});
  const ShortenedCut shorter = shorten(mesh, cut);
  CHECK(shorter.is_settled);
  CHECK(shorter.attempts == kCount);
  CHECK(shorter.cut.paths.size() == kCount);
  CHECK(cut_open(mesh, shorter.cut.edges).copied.size() == kCount);
}

TEST_CASE("a cut of hundreds of paths is shortened as by decomposing it each time") {
  const TriangleMesh mesh = adversarial::pierced_sheet(400);
  REQUIRE(mesh.boundary_loop_count() == 401);
  const CutGraph cut = cut_by({mesh, random_values(mesh.vertex_count(), 89)});
  const ShortenedCut shorter = shorten(mesh, cut);
  CHECK(shorter.is_settled);
  CHECK(shorter.replaced > 100);
  CHECK(same_bits(shorter.cut, plain_shorten(mesh, cut, 16).cut));
  CHECK(cut_open(mesh, shorter.cut.edges).mesh.boundary_loop_count() == 1);
}

TEST_CASE("shortening can be stopped") {
  const TriangleMesh mesh = pierced_slab(3).mesh();
  const CutGraph cut = cut_by({mesh, random_values(mesh.vertex_count(), 5)});
  const ShortenedCut once = shorten(mesh, cut, {.rounds = 1});
  CHECK(once.attempts == cut.paths.size());
  CHECK_FALSE(once.is_settled);
  once.cut.validate(mesh);
  const ShortenedCut all = shorten(mesh, cut, {.rounds = 100});
  CHECK(all.is_settled);
  const ShortenedCut again = shorten(mesh, all.cut);
  CHECK(again.replaced == 0);
  CHECK(same_bits(again.cut, all.cut));
}

TEST_CASE("cuts are the same for every number of threads") {
  const TriangleMesh mesh = together(punctured_sphere(4, 5), torus(40, 60)).mesh();
  for (const NamedField& f : field_zoo(mesh, 84)) {
    INFO(f.name);
    const auto cut_with = [&](int threads) {
      core::ThreadLimit limit(threads);
      return shorten(mesh, cut_by(f.field)).cut;
    };
    const CutGraph one = cut_with(1);
    for (const int threads : {2, 7}) CHECK(same_bits(one, cut_with(threads)));
  }
}

TEST_CASE("any set of edges can be cut but a lone one inside") {
  const TriangleMesh mesh = octahedron().mesh();
  const auto edge = [&](Index a, Index b) {
    for (Index e = 0; e < mesh.edge_count(); ++e)
      if (mesh.edge_vertices(e) == std::array{a, b} || mesh.edge_vertices(e) == std::array{b, a}) return e;
    return core::kNone;
  };
  // The equator separates it into two.
  const std::vector<Index> equator = {edge(2, 3), edge(3, 4), edge(4, 5), edge(5, 2)};
  const CutMesh halves = cut_open(mesh, equator);
  CHECK(halves.mesh.component_count() == 2);
  CHECK(halves.copied == std::vector<Index>{2, 3, 4, 5});
  check_glued(mesh, halves);
  // All edges: eight triangles apart. An edge may be named twice.
  std::vector<Index> all(mesh.edge_count());
  std::iota(all.begin(), all.end(), Index{0});
  all.push_back(0);
  const CutMesh apart = cut_open(mesh, all);
  CHECK(apart.mesh.component_count() == 8);
  CHECK(apart.mesh.vertex_count() == 24);
  check_glued(mesh, apart);

  CHECK_THROWS_AS(cut_open(mesh, {edge(0, 2)}), core::InvalidArgument);
  CHECK_THROWS_AS(cut_open(mesh, {mesh.edge_count()}), core::InvalidArgument);
  CHECK_THROWS_AS(cut_open(square_pair().mesh(), {0, 1, 2, 3, 4}), core::InvalidArgument);
  // Between two boundary vertices a single edge does open.
  const TriangleMesh square = square_pair().mesh();
  for (Index e = 0; e < square.edge_count(); ++e)
    if (!square.is_boundary_edge(e)) CHECK(cut_open(square, {e}).mesh.component_count() == 2);
}

TEST_CASE("cuts refuse what does not fit together") {
  const ScalarField field(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  const ScalarField other(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  CHECK_THROWS_AS(find_cut(MorseSmaleComplex(field), other), core::InvalidArgument);
  const CutGraph cut = cut_by(field);
  CHECK_THROWS_AS(shorten(field.mesh(), cut, {.rounds = 0}), core::InvalidArgument);
  CHECK_THROWS_AS(shorten(single_triangle().mesh(), cut), core::InvalidArgument);
}

TEST_CASE("validate() detects what is not a cut") {
  const TriangleMesh mesh = torus(8, 9).mesh();
  const CutGraph cut = cut_by({mesh, random_values(mesh.vertex_count(), 6)});
  CutGraph broken = cut;
  broken.edges.pop_back();
  CHECK_THROWS_AS(broken.validate(mesh), std::logic_error);
  broken = cut;
  broken.length += 1;
  CHECK_THROWS_AS(broken.validate(mesh), std::logic_error);
  CHECK_THROWS_AS(CutGraph{}.validate(mesh), std::logic_error);
}

TEST_CASE("real surfaces are cut open") {
  const auto check = [](const std::string& name, double found, double shortened) {
    INFO(name);
    const TriangleMesh mesh = core::read_mesh(sample(name)).mesh;
    const ScalarField field = morse::height(mesh);
    CHECK(cut_by(field).length == Approx(found).epsilon(1e-4));
    CHECK(check_cut(field).cut.length == Approx(shortened).epsilon(1e-4));
  };
  check("bunny00.off", 1.21393, 1.21393);           // genus 0
  check("refined_elephant.off", 3.97331, 1.92795);  // genus 3
  check("lion-head.off", 0, 0);                     // a disc
}
