#include "morsel/mscomplex/quads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/morse/operators/eigenfunctions.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/quads/triangle_search.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::MorseSmaleComplex;
using mscomplex::QuadLayout;
using mscomplex::QuadMesh;

namespace {

/// Whether every vertex of the quad mesh is a point of the surface.
void check_on_surface(const QuadMesh& quads, const TriangleMesh& mesh) {
  const mscomplex::TriangleSearch surface(mesh.positions(), mesh.triangles());
  double largest = 0;
  for (const Point& p : quads.positions) largest = std::max(largest, surface.distance(p));
  CHECK(largest <= 1e-9 * mesh.bounding_box().diagonal());
}

/// All that holds for every layout and its quads. Returns whether there is a layout.
bool check_layout(const ScalarField& field, int relaxation, Index resolution) {
  const TriangleMesh& mesh = field.mesh();
  std::optional<mscomplex::RepairedComplex> repaired;
  try {
    repaired = mscomplex::repair_dangling(field, MorseSmaleComplex(field));
  } catch (const core::BadInput& e) {
    CHECK(std::string(e.what()).find("no saddle") != std::string::npos);
    return false;
  }
  const MorseSmaleComplex& complex = repaired->complex;
  complex.gradient().validate();
  CHECK(complex.saddle_count() + repaired->repairs.size() == MorseSmaleComplex(field).saddle_count());
  const QuadLayout layout = mscomplex::embed_layout(complex, {relaxation});
  layout.validate(complex);
  const QuadMesh quads = mscomplex::sample(layout, resolution);
  REQUIRE(quads.quads.size() == std::size_t{complex.quad_count()} * resolution * resolution);
  mscomplex::validate(quads, mesh.euler_characteristic());
  check_on_surface(quads, mesh);
  for (Index n = 0; n < complex.node_count(); ++n)
    REQUIRE(quads.positions[n] == layout.surface.position(layout.node_vertex[n]));
  const mscomplex::QuadQuality quality = mscomplex::measure(quads, mesh);
  REQUIRE(quality.valence.size() >= 5);
  CHECK(quality.valence[0] + quality.valence[1] == 0);
  std::size_t extraordinary = 0;
  for (Index n = 0; n < complex.node_count(); ++n)
    if (complex.kind(n) != mscomplex::NodeKind::saddle && complex.arcs_ending_at(n).size() != 4) ++extraordinary;
  CHECK(quality.extraordinary == extraordinary);
  return true;
}

}  // namespace

TEST_CASE("zoo") {
  int laid_out = 0;
  for (const NamedMesh& entry : mesh_zoo()) {
    if (!entry.mesh.is_closed()) continue;
    for (const NamedField& f : field_zoo(entry.mesh, 81))
      for (const int relaxation : {0, 1}) {
        INFO(entry.name << " | " << f.name << " | " << relaxation);
        laid_out += check_layout(f.field, relaxation, 2);
      }
  }
  CHECK(laid_out > 10);
  WARN(laid_out);
}

TEST_CASE("random") {
  int laid_out = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    if (!mesh.is_closed()) continue;
    INFO("seed " << seed);
    for (int r : {0, 2}) {
    laid_out += check_layout(ScalarField(mesh, random_values(mesh.vertex_count(), seed)), r, 3);
    laid_out += check_layout(ScalarField(mesh, smooth_values(mesh, 2, seed)), r, 3);
    }
  }
  WARN(laid_out);
}
