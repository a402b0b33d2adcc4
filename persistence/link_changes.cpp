#include "morsel/persistence/link_changes.h"

#include <algorithm>

#include "morsel/core/parallel.h"

namespace morsel::persistence::detail {
namespace {

using Changes = std::vector<std::uint8_t>;

/// Slices are counted apart and added; as sums are cut off, their number makes no difference.
constexpr std::size_t kMostSlices = 8;

void add(Changes& changes, Index v) {
  changes[v] = static_cast<std::uint8_t>(changes[v] + (changes[v] < kMostChanges ? 1 : 0));
}

void count_triangles(const core::TriangleMesh& mesh, std::span<const Index> rank, std::size_t first,
                     std::size_t last, Changes& changes) {
  for (const core::Triangle& triangle : mesh.triangles().subspan(first, last - first)) {
    const Index a = rank[triangle[0]];
    const Index b = rank[triangle[1]];
    const Index c = rank[triangle[2]];
    const Index middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
    add(changes, middle == a ? triangle[0] : middle == b ? triangle[1] : triangle[2]);
  }
}

/// The triangles of the caps, which are higher than all vertices.
void count_caps(const core::TriangleMesh& mesh, std::span<const Index> rank, Changes& changes) {
  for (Index loop = 0; loop < mesh.boundary_loop_count(); ++loop)
    for (const Index h : mesh.boundary_loop(loop)) {
      const Index a = mesh.origin(h);
      const Index b = mesh.target(h);
      add(changes, rank[a] < rank[b] ? b : a);
    }
}

}  // namespace

std::vector<std::uint8_t> link_changes(const core::TriangleMesh& mesh, std::span<const Index> rank) {
  const std::size_t triangles = mesh.triangle_count();
  const auto threads = static_cast<std::size_t>(core::thread_count());
  const std::size_t slices =
      threads == 1 || triangles < core::kGrain ? 1 : std::min(2 * threads, kMostSlices);
  std::vector<Changes> parts(slices);
  core::parallel_for(0, slices, 1, [&](std::size_t k, std::size_t) {
    parts[k].assign(rank.size(), 0);
    count_triangles(mesh, rank, triangles * k / slices, triangles * (k + 1) / slices, parts[k]);
  });
  Changes& changes = parts.front();
  if (slices > 1)
    core::parallel_for(0, rank.size(), std::size_t{1} << 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = 1; k < slices; ++k)
        for (std::size_t v = first; v < last; ++v)
          changes[v] = static_cast<std::uint8_t>(std::min<int>(kMostChanges, changes[v] + parts[k][v]));
    });
  count_caps(mesh, rank, changes);
  return std::move(changes);
}

}  // namespace morsel::persistence::detail
