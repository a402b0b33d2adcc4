#include "morsel/mscomplex/quads/layout_mesh.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using mscomplex::LayoutMesh;

namespace {

/// A LayoutMesh but for which of the half-edges that leave a vertex is leaving().
struct State {
  explicit State(const LayoutMesh& mesh) : positions(mesh.positions()) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
      halfedges.emplace_back(mesh.origin(h), mesh.twin(h), mesh.label(h));
  }
  bool operator==(const State&) const = default;

  std::vector<Point> positions;
  std::vector<std::tuple<Index, Index, Index>> halfedges;
};

struct Split {
  bool of_edge;
  Index at;
  Index label;  // of the edge
};

}  // namespace

TEST_CASE("splits that are undone, the last first, leave each surface in between as it was") {
  for (const Soup& soup : {tetrahedron(), octahedron(), bipyramid(7), torus(5, 4)})
    for (unsigned seed = 0; seed < 5; ++seed) {
      INFO(soup.triangles.size() << " triangles, seed " << seed);
      std::mt19937 random(seed);
      LayoutMesh mesh(soup.mesh());
      for (Index h = 0; h < mesh.halfedge_count(); h += 1 + random() % 4) mesh.set_label(h, random() % 9);
      std::vector<State> before;
      std::vector<Split> splits;
      for (int i = 0; i < 100; ++i) {
        before.emplace_back(mesh);
        if (random() % 5 == 0) {
          splits.push_back({false, static_cast<Index>(random() % mesh.triangle_count()), 0});
          mesh.split_triangle(splits.back().at, {0.5, 0.3, 0.2});
        } else {
          const auto h = static_cast<Index>(random() % mesh.halfedge_count());
          splits.push_back({true, h, mesh.label(h)});
          mesh.split_edge(h, 0.3);
        }
      }
      mesh.mesh().validate();
      for (; !splits.empty(); splits.pop_back(), before.pop_back()) {
        if (splits.back().of_edge) {
          mesh.undo_split_edge(splits.back().at);
          mesh.set_label(splits.back().at, splits.back().label);  // which is the caller's
        } else {
          mesh.undo_split_triangle(splits.back().at);
        }
        REQUIRE((State(mesh) == before.back()));
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          REQUIRE(mesh.leaving(v) < mesh.halfedge_count());
          REQUIRE(mesh.origin(mesh.leaving(v)) == v);
        }
      }
    }
}
