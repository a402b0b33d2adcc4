// A mesh with vertices doubled along a cut, and closing it again.

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"

#include "morsel/mscomplex/cut.h"
#include "morsel/mscomplex/cutting/cut_edges.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

CutMesh cut_open(const TriangleMesh& mesh, const std::vector<Index>& edges) {
  const Walls walls(mesh, edges);
  std::vector<Index> at_cut;
  for (const Index e : edges) {
    const auto [a, b] = mesh.edge_vertices(e);
    if (walls.degree(a) == 1 && walls.degree(b) == 1)
      throw core::InvalidArgument("cannot cut along edge " + std::to_string(e) + " between vertices " +
                                  std::to_string(a) + " and " + std::to_string(b) +
                                  " alone: a cut inside a surface needs two edges or more");
    at_cut.insert(at_cut.end(), {a, b});
  }
  std::sort(at_cut.begin(), at_cut.end());
  at_cut.erase(std::unique(at_cut.begin(), at_cut.end()), at_cut.end());

  std::vector<core::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  std::vector<core::Point> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Index> copied;
  for (const Index v : at_cut) {
    // Counter-clockwise from a wall on: the first corner keeps the number, each wall starts another one.
    Index start = mesh.vertex_halfedge(v);
    while (!walls.is_wall(start)) start = mesh.next_around(start);
    Index number = v;
    Index h = start;
    do {
      if (h != start && walls.is_wall(h)) {
        number = static_cast<Index>(positions.size());
        positions.push_back(mesh.position(v));
        copied.push_back(v);
      }
      triangles[TriangleMesh::triangle_of(h)][h % 3] = number;
      h = mesh.next_around(h);
    } while (h != start && h != kNone);
  }
  return {TriangleMesh(std::move(positions), std::move(triangles)), std::move(copied)};
}

TriangleMesh glue(const CutMesh& cut) {
  std::vector<core::Triangle> triangles(cut.mesh.triangles().begin(), cut.mesh.triangles().end());
  for (core::Triangle& t : triangles)
    for (Index& v : t) v = cut.original(v);
  const auto positions = cut.mesh.positions().first(cut.original_count());
  return {{positions.begin(), positions.end()}, std::move(triangles)};
}

void CutGraph::validate(const TriangleMesh& mesh) const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::logic_error("cut graph: " + what);
  };
  require(std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()) == edges.end(),
          "edges are not ascending");
  const Walls walls(mesh, edges);
  std::vector<Index> of_paths;
  double sum = 0;
  Index before = 0;
  for (const CutPath& path : paths) {
    require(path.vertices.size() >= 2, "a path without edges");
    require(path.vertices.front() >= before, "paths are not ordered by their first vertices");
    before = path.vertices.front();
    double path_sum = 0;
    for (const Index h : halfedges_along(mesh, path.vertices)) {
      of_paths.push_back(mesh.edge(h));
      path_sum += edge_length(mesh, h);
    }
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
      const Index v = path.vertices[i];
      require(path.component == mesh.component_of_vertex(v), "a path with the wrong component");
      const bool is_end = i == 0 || i + 1 == path.vertices.size();
      require(is_end == (walls.degree(v) != 2 || mesh.is_boundary_vertex(v)),
              "a path that ends without reason or goes through a branching at vertex " + std::to_string(v));
      require(walls.degree(v) > 1 || mesh.euler_characteristic(path.component) == 2,
              "a dangling end at vertex " + std::to_string(v));
    }
    require(path.length == path_sum, "a path's length is not that of its edges");
    sum += path.length;
  }
  require(length == sum, "the length is not that of the paths");
  std::sort(of_paths.begin(), of_paths.end());
  require(of_paths == edges, "the paths are not made of the edges");

  const CutMesh opened = cut_open(mesh, edges);
  opened.mesh.validate();
  require(opened.mesh.component_count() == mesh.component_count(), "the surface falls apart");
  for (Index c = 0; c < opened.mesh.component_count(); ++c)
    require(opened.mesh.euler_characteristic(c) == 1 && opened.mesh.boundary_loop_count(c) == 1,
            "component " + std::to_string(c) + " is no disc: Euler characteristic " +
                std::to_string(opened.mesh.euler_characteristic(c)) + ", boundary loops " +
                std::to_string(opened.mesh.boundary_loop_count(c)));
}

}  // namespace morsel::mscomplex
