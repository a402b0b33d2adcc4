// What must be true of layouts and quad meshes.

#include <algorithm>

#include "morsel/core/require.h"
#include "morsel/core/union_find.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/patch.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

namespace {

Index halfedge(const TriangleMesh& mesh, Index from, Index to) {
  Index found = kNone;
  mesh.for_each_outgoing(from, [&](Index h) {
    if (mesh.target(h) == to) found = h;
  });
  return found;
}

}  // namespace

void QuadLayout::validate(const MorseSmaleComplex& complex) const {
  constexpr core::Require require("QuadLayout::validate");
  require(node_vertex.size() == complex.node_count() && arcs.size() == complex.arc_count() &&
              patches.size() == complex.quad_count() && patch_of_triangle.size() == surface.triangle_count(),
          "table sizes; arcs", static_cast<Index>(arcs.size()));
  require(surface.euler_characteristic() == complex.mesh().euler_characteristic(),
          "Euler characteristic of surface", 0);
  std::vector<bool> used(surface.vertex_count(), false);
  for (const Index v : node_vertex) {
    require(!used[v], "two nodes at one vertex", v);
    used[v] = true;
  }
  std::vector<Index> arc_of_halfedge(surface.halfedge_count(), kNone);
  for (Index a = 0; a < complex.arc_count(); ++a) {
    const auto& arc = arcs[a];
    require(arc.size() >= 2 && arc.front() == node_vertex[complex.arc_saddle(a)] &&
                arc.back() == node_vertex[complex.arc_end(a)],
            "ends of arc", a);
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
      if (i > 0) {
        require(!used[arc[i]], "arcs meet outside nodes: arc", a);
        used[arc[i]] = true;
      }
      const Index h = halfedge(surface, arc[i], arc[i + 1]);
      require(h != kNone, "no edge along arc", a);
      require(arc_of_halfedge[h] == kNone, "an edge is on two arcs: arc", a);
      arc_of_halfedge[h] = arc_of_halfedge[surface.twin(h)] = a;
    }
  }
  for (Index n = 0; n < complex.node_count(); ++n) {
    std::vector<Index> expected;
    complex.for_each_arc_around(n, [&](Index a) { expected.push_back(a); });
    std::vector<Index> found;
    surface.for_each_outgoing(node_vertex[n], [&](Index h) {
      if (arc_of_halfedge[h] != kNone) found.push_back(arc_of_halfedge[h]);
    });
    require(found.size() == expected.size() && !found.empty(), "arcs at node", n);
    const auto start = std::find(found.begin(), found.end(), expected.front());
    std::rotate(found.begin(), start, found.end());
    require(found == expected, "cyclic order of arcs at node", n);
  }
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    if (arc_of_halfedge[h] == kNone)
      require(patch_of_triangle[TriangleMesh::triangle_of(h)] ==
                  patch_of_triangle[TriangleMesh::triangle_of(surface.twin(h))],
              "a patch ends off the arcs at half-edge", h);
  const LayoutMesh mesh = labelled_surface(*this);
  DiscFinder finder(mesh);
  for (Index q = 0; q < complex.quad_count(); ++q) {
    const Quad quad = complex.quad(q);
    require(patches[q].nodes == quad.nodes && patches[q].arcs == quad.arcs, "nodes and arcs of patch", q);
    for (const Index t : find_patch(mesh, *this, q, finder).disc.triangles)
      require(t >= surface.triangle_count() || patch_of_triangle[t] == q, "triangles of patch", q);
  }
}

void validate(const QuadMesh& quads, long euler_characteristic) {
  constexpr core::Require require("validate(QuadMesh)");
  struct Side {
    Index from, to, quad;
  };
  std::vector<Side> sides;
  const auto count = static_cast<Index>(quads.quads.size());
  const auto vertices = static_cast<Index>(quads.positions.size());
  for (Index q = 0; q < count; ++q)
    for (int i = 0; i < 4; ++i) {
      const Index a = quads.quads[q][i];
      require(a < vertices, "a corner that is no vertex in quad", q);
      for (int j = 0; j < i; ++j) require(quads.quads[q][j] != a, "two corners are one vertex in quad", q);
      sides.push_back({a, quads.quads[q][(i + 1) % 4], q});
    }
  const auto order = [](const Side& a, const Side& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  };
  std::sort(sides.begin(), sides.end(), order);
  const auto across = [&](Index from, Index to) {
    return std::lower_bound(sides.begin(), sides.end(), Side{to, from, 0}, order);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& s = sides[i];
    require(i == 0 || order(sides[i - 1], s), "two quads on one side of an edge: quad", s.quad);
    const auto twin = across(s.from, s.to);
    require(twin != sides.end() && twin->from == s.to && twin->to == s.from,
            "no quad on the other side of quad", s.quad);
  }
  // The quads round a vertex are one cycle: as many as leave it.
  std::vector<bool> seen(vertices, false);
  std::vector<bool> walked(sides.size(), false);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (walked[i]) continue;
    const Index v = sides[i].from;
    require(!seen[v], "two fans of quads at vertex", v);
    seen[v] = true;
    for (std::size_t k = i; !walked[k];) {
      walked[k] = true;
      const auto& corners = quads.quads[sides[k].quad];
      const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
      k = static_cast<std::size_t>(across(corners[(at + 3) % 4], v) - sides.begin());
    }
  }
  for (Index v = 0; v < vertices; ++v) require(seen[v], "in no quad: vertex", v);
  require(long{vertices} - 2 * long{count} + long{count} == euler_characteristic, "Euler characteristic", 0);
}

}  // namespace morsel::mscomplex
