#include "morsel/morse/smoothing/empty_balls.h"

#include <cstddef>
#include <functional>

#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/numbers.h"

namespace morsel::morse {

std::vector<std::string> empty_ball_warnings(const core::TriangleMesh& mesh, double radius) {
  const auto count_empty = [&](const auto& is_empty) {
    return core::parallel_reduce(
        0, mesh.vertex_count(), core::kGrain, std::size_t{0},
        [&](std::size_t first, std::size_t last) {
          std::size_t found = 0;
          for (std::size_t v = first; v < last; ++v) found += is_empty(static_cast<core::Index>(v)) ? 1 : 0;
          return found;
        },
        std::plus<>());
  };
  const auto is_most = [&](std::size_t empty) { return 2 * empty > mesh.vertex_count(); };
  // Neighbours along edges are quick to see; only where they are out of reach others are searched.
  const auto is_alone = [&](core::Index v) {
    bool alone = true;
    mesh.for_each_outgoing(v, [&](core::Index h) {
      if ((mesh.position(mesh.target(h)) - mesh.position(v)).stableNorm() <= radius) alone = false;
      if ((mesh.position(mesh.apex(h)) - mesh.position(v)).stableNorm() <= radius) alone = false;
    });
    return alone;
  };
  if (!is_most(count_empty(is_alone))) return {};
  const core::PointSearch search(mesh.positions());
  const std::size_t empty = count_empty([&](core::Index v) {
    std::vector<core::Index> near;
    if (!is_alone(v)) return false;
    search.within(mesh.position(v), radius, near);
    return near.size() <= 1;
  });
  if (!is_most(empty)) return {};
  return {"of " + std::to_string(mesh.vertex_count()) + " vertices " + std::to_string(empty) +
          " have no other within the radius of " + core::to_digits(radius) +
          ", and there smoothing does nothing; a sigma of 1edges or more reaches the neighbours"};
}

}  // namespace morsel::morse
