#include <cstdio>

#include "morsel/core/mesh.h"
#include "morsel/core/scalar_field.h"
#include "morsel/morse/critical_points.h"

using namespace morsel;

int main() {
  // An octahedron, its height along z.
  const core::TriangleMesh mesh(
      {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
      {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {1, 3, 2}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5}});
  std::vector<double> height;
  for (const core::Point& p : mesh.positions()) height.push_back(p.z());
  const core::ScalarField field(mesh, height);
  for (const morse::CriticalPoint& p : morse::classify(field).points)
    std::printf("vertex %u: %s\n", p.vertex, std::string(to_string(p.type)).c_str());
}
