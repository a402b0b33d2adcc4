#include "morsel/mscomplex/cut.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/mesh_io.h"
#include "morsel/core/parallel.h"
#include "morsel/morse/functions/height.h"
#include "support/fields.h"
#include "support/meshes.h"
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
