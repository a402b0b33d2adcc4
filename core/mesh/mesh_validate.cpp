// The mesh's tables compared with their definitions by brute force.

#include <map>
#include <set>
#include <utility>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/require.h"

namespace morsel::core {

static constexpr Require require("TriangleMesh::validate");

void TriangleMesh::validate() const {
  require(find_defects(positions(), triangles()).empty(), "the triangles have defects");

  std::map<std::pair<Index, Index>, std::vector<Index>> by_edge;
  for (Index h = 0; h < halfedge_count(); ++h) by_edge[std::minmax(origin(h), target(h))].push_back(h);
  require(by_edge.size() == edge_count(), "edge count");
  Index e = 0;
  for (const auto& [ends, halfedges] : by_edge) {
    require(edge_halfedge(e) == halfedges.front(), "edge_halfedge of edge", e);
    for (const Index h : halfedges) require(edge(h) == e, "edge of half-edge", h);
    const bool inner = halfedges.size() == 2;
    require(twin(halfedges.front()) == (inner ? halfedges.back() : kNone), "twin at edge", e);
    require(twin(halfedges.back()) == (inner ? halfedges.front() : kNone), "twin at edge", e);
    require(is_boundary_edge(e) != inner, "boundary edge", e);
    ++e;
  }

  std::vector<std::set<Index>> around(vertex_count());
  for (Index h = 0; h < halfedge_count(); ++h) {
    around[origin(h)].insert(target(h));
    around[target(h)].insert(origin(h));
  }
  std::vector<Index> ring;
  for (Index v = 0; v < vertex_count(); ++v) {
    require(origin(vertex_halfedge(v)) == v, "half-edge of vertex", v);
    neighbors(v, ring);
    require(std::set<Index>(ring.begin(), ring.end()) == around[v] && ring.size() == around[v].size(),
            "neighbours of vertex", v);
  }

  std::set<Index> on_loops;
  Index previous_first = 0;
  for (Index k = 0; k < boundary_loop_count(); ++k) {
    const auto loop = boundary_loop(k);
    require(loop.size() >= 3, "length of loop", k);
    const Index first = origin(loop.front());
    require(k == 0 || first > previous_first, "order of loop", k);
    previous_first = first;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      require(twin(loop[i]) == kNone && target(loop[i]) == origin(loop[(i + 1) % loop.size()]),
              "half-edges of loop", k);
      require(origin(loop[i]) >= first && boundary_loop_of_vertex(origin(loop[i])) == k, "vertices of loop",
              k);
      on_loops.insert(loop[i]);
    }
  }
  long sum = 0;
  for (Index h = 0; h < halfedge_count(); ++h)
    require((twin(h) == kNone) == on_loops.contains(h), "boundary half-edge", h);
  for (Index c = 0; c < component_count(); ++c) {
    sum += euler_characteristic(c);
    require(euler_characteristic(c) == 2 - 2 * long{genus(c)} - long{boundary_loop_count(c)}, "genus");
  }
  require(sum == euler_characteristic(), "Euler characteristic of the components");
  for (Index h = 0; h < halfedge_count(); ++h)
    require(component_of_vertex(origin(h)) == component_of_vertex(target(h)), "components");
}

}  // namespace morsel::core
