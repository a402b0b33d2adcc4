#include "morsel/mscomplex/quads/capped_surface.h"

#include <utility>

namespace morsel::mscomplex {

using core::Index;
using core::Point;
using core::TriangleMesh;

namespace {

/// How far a boundary vertex is moved towards the middle of its triangles.
constexpr double kCollar = 0.2;

/// The direction along the edge in the middle of v's fan, or through its middle triangle.
Point moved_inside(const TriangleMesh& mesh, Index v) {
  std::vector<Index> ring;
  mesh.neighbors(v, ring);
  const std::size_t half = ring.size() / 2;
  const Point to = ring.size() % 2 == 1
                       ? mesh.position(ring[half])
                       : Point((mesh.position(ring[half - 1]) + mesh.position(ring[half])) / 2);
  return mesh.position(v) + kCollar * (to - mesh.position(v));
}

}  // namespace

CappedSurface cap(const TriangleMesh& mesh) {
  if (mesh.is_closed()) return {mesh, {}};
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<core::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  std::vector<core::Triangle> fans;
  std::vector<Index> cap_vertex;
  std::vector<Point> middles;
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k) {
    const auto loop = mesh.boundary_loop(k);
    const auto first = static_cast<Index>(positions.size());
    Point middle = Point::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index v = mesh.origin(loop[i]);
      positions.push_back(mesh.position(v));
      positions[v] = moved_inside(mesh, v);
      middle += mesh.position(v) / static_cast<double>(loop.size());
      // Across the half-edge v → w, seen from outside: w, v and their copies.
      const Index w = mesh.target(loop[i]);
      const auto rim_v = static_cast<Index>(first + i);
      const auto rim_w = static_cast<Index>(first + (i + 1) % loop.size());
      triangles.push_back({w, v, rim_v});
      triangles.push_back({w, rim_v, rim_w});
      fans.push_back({rim_w, rim_v, k});
    }
    middles.push_back(middle);
  }
  for (const Point& middle : middles) {
    cap_vertex.push_back(static_cast<Index>(positions.size()));
    positions.push_back(middle);
  }
  for (const core::Triangle& t : fans) triangles.push_back({t[0], t[1], cap_vertex[t[2]]});
  return {TriangleMesh(std::move(positions), std::move(triangles)), std::move(cap_vertex)};
}

}  // namespace morsel::mscomplex
