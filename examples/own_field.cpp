// own_field MESH: a field of one's own, one value a vertex, goes through the same methods as any other.

#include <cmath>
#include <cstdio>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/persistence/cancellation.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  std::vector<double> values;
  const double size = mesh.bounding_box().diagonal();
  for (core::Index v = 0; v < mesh.vertex_count(); ++v)
    values.push_back(std::sin(30 * mesh.position(v).x() / size) + std::cos(30 * mesh.position(v).y() / size));
  const core::ScalarField field(mesh, std::move(values));  // throws on a value that is not finite
  std::printf("as it is: %zu critical points\n", morse::classify(field).total());
  std::printf("smoothed: %zu\n", morse::classify(morse::salient(field, {.iterations = 5}).field).total());
  std::printf("simplified: %zu\n", morse::classify(persistence::cancel(field).field).total());
}
