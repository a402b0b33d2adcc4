#include "morsel/morse/operators/unit_size.h"

#include <cmath>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

UnitSized unit_sized(const core::TriangleMesh& mesh) {
  const core::BoundingBox& box = mesh.bounding_box();
  const double side = (box.max - box.min).maxCoeff();
  const int exponent = side > 0 ? std::ilogb(side) : 0;
  if (exponent == 0) return {mesh, 0};
  std::vector<core::Point> positions(mesh.vertex_count());
  core::parallel_for_each(positions.size(), [&](std::size_t v) {
    for (int axis = 0; axis < 3; ++axis)
      positions[v][axis] = std::ldexp(mesh.position(static_cast<core::Index>(v))[axis], -exponent);
  });
  return {mesh.with_positions(std::move(positions)), exponent};
}

}  // namespace morsel::morse
