#include "morsel/persistence/paths.h"

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"

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

Paths::Paths(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
             std::span<const Index> extremum)
    : mesh_(mesh),
      rank_(rank),
      direction_(direction),
      entries_(std::size_t{mesh.vertex_count()} + mesh.boundary_loop_count(), kNone) {
  core::parallel_for_each(extremum.size(),
                          [&](std::size_t b) { entries_[extremum[b]] = static_cast<Index>(b); });
}

// Threads may walk the same path at the same time; they write the same basins.
Index Paths::find(Index v, std::vector<Index>& buffer) const {
  Index found = entry(v).load(std::memory_order_relaxed);
  if (found < kNext) return found;
  buffer.clear();
  do {
    buffer.push_back(v);
    if (found != kNone)
      v = found & ~kNext;
    else if (direction_ == Direction::up)
      v = steepest_neighbor<Direction::up>(mesh_, rank_, v);
    else
      v = steepest_neighbor<Direction::down>(mesh_, rank_, v);
    found = entry(v).load(std::memory_order_relaxed);
  } while (found >= kNext);
  for (const Index u : buffer) entry(u).store(found, std::memory_order_relaxed);
  return found;
}

}  // namespace morsel::persistence::detail
