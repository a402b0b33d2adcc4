#include "support/refinement.h"

#include <random>

#include "morsel/core/mesh/subdivision.h"

namespace morsel::test {

Soup refined(const TriangleMesh& mesh, int pieces) {
  const TriangleMesh finer = core::subdivided(mesh, pieces);
  return {{finer.positions().begin(), finer.positions().end()},
          {finer.triangles().begin(), finer.triangles().end()}};
}

void add_noise(Soup& soup, double share, unsigned seed) {
  double sum = 0;
  for (const core::Triangle& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) sum += (soup.positions[t[i]] - soup.positions[t[(i + 1) % 3]]).norm();
  const double most = share * sum / (3.0 * static_cast<double>(soup.triangles.size()));
  std::mt19937 generator(seed);
  for (Point& p : soup.positions)
    for (int axis = 0; axis < 3;
         ++axis)  // the generator's own numbers: distributions differ between libraries
      p[axis] += most * (2.0 * generator() / std::mt19937::max() - 1);
}

}  // namespace morsel::test
