#include "morsel/core/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::core {

TriangleMesh::TriangleMesh(std::vector<Point> positions, std::vector<Triangle> triangles)
    : connectivity_(connect(positions, std::move(triangles))),
      geometry_(std::make_shared<const Geometry>(std::move(positions))) {}

TriangleMesh::Geometry::Geometry(std::vector<Point> points) : positions(std::move(points)) {
  const BoundingBox none = {positions.front(), positions.front()};
  box = parallel_reduce(
      0, positions.size(), 4 * kGrain, none,
      [&](std::size_t first, std::size_t last) {
        BoundingBox part = {positions[first], positions[first]};
        for (std::size_t v = first; v < last; ++v)
          part = {part.min.cwiseMin(positions[v]), part.max.cwiseMax(positions[v])};
        return part;
      },
      [](const BoundingBox& a, const BoundingBox& b) {
        return BoundingBox{a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
      });
  if (!std::isfinite(box.diagonal()))
    throw BadInput("the mesh is too large in space: the diagonal of its bounding box overflows");
}

void TriangleMesh::neighbors(Index v, std::vector<Index>& ring) const {
  ring.clear();
  Index last = kNone;
  for_each_outgoing(v, [&](Index h) {
    ring.push_back(target(h));
    last = h;
  });
  if (is_boundary_vertex(v)) ring.push_back(apex(last));
}

long TriangleMesh::euler_characteristic() const {
  return static_cast<long>(vertex_count()) - static_cast<long>(edge_count()) +
         static_cast<long>(triangle_count());
}

Index TriangleMesh::genus(Index component) const {
  return static_cast<Index>(
      (2 - connectivity_->component_euler[component] - long{connectivity_->component_loops[component]}) / 2);
}

Index TriangleMesh::genus() const {
  Index sum = 0;
  for (Index c = 0; c < component_count(); ++c) sum += genus(c);
  return sum;
}

TriangleMesh TriangleMesh::with_positions(std::vector<Point> positions) const {
  if (positions.size() != vertex_count())
    throw InvalidArgument("this mesh needs " + std::to_string(vertex_count()) + " positions, not " +
                          std::to_string(positions.size()));
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (!positions[v].allFinite())
      throw BadInput("vertex " + std::to_string(v) + " has a non-finite position");
  return {connectivity_, std::make_shared<const Geometry>(std::move(positions))};
}

}  // namespace morsel::core
