#include "morsel/tools/export/input_numbers.h"

#include <limits>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools {

std::vector<double> by_input_vertex(const core::ScalarField& field, const core::VertexNumbering& numbering) {
  std::vector<double> result(numbering.input_count);
  core::parallel_for_each(result.size(), [&](std::size_t i) {
    const core::Index v = numbering.mesh_vertex(static_cast<core::Index>(i));
    result[i] = v == core::kNone ? std::numeric_limits<double>::quiet_NaN() : field.value(v);
  });
  return result;
}

std::vector<core::Triangle> on_input_vertices(const core::TriangleMesh& mesh,
                                              const core::VertexNumbering& numbering) {
  std::vector<core::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (core::Triangle& triangle : triangles)
    for (core::Index& v : triangle) v = numbering.input_vertex(v);
  return triangles;
}

}  // namespace morsel::tools
