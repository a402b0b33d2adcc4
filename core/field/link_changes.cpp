#include "morsel/core/field/link_changes.h"

#include <utility>

#include "morsel/core/parallel/parallel.h"

namespace morsel::core {
namespace {

/// Slices of triangles are counted separately and added; as sums are cut off, their number does not matter.
constexpr std::size_t kMostSlices = 8;

}  // namespace

std::vector<LinkChanges> link_changes(const TriangleMesh& mesh, std::span<const Index> rank) {
  const std::size_t triangles = mesh.triangle_count();
  const auto threads = static_cast<std::size_t>(thread_count());
  const std::size_t slices = triangles < kGrain ? 1 : std::min(threads, kMostSlices);
  std::vector<std::vector<LinkChanges>> parts(slices);
  parallel_for(0, slices, 1, [&](std::size_t k, std::size_t) {
    parts[k].resize(rank.size());
    LinkChanges* const types = parts[k].data();
    for_each_triangle(mesh, rank, triangles * k / slices, triangles * (k + 1) / slices,
                      [&](Index, Index middle, Index highest) {
                        types[middle].add_change();
                        types[highest].set_above();
                      });
  });
  std::vector<LinkChanges>& types = parts.front();
  if (slices > 1)
    parallel_for(0, rank.size(), std::size_t{1} << 13, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = 1; k < slices; ++k)
        for (std::size_t v = first; v < last; ++v) types[v].add(parts[k][v]);
    });
  for_each_cap_triangle(mesh, rank, [&](Index, Index middle, Index) { types[middle].add_change(); });
  return std::move(types);
}

}  // namespace morsel::core
