#include "morsel/persistence/reconstruction.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/radix_sort.h"
#include "morsel/core/parallel/union_find.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;
using core::ScalarField;

/// Regions a chunk: most have a few vertices.
constexpr std::size_t kRegionGrain = 128;

/// Basins that are not kept and overflow together, at the saddle of that rank.
struct Region {
  Index saddle;
  Index first;  ///< its basins in Regions::basins
  Index last;
};

struct Regions {
  std::vector<Region> regions;
  std::vector<Index> basins;
};

/// Where basins that are not kept overflow: at the saddle at which, during the sweep, their component first
/// meets one that holds a kept basin. `merges` come in the order of the sweep.
Regions overflow_regions(std::span<const Merge> merges, std::vector<std::uint8_t> holds_kept) {
  const auto count = static_cast<Index>(holds_kept.size());
  core::UnionFind sets(count);
  std::vector<Index> follows(count, kNone);  // overflows where that earlier basin does
  std::vector<Index> region(count, kNone);
  Regions result;
  for (const Merge& merge : merges) {
    Index a = sets.find(merge.a);
    Index b = sets.find(merge.b);
    if (a == b) continue;
    if (b < a) std::swap(a, b);
    if (holds_kept[a] == 0 && holds_kept[b] == 0) {
      follows[b] = a;
    } else if (holds_kept[a] == 0 || holds_kept[b] == 0) {
      region[holds_kept[a] != 0 ? b : a] = static_cast<Index>(result.regions.size());
      result.regions.push_back({merge.saddle, 0, 0});
    }
    holds_kept[a] |= holds_kept[b];
    sets.unite(a, b);
  }
  for (Index b = 0; b < count; ++b) {
    if (follows[b] != kNone) region[b] = region[follows[b]];
    if (region[b] != kNone) ++result.regions[region[b]].last;  // counts
  }
  Index offset = 0;
  for (Region& r : result.regions) {
    r.first = offset;
    offset += std::exchange(r.last, offset);
  }
  result.basins.resize(offset);
  for (Index b = 0; b < count; ++b)
    if (region[b] != kNone) result.basins[result.regions[region[b]].last++] = b;
  return result;
}

class Reconstruction {
 public:
  Reconstruction(const ScalarField& f, const Sweeps& sweeps, std::span<const Role> roles,
                 const core::Progress& progress)
      : f_(f), mesh_(f.mesh()), sweeps_(sweeps), roles_(roles), progress_(progress) {
    result_.place.assign(f.ranks().begin(), f.ranks().end());
  }

  Releveled run() {
    const std::vector<Merge> joined = flood();
    progress_.throw_if_cancelled();
    if (joined.empty()) {
      carve(sweeps_.down.merges);
    } else {
      // Flooding does not change the sweep of f from above, except that flooded parts are joined earlier.
      std::vector<Merge> merges(sweeps_.down.merges.size() + joined.size());
      std::merge(sweeps_.down.merges.begin(), sweeps_.down.merges.end(), joined.begin(), joined.end(),
                 merges.begin(), [](const Merge& a, const Merge& b) { return a.saddle > b.saddle; });
      carve(merges);
    }
    add_levels();
    return std::move(result_);
  }

 private:
  struct Scratch {
    std::vector<Index> part, path;
    std::vector<Merge> merges;
  };

  // Regions are disjoint; a neighbour in another one that is moved at the same time is on the same side of
  // the level before and after.
  Index place(Index v) const {
    return std::atomic_ref<Index>(result_.place[v]).load(std::memory_order_relaxed);
  }
  void move_to(Index v, const Level& level) {
    const Index rank = f_.rank(v);
    std::atomic_ref<Index>(result_.place[v])
        .store(level.holds(rank) ? rank : level.first, std::memory_order_relaxed);
  }

  std::vector<Merge> flood() {
    const Sweep& up = sweeps_.up;
    std::vector<std::uint8_t> kept(up.basin_count());
    for (Index b = 0; b < up.basin_count(); ++b) kept[b] = roles_[up.extremum[b]] == Role::minimum ? 1 : 0;
    const Regions regions = overflow_regions(up.merges, std::move(kept));
    std::vector<Merge> joined =
        for_each_region(regions, up, flooded_, [&](Index minimum, const Level& level, Scratch& scratch) {
          if (place(minimum) >= level.first) return;  // reached before, or on the level
          if (flood_from(minimum, level, scratch.part) != 1) join_around(level, scratch);
        });
    const auto n = static_cast<Index>(result_.place.size());
    core::radix_sort(joined, std::bit_width(n), [&](const Merge& merge) { return n - merge.saddle; });
    return joined;
  }

  /// Floods the part that is connected to a minimum below the level, which becomes `part`; returns the part's
  /// Euler characteristic.
  long flood_from(Index minimum, const Level& level, std::vector<Index>& part) {
    long sixfold = 0;
    move_to(minimum, level);
    part.assign(1, minimum);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Index v = part[i];
      long neighbors = 0;  // in the part; half an edge each
      long following = 0;  // one another in v's link; a third of a triangle each
      Index count = 0;
      bool first = false;
      bool previous = false;
      core::for_each_neighbor(mesh_, v, [&](Index u) {
        const bool inside = f_.rank(u) < level.first;
        if (inside && place(u) < level.first) {
          move_to(u, level);
          part.push_back(u);
        }
        if (count++ == 0) first = inside;
        neighbors += inside ? 1 : 0;
        following += inside && previous ? 1 : 0;
        previous = inside;
      });
      if (!mesh_.is_boundary_vertex(v)) following += first && previous ? 1 : 0;
      sixfold += 6 - 3 * neighbors + 2 * following;
    }
    return sixfold / 6;
  }

  /// Records that all neighbours of scratch.part, on the level or above it, are connected from the level on.
  /// Around a disc they are so anyway, since they lie on one circle.
  void join_around(const Level& level, Scratch& scratch) const {
    Index joint = kNone;
    const auto touch = [&](Index u) {
      const Index basin = sweeps_.down.paths->find(u, scratch.path);
      if (joint == kNone) joint = basin;
      if (basin != joint) scratch.merges.push_back({level.first, joint, basin});
    };
    for (const Index v : scratch.part) {
      if (mesh_.is_boundary_vertex(v)) touch(mesh_.vertex_count() + mesh_.boundary_loop_of_vertex(v));
      core::for_each_neighbor(mesh_, v, [&](Index u) {
        if (f_.rank(u) >= level.first) touch(u);
      });
    }
  }

  void carve(std::span<const Merge> merges) {
    const Sweep& down = sweeps_.down;
    std::vector<std::uint8_t> kept(down.basin_count());
    for (Index b = 0; b < down.basin_count(); ++b)
      kept[b] = down.is_cap(b) || roles_[down.extremum[b]] == Role::maximum ? 1 : 0;
    const Regions regions = overflow_regions(merges, std::move(kept));
    for_each_region(regions, down, carved_, [&](Index maximum, const Level& level, Scratch& scratch) {
      if (place(maximum) != f_.rank(maximum)) return;  // reached before, or flooded over
      std::vector<Index>& part = scratch.part;
      part.clear();
      const auto take = [&](Index v) {
        if (place(v) < level.last) return;
        move_to(v, level);
        part.push_back(v);
      };
      take(maximum);
      for (std::size_t i = 0; i < part.size(); ++i) core::for_each_neighbor(mesh_, part[i], take);
    });
  }

  /// Calls visit(extremum, level, scratch) for the extrema of all regions, in memory order, and stores the
  /// levels.
  template <class Visit>
  std::vector<Merge> for_each_region(const Regions& regions, const Sweep& sweep, std::vector<Level>& levels,
                                     const Visit& visit) {
    levels.resize(regions.regions.size());
    core::parallel_for_each(levels.size(),
                            [&](std::size_t i) { levels[i] = level_of(f_, regions.regions[i].saddle); });
    core::FlatArray<Index> visits(levels.size());
    std::iota(visits.begin(), visits.end(), Index{0});
    core::radix_sort(visits, std::bit_width(mesh_.triangle_count()), [&](Index i) {
      const Index extremum = sweep.extremum[regions.basins[regions.regions[i].first]];
      return mesh_.vertex_halfedge(extremum) / 3;
    });
    return core::parallel_reduce(
        0, visits.size(), kRegionGrain, std::vector<Merge>{},
        [&](std::size_t first, std::size_t last) {
          Scratch scratch;
          for (std::size_t i = first; i < last; ++i) {
            const Region& region = regions.regions[visits[i]];
            for (Index b = region.first; b < region.last; ++b)
              visit(sweep.extremum[regions.basins[b]], levels[visits[i]], scratch);
          }
          return std::move(scratch.merges);
        },
        [](std::vector<Merge> sum, const std::vector<Merge>& part) {
          sum.insert(sum.end(), part.begin(), part.end());
          return sum;
        });
  }

  /// Regions are in the order of the sweeps, and so are their levels.
  void add_levels() {
    result_.levels.resize(flooded_.size() + carved_.size());
    const auto is_lower = [](const Level& a, const Level& b) { return a.first < b.first; };
    const auto is_same = [](const Level& a, const Level& b) { return a.first == b.first; };
    std::merge(flooded_.begin(), flooded_.end(), carved_.rbegin(), carved_.rend(), result_.levels.begin(),
               is_lower);
    result_.levels.erase(std::unique(result_.levels.begin(), result_.levels.end(), is_same),
                         result_.levels.end());
  }

  const ScalarField& f_;
  const core::TriangleMesh& mesh_;
  const Sweeps& sweeps_;
  std::span<const Role> roles_;
  const core::Progress& progress_;
  mutable Releveled result_;
  std::vector<Level> flooded_, carved_;  // the levels of the regions
};

}  // namespace

Releveled reconstruct(const ScalarField& f, const Sweeps& sweeps, std::span<const Role> roles,
                      const core::Progress& progress) {
  return Reconstruction(f, sweeps, roles, progress).run();
}

}  // namespace morsel::persistence::detail
