#include "morsel/persistence/sweep.h"

#include <algorithm>
#include <span>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/union_find.h"

namespace morsel::persistence::detail {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// The critical vertices, each kind by ascending rank.
struct Critical {
  std::vector<Index> minima, maxima;
  std::vector<Saddle> saddles;
};

Index saddle_multiplicity(const core::ScalarField& field, core::LinkChanges type, Index v) {
  if (type.changes() < core::LinkChanges::kMostChanges) return type.changes() / 2 - 1;
  const auto lower = core::link_part(
      field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return field.is_lower(u, v); }, [](Index) {});
  return lower.runs - 1;
}

Critical critical_vertices(const core::ScalarField& field, std::span<const core::LinkChanges> types) {
  const auto order = field.order();
  return core::parallel_reduce(
      0, order.size(), 4 * core::kGrain, Critical{},
      [&](std::size_t begin, std::size_t end) {
        Critical part;
        for (auto r = static_cast<Index>(begin); r < end; ++r) {
          const Index v = order[r];
          const core::LinkChanges type = types[v];
          if (type.is_regular()) continue;
          if (type.is_saddle())
            part.saddles.push_back({r, saddle_multiplicity(field, type, v)});
          else
            (type.is_minimum() ? part.minima : part.maxima).push_back(v);
        }
        return part;
      },
      [](Critical sum, const Critical& part) {
        append(sum.minima, part.minima);
        append(sum.maxima, part.maxima);
        append(sum.saddles, part.saddles);
        return sum;
      });
}

/// Ends of links a chunk: few, as the first paths that are followed are long.
constexpr std::size_t kEnds = 128;

void replace_by_basins(const Paths& paths, std::vector<Index>& ends) {
  core::parallel_for(0, ends.size(), kEnds, [&](std::size_t first, std::size_t last) {
    std::vector<Index> buffer;
    for (std::size_t i = first; i < last; ++i) ends[i] = paths.find(ends[i], buffer);
  });
}

/// What the saddles join, by ascending rank: of the basins that meet at one, the first with each other.
std::vector<Merge> collect_merges(const core::ScalarField& field, std::span<const Saddle> saddles,
                                  std::span<const Index> offset, std::span<const Index> basins) {
  return core::parallel_reduce(
      0, saddles.size(), core::kGrain, std::vector<Merge>{},
      [&](std::size_t begin, std::size_t end) {
        std::vector<Merge> part;
        for (const auto& [rank, multiplicity] : saddles.subspan(begin, end - begin)) {
          const auto meeting = basins.subspan(offset[field.order()[rank]], 2 * multiplicity + 2);
          const Index first = meeting.front();
          Index previous = first;
          for (const Index basin : meeting) {
            if (basin != first && basin != previous) part.push_back({rank, first, basin});
            previous = basin;
          }
        }
        return part;
      },
      [](std::vector<Merge> sum, const std::vector<Merge>& part) {
        append(sum, part);
        return sum;
      });
}

/// The elder rule: keeps the merges that join components and notes which basin each of them ends.
void unite(Sweep& sweep) {
  core::UnionFind components(sweep.basin_count());  // roots are the eldest
  std::size_t kept = 0;
  std::vector<Death>& deaths = sweep.deaths;
  for (const Merge& merge : sweep.merges) {
    const Index a = components.find(merge.a);
    const Index b = components.find(merge.b);
    if (a == b) continue;
    components.unite(a, b);
    sweep.merges[kept++] = {merge.saddle, a, b};
    deaths.push_back({std::max(a, b), merge.saddle});
    for (std::size_t i = deaths.size() - 1;
         i > 0 && deaths[i - 1].saddle == merge.saddle && deaths[i - 1].basin < deaths[i].basin; --i)
      std::swap(deaths[i - 1], deaths[i]);
  }
  sweep.merges.resize(kept);
  sweep.merges.shrink_to_fit();
}

}  // namespace

Sweeps sweep(const core::ScalarField& field, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const Index n = mesh.vertex_count();
  const std::vector<core::LinkChanges> types = core::link_changes(mesh, field.ranks());
  Critical critical = critical_vertices(field, types);
  progress.throw_if_cancelled();

  Sweeps result;
  result.saddles = std::move(critical.saddles);
  result.up.vertex_count = n;
  result.down.vertex_count = n;
  result.up.extremum = std::move(critical.minima);
  for (Index loop = mesh.boundary_loop_count(); loop-- > 0;) result.down.extremum.push_back(n + loop);
  result.down.extremum.insert(result.down.extremum.end(), critical.maxima.rbegin(), critical.maxima.rend());
  result.up.paths = std::make_unique<Paths>(mesh, field.ranks(), Direction::up, result.up.extremum);
  result.down.paths = std::make_unique<Paths>(mesh, field.ranks(), Direction::down, result.down.extremum);

  LinkEnds ends = link_ends(field, types, result.saddles, *result.up.paths, *result.down.paths);
  replace_by_basins(*result.up.paths, ends.lower);
  replace_by_basins(*result.down.paths, ends.higher);
  progress.throw_if_cancelled();

  result.up.merges = collect_merges(field, result.saddles, ends.offset, ends.lower);
  result.down.merges = collect_merges(field, result.saddles, ends.offset, ends.higher);
  std::reverse(result.down.merges.begin(), result.down.merges.end());
  const std::size_t grain = result.saddles.size() < core::kGrain ? 2 : 1;  // threads only where they pay
  core::parallel_for(0, 2, grain, [&](std::size_t first, std::size_t last) {
    if (first == 0) unite(result.up);
    if (last == 2) unite(result.down);
  });
  return result;
}

}  // namespace morsel::persistence::detail
