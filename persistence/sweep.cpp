#include "morsel/persistence/sweep.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"
#include "morsel/core/parallel_sort.h"
#include "morsel/core/union_find.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

/// What one walk over the links finds, in vertex order; merges hold link vertices (or caps), not yet basins.
struct Found {
  std::vector<Index> extrema;
  std::vector<Merge> merges;
  std::vector<Saddle> saddles;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Fills `next` with each vertex's steepest neighbour (an extremum's is itself) and collects the rest.
template <Direction direction>
Found walk_links(const core::TriangleMesh& mesh, std::span<const Index> rank, std::vector<Index>& next) {
  constexpr bool kUp = direction == Direction::up;
  const Index n = mesh.vertex_count();
  return core::parallel_reduce(
      0, n, core::kGrain, Found{},
      [&](std::size_t begin, std::size_t end) {
        Found part;
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
          const Index center = rank[v];
          Index steepest = center;
          Index target = v;
          Index first_run = kNone;
          Index runs = 0;
          const auto cap = [&] { return n + mesh.boundary_loop_of_vertex(v); };
          const core::LinkPart part_of_link = core::link_part(
              mesh, v, /*cap_inside=*/!kUp,
              [&](Index u) {
                const Index r = rank[u];
                if (kUp ? r < steepest : r > steepest) {
                  steepest = r;
                  target = u;
                }
                return kUp ? r < center : r > center;
              },
              [&](Index u) {
                const Index element = u == kNone ? cap() : u;
                if (runs++ == 0)
                  first_run = element;
                else
                  part.merges.push_back({v, first_run, element});
              });
          if (!kUp && mesh.is_boundary_vertex(v)) target = cap();
          next[v] = target;
          if (part_of_link.empty) part.extrema.push_back(v);
          if (runs > 1) part.saddles.push_back({v, runs - 1});
        }
        return part;
      },
      [](Found sum, const Found& part) {
        append(sum.extrema, part.extrema);
        append(sum.merges, part.merges);
        append(sum.saddles, part.saddles);
        return sum;
      });
}

/// Turns steepest neighbours into basins; `basin` comes with the extrema filled in.
void follow_paths(std::vector<Index>& next, std::vector<Index>& basin) {
  for (Index v = 0; v < basin.size(); ++v) {
    Index end = v;
    while (basin[end] == kNone) end = next[end];
    const Index found = basin[end];
    for (Index u = v; basin[u] == kNone; u = next[u]) basin[u] = found;
  }
}

}  // namespace

Sweep sweep(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
            const core::Progress& progress) {
  const Index n = mesh.vertex_count();
  const Index caps = direction == Direction::down ? mesh.boundary_loop_count() : 0;
  Sweep result;
  result.vertex_count = n;
  std::vector<Index> next(std::size_t{n} + caps);
  Found found = direction == Direction::up ? walk_links<Direction::up>(mesh, rank, next)
                                           : walk_links<Direction::down>(mesh, rank, next);
  progress.throw_if_cancelled();

  const auto earlier = [&](Index a, Index b) {
    return direction == Direction::up ? rank[a] < rank[b] : rank[a] > rank[b];
  };
  core::parallel_sort(found.extrema.begin(), found.extrema.end(), earlier);
  for (Index loop = caps; loop-- > 0;) result.extremum.push_back(n + loop);
  append(result.extremum, found.extrema);

  result.basin.assign(std::size_t{n} + caps, kNone);
  for (Index b = 0; b < result.basin_count(); ++b) result.basin[result.extremum[b]] = b;
  follow_paths(next, result.basin);

  for (Merge& merge : found.merges) {
    const auto [a, b] = std::minmax(result.basin[merge.a], result.basin[merge.b]);
    merge = {merge.saddle, a, b};
  }
  std::erase_if(found.merges, [](const Merge& merge) { return merge.a == merge.b; });
  core::parallel_sort(found.merges.begin(), found.merges.end(), [&](const Merge& x, const Merge& y) {
    if (x.saddle != y.saddle) return earlier(x.saddle, y.saddle);
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  result.basin.resize(n);
  result.merges = std::move(found.merges);
  result.saddles = std::move(found.saddles);
  return result;
}

std::vector<Index> overflow_saddles(const Sweep& sweep, const std::vector<bool>& kept) {
  const Index count = sweep.basin_count();
  core::UnionFind sets(count);
  std::vector<bool> holds_kept = kept;  // per root
  std::vector<Index> overflow(count, kNone);
  std::vector<Index> follows(count, kNone);  // overflows where that earlier basin does
  for (const Merge& merge : sweep.merges) {
    Index a = sets.find(merge.a);
    Index b = sets.find(merge.b);
    if (a == b) continue;
    if (b < a) std::swap(a, b);
    if (!holds_kept[a] && !holds_kept[b])
      follows[b] = a;
    else if (!holds_kept[a] || !holds_kept[b])
      overflow[holds_kept[a] ? b : a] = merge.saddle;
    holds_kept[a] = holds_kept[a] || holds_kept[b];
    sets.unite(a, b);
  }
  for (Index b = 0; b < count; ++b)
    if (follows[b] != kNone) overflow[b] = overflow[follows[b]];
  return overflow;
}

}  // namespace morsel::persistence::detail
