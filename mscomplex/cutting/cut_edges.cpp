#include "morsel/mscomplex/cutting/cut_edges.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

double edge_length(const TriangleMesh& mesh, Index halfedge) {
  return (mesh.position(mesh.target(halfedge)) - mesh.position(mesh.origin(halfedge))).norm();
}

Walls::Walls(const TriangleMesh& mesh, std::span<const Index> edges)
    : mesh_(mesh), cut_(mesh.edge_count(), 0), degree_(mesh.vertex_count(), 0) {
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const Index h : mesh.boundary_loop(k)) degree_[mesh.origin(h)] = 2;
  for (const Index e : edges) {
    if (e >= mesh.edge_count())
      throw core::InvalidArgument("cannot cut along edge " + std::to_string(e) + ": the mesh has " +
                                  std::to_string(mesh.edge_count()) + " edges, numbered from 0");
    if (mesh.is_boundary_edge(e))
      throw core::InvalidArgument("cannot cut along edge " + std::to_string(e) + ": it is on the boundary");
    if (!is_cut(e)) add(e);
  }
}

std::vector<Index> halfedges_along(const TriangleMesh& mesh, std::span<const Index> vertices) {
  std::vector<Index> halfedges;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    Index found = kNone;
    mesh.for_each_outgoing(vertices[i], [&](Index h) {
      if (mesh.target(h) == vertices[i + 1]) found = h;
    });
    if (found == kNone)
      throw core::InvalidArgument("no inner edge leads from vertex " + std::to_string(vertices[i]) +
                                  " to vertex " + std::to_string(vertices[i + 1]));
    halfedges.push_back(found);
  }
  return halfedges;
}

std::vector<TracedPath> trace_paths(const TriangleMesh& mesh, std::span<const Index> edges,
                                    const std::function<bool(Index, std::size_t)>& is_end) {
  struct Side {
    Index vertex;
    Index edge;  // as a position in `edges`
    bool operator<(const Side& other) const {
      return std::pair(vertex, edge) < std::pair(other.vertex, other.edge);
    }
  };
  std::vector<Side> sides;
  sides.reserve(2 * edges.size());
  for (Index i = 0; i < edges.size(); ++i)
    for (const Index v : mesh.edge_vertices(edges[i])) sides.push_back({v, i});
  std::sort(sides.begin(), sides.end());
  std::vector<std::size_t> group_end(sides.size());  // of all sides at a vertex, per side
  for (std::size_t s = sides.size(); s-- > 0;)
    group_end[s] = s + 1 < sides.size() && sides[s + 1].vertex == sides[s].vertex ? group_end[s + 1] : s + 1;
  const auto around = [&](Index v) {
    const auto first = std::lower_bound(sides.begin(), sides.end(), Side{v, 0});
    const auto at = static_cast<std::size_t>(first - sides.begin());
    return std::span<const Side>(first, group_end[at] - at);
  };

  std::vector<TracedPath> paths;
  std::vector<std::uint8_t> is_done(edges.size(), 0);
  for (std::size_t start = 0, end = 0; start < sides.size(); start = end) {
    const Index first = sides[start].vertex;
    end = group_end[start];
    if (!is_end(first, end - start)) continue;  // in the middle of a path
    for (std::size_t s = start; s < end; ++s) {
      if (is_done[sides[s].edge] != 0) continue;
      TracedPath path;
      for (Index v = first, i = sides[s].edge;;) {
        is_done[i] = 1;
        Index h = mesh.edge_halfedge(edges[i]);
        path.length += edge_length(mesh, h);
        if (mesh.origin(h) != v) h = mesh.twin(h);
        path.halfedges.push_back(h);
        v = mesh.target(h);
        const std::span<const Side> next = around(v);
        if (is_end(v, next.size())) break;
        i = next[0].edge == i ? next[1].edge : next[0].edge;
      }
      paths.push_back(std::move(path));
    }
  }
  if (std::find(is_done.begin(), is_done.end(), 0) != is_done.end())
    throw std::logic_error("a cut has a loop that neither branches nor meets the boundary");
  return paths;
}

CutGraph make_cut_graph(const TriangleMesh& mesh, std::vector<Index> edges) {
  CutGraph graph;
  for (const TracedPath& traced : trace_paths(mesh, edges, [&](Index v, std::size_t sides) {
         return sides != 2 || mesh.is_boundary_vertex(v);
       })) {
    const Index first = mesh.origin(traced.halfedges.front());
    CutPath path{{first}, traced.length, mesh.component_of_vertex(first)};
    for (const Index h : traced.halfedges) path.vertices.push_back(mesh.target(h));
    graph.length += path.length;
    graph.paths.push_back(std::move(path));
  }
  graph.edges = std::move(edges);
  return graph;
}

}  // namespace morsel::mscomplex
