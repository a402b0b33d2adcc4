#include "morsel/persistence/sweep.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "morsel/core/field/classification.h"
#include "morsel/core/parallel/parallel.h"

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

Critical critical_vertices(const core::ScalarField& field, std::span<const core::LinkChanges> types) {
  const auto order = field.order();
  return core::parallel_reduce(
      0, order.size(), 4 * core::kGrain, Critical{},
      [&](std::size_t begin, std::size_t end) {
        Critical part;
        for (auto r = static_cast<Index>(begin); r < end; ++r) {
          const Index v = order[r];
          if (types[v].is_regular()) continue;
          const core::VertexKind kind = core::vertex_kind(field, v, types[v]);
          if (kind.type == core::CriticalType::saddle)
            part.saddles.push_back({r, kind.multiplicity});
          else
            (kind.type == core::CriticalType::minimum ? part.minima : part.maxima).push_back(v);
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

/// The basins that saddles join, by ascending rank: of those that meet at a saddle, the first with each other
/// one.
std::vector<Merge> collect_merges(const core::ScalarField& field, std::span<const Saddle> saddles,
                                  std::span<const Index> offset, std::span<const Index> basins) {
  return core::parallel_reduce(
      0, saddles.size(), core::kGrain, std::vector<Merge>{},
      [&](std::size_t begin, std::size_t end) {
        std::vector<Merge> part;
        for (const Saddle& saddle : saddles.subspan(begin, end - begin)) {
          const auto meeting = basins.subspan(offset[field.order()[saddle.rank]], saddle.changes());
          const Index first = meeting.front();
          Index previous = first;
          for (const Index basin : meeting) {
            if (basin != first && basin != previous) part.push_back({saddle.rank, first, basin});
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

void unite(Sweep& sweep) {
  sweep.deaths = apply_elder_rule(sweep.basin_count(), sweep.merges, std::equal_to<>());
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
  result.down.extremum = tops_by_age(critical.maxima, n, mesh.boundary_loop_count());
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
