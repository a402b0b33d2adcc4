#include "morsel/tools/html/arc_paths.h"

#include <algorithm>
#include <numeric>

#include "morsel/core/parallel/stop.h"

namespace morsel::tools::html {
namespace {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// The saddles by falling reach; equal ones in the complex's order.
std::vector<Index> by_falling_reach(std::span<const double> reach) {
  std::vector<Index> order(reach.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return reach[a] > reach[b]; });
  return order;
}

/// Which corner of the triangle the vertex is.
std::size_t corner_of(const TriangleMesh& mesh, Index triangle, Index vertex) {
  const auto& corners = mesh.triangle(triangle);
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

void close_path(ArcPaths& paths, Index saddle, double reach, std::size_t first_cell, std::uint8_t end) {
  paths.saddle.push_back(saddle);
  paths.reach.push_back(reach);
  paths.length.push_back(static_cast<std::uint32_t>(paths.cells.size() - first_cell));
  paths.end.push_back(end);
}

}  // namespace

ArcPaths descending_paths(const mscomplex::MorseSmaleComplex& complex, std::span<const double> reach) {
  const mscomplex::DiscreteGradient& gradient = complex.gradient();
  ArcPaths paths;
  std::vector<bool> walked(complex.mesh().vertex_count(), false);  // from the vertex down
  for (const Index i : by_falling_reach(reach)) {
    core::throw_if_stopped();
    const mscomplex::CriticalCell& saddle = gradient.saddles()[i];
    for (const Index start : complex.mesh().edge_vertices(saddle.cell)) {
      const std::size_t first = paths.cells.size();
      if (start == saddle.vertex && walked[start]) continue;  // a multiple saddle descends here once
      if (start != saddle.vertex) paths.cells.push_back(saddle.vertex);
      Index v = start;
      for (; v != kNone && !walked[v]; v = gradient.descend(v)) {
        walked[v] = true;
        paths.cells.push_back(v);
      }
      if (v != kNone) paths.cells.push_back(v);
      close_path(paths, saddle.vertex, reach[i], first, ArcPaths::kEndThere);
    }
  }
  return paths;
}

ArcPaths ascending_paths(const mscomplex::MorseSmaleComplex& complex, std::span<const double> reach) {
  const mscomplex::DiscreteGradient& gradient = complex.gradient();
  const TriangleMesh& mesh = complex.mesh();
  ArcPaths paths;
  std::vector<bool> walked(mesh.triangle_count(), false);
  std::vector<bool> begun(3 * std::size_t{mesh.triangle_count()}, false);  // by corner: from the saddle there
  std::vector<Index> top(mesh.triangle_count(), kNone);  // of critical triangles: the maximum's vertex
  for (const mscomplex::CriticalCell& maximum : gradient.maxima()) top[maximum.cell] = maximum.vertex;
  for (const Index i : by_falling_reach(reach)) {
    core::throw_if_stopped();
    const mscomplex::CriticalCell& saddle = gradient.saddles()[i];
    const Index edge_side = mesh.edge_halfedge(saddle.cell);
    for (const Index side : {edge_side, mesh.twin(edge_side)}) {
      const std::size_t first = paths.cells.size();
      std::uint8_t end = ArcPaths::kEndThere;
      if (side == kNone) {  // a boundary edge: straight into the cap
        const Index t = TriangleMesh::triangle_of(edge_side);
        paths.cells.push_back(t);
        close_path(paths, saddle.vertex, reach[i], first,
                   static_cast<std::uint8_t>(ArcPaths::kOnlySide + edge_side % 3));
        continue;
      }
      Index t = TriangleMesh::triangle_of(side);
      const std::size_t corner_of_saddle = 3 * std::size_t{t} + corner_of(mesh, t, saddle.vertex);
      if (begun[corner_of_saddle]) continue;  // two critical edges of a multiple saddle at one triangle
      begun[corner_of_saddle] = true;
      while (true) {
        paths.cells.push_back(t);
        if (walked[t]) break;
        walked[t] = true;
        const Index next = gradient.ascend(t);
        if (next != kNone) {
          t = next;
          continue;
        }
        const Index exit = gradient.paired_halfedge(t);
        if (exit != kNone) {
          end = static_cast<std::uint8_t>(ArcPaths::kEndSide + exit % 3);
        } else {
          end = static_cast<std::uint8_t>(ArcPaths::kEndCorner + corner_of(mesh, t, top[t]));
        }
        break;
      }
      close_path(paths, saddle.vertex, reach[i], first, end);
    }
  }
  return paths;
}

}  // namespace morsel::tools::html
