#include "morsel/persistence/paths.h"

#include <atomic>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

template <Direction direction>
Index steepest_neighbor(const core::TriangleMesh& mesh, std::span<const Index> rank, Index v) {
  if (direction == Direction::down && mesh.is_boundary_vertex(v))
    return mesh.vertex_count() + mesh.boundary_loop_of_vertex(v);
  Index best = rank[v];
  Index steepest = v;
  core::for_each_neighbor(mesh, v, [&](Index u) {
    const Index r = rank[u];
    if (direction == Direction::up ? r < best : r > best) {
      best = r;
      steepest = u;
    }
  });
  return steepest;
}

}  // namespace

SteepestPaths::SteepestPaths(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
                             std::span<const Index> extremum)
    : mesh_(mesh),
      rank_(rank),
      direction_(direction),
      basin_(std::size_t{mesh.vertex_count()} + mesh.boundary_loop_count(), kNone) {
  core::parallel_for_each(extremum.size(),
                          [&](std::size_t b) { basin_[extremum[b]] = static_cast<Index>(b); });
}

Index SteepestPaths::find(Index v, std::vector<Index>& buffer) const {
  return direction_ == Direction::up ? walk<Direction::up>(v, buffer) : walk<Direction::down>(v, buffer);
}

// Threads may walk the same path at the same time; they write the same basins.
template <Direction direction>
Index SteepestPaths::walk(Index v, std::vector<Index>& buffer) const {
  const auto known = [&](Index u) {
    return std::atomic_ref<Index>(basin_[u]).load(std::memory_order_relaxed);
  };
  Index basin = known(v);
  if (basin != kNone) return basin;
  buffer.clear();
  do {
    buffer.push_back(v);
    v = steepest_neighbor<direction>(mesh_, rank_, v);
    basin = known(v);
  } while (basin == kNone);
  for (const Index u : buffer) std::atomic_ref<Index>(basin_[u]).store(basin, std::memory_order_relaxed);
  return basin;
}

}  // namespace morsel::persistence::detail
