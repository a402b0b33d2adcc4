// Checks of layouts and quad meshes.

#include <algorithm>

#include "morsel/core/require.h"
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
  require(surface.euler_characteristic() ==
              complex.mesh().euler_characteristic() + long{complex.mesh().boundary_loop_count()},
          "Euler characteristic of surface", 0);
  std::vector<bool> used(surface.vertex_count(), false);
  for (const Index v : node_vertex) {
    require(!used[v], "two nodes at one vertex", v);
    used[v] = true;
  }
  std::vector<Index> arc_of_halfedge(surface.halfedge_count(), kNone);
  std::vector<Index> cap_at(surface.vertex_count(), kNone);  // per vertex on a rim
  std::vector<bool> is_rim(surface.halfedge_count(), false);
  for (Index k = 0; k < complex.cap_count(); ++k)
    surface.for_each_outgoing(node_vertex[complex.cap_node(k)], [&](Index h) {
      cap_at[surface.target(h)] = complex.cap_node(k);
      is_rim[TriangleMesh::next(h)] = is_rim[surface.twin(TriangleMesh::next(h))] = true;
      require(patch_of_triangle[TriangleMesh::triangle_of(h)] == kNone, "a patch in a cap's fan", k);
    });
  for (Index a = 0; a < complex.arc_count(); ++a) {
    const auto& arc = arcs[a];
    const Index end = complex.arc_end(a);
    require(arc.size() >= 2 && arc.front() == node_vertex[complex.arc_saddle(a)], "start of arc", a);
    if (is_cap(end)) {
      require(cap_at[arc.back()] == end && !used[arc.back()], "end of arc at a rim; arc", a);
      used[arc.back()] = true;
    } else {
      require(arc.back() == node_vertex[end], "end of arc", a);
    }
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
      if (!is_cap(n)) {
        if (arc_of_halfedge[h] != kNone) found.push_back(arc_of_halfedge[h]);
        return;
      }
      for (const Index a : expected)
        if (arcs[a].back() == surface.target(h)) found.push_back(a);
    });
    require(found.size() == expected.size() && !found.empty(), "arcs at node", n);
    const auto start = std::find(found.begin(), found.end(), expected.front());
    std::rotate(found.begin(), start, found.end());
    require(found == expected, "cyclic order of arcs at node", n);
  }
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    if (arc_of_halfedge[h] == kNone && !is_rim[h])
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

void validate(const QuadMesh& quads, long euler_characteristic, Index boundary_loops) {
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
  for (std::size_t i = 1; i < sides.size(); ++i)
    require(order(sides[i - 1], sides[i]), "two quads on one side of an edge: quad", sides[i].quad);
  constexpr auto kNowhere = static_cast<std::size_t>(-1);
  const auto find = [&](Index from, Index to) {
    const auto found = std::lower_bound(sides.begin(), sides.end(), Side{from, to, 0}, order);
    const bool there = found != sides.end() && found->from == from && found->to == to;
    return there ? static_cast<std::size_t>(found - sides.begin()) : kNowhere;
  };

  // The quads around a vertex are one fan, from the boundary on if it is there, or one cycle.
  std::vector<bool> seen(vertices, false);
  std::vector<bool> walked(sides.size(), false);
  const auto walk_round = [&](std::size_t start) {
    const Index v = sides[start].from;
    require(!seen[v], "two fans of quads at vertex", v);
    seen[v] = true;
    for (std::size_t k = start; k != kNowhere && !walked[k];) {
      walked[k] = true;
      const auto& corners = quads.quads[sides[k].quad];
      const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
      k = find(v, corners[(at + 3) % 4]);
    }
  };
  std::vector<std::size_t> boundary(vertices,
                                    kNowhere);  // per vertex: the side that leaves it along the boundary
  long boundary_sides = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (find(sides[i].to, sides[i].from) == kNowhere) {
      boundary[sides[i].from] = i;
      ++boundary_sides;
      walk_round(i);
    }
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!walked[i]) walk_round(i);
  for (Index v = 0; v < vertices; ++v) require(seen[v], "in no quad: vertex", v);

  Index loops = 0;
  for (Index v = 0; v < vertices; ++v) {
    if (boundary[v] == kNowhere) continue;
    ++loops;
    for (Index u = v; boundary[u] != kNowhere;) {
      const Index next = sides[boundary[u]].to;
      boundary[u] = kNowhere;
      u = next;
    }
  }
  require(loops == boundary_loops, "boundary loops:", loops);
  const long edges = (static_cast<long>(sides.size()) + boundary_sides) / 2;
  require(long{vertices} - edges + long{count} == euler_characteristic, "Euler characteristic");
}

}  // namespace morsel::mscomplex
