#include "morsel/persistence/sweep.h"

#include <algorithm>
#include <span>
#include <utility>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"
#include "morsel/core/union_find.h"

namespace morsel::persistence::detail {
namespace {

using core::kNone;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// The critical vertices, each kind by ascending rank.
struct Critical {
  std::vector<Index> minima, maxima;
  std::vector<Saddle> saddles;
};

Index saddle_multiplicity(const core::ScalarField& field, VertexType type, Index v) {
  if (type.changes() < VertexType::kMostChanges) return type.changes() / 2 - 1;
  const auto lower = core::link_part(
      field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return field.is_lower(u, v); }, [](Index) {});
  return lower.runs - 1;
}

Critical critical_vertices(const core::ScalarField& field, std::span<const VertexType> types) {
  const auto order = field.order();
  return core::parallel_reduce(
      0, order.size(), std::size_t{1} << 16, Critical{},
      [&](std::size_t begin, std::size_t end) {
        Critical part;
        for (auto r = static_cast<Index>(begin); r < end; ++r) {
          const Index v = order[r];
          const VertexType type = types[v];
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

void replace_by_basins(const Paths& paths, std::vector<Index>& ends) {
  core::parallel_for(0, ends.size(), core::kGrain, [&](std::size_t first, std::size_t last) {
    std::vector<Index> buffer;
    for (std::size_t i = first; i < last; ++i) ends[i] = paths.find(ends[i], buffer);
  });
}

/// The elder rule at one saddle after the other.
class Elder {
 public:
  explicit Elder(Sweep& sweep) : sweep_(sweep), components_(sweep.basin_count()) {}

  /// `basins` meet at the saddle.
  void meet(Index saddle, std::span<const Index> basins) {
    const std::size_t earlier = sweep_.deaths.size();
    for (const Index basin : basins.subspan(1)) {
      if (basin == basins[0]) continue;
      const Index a = components_.find(basins[0]);
      const Index b = components_.find(basin);
      if (a == b) continue;
      components_.unite(a, b);
      sweep_.merges.push_back({saddle, a, b});
      sweep_.deaths.push_back({std::max(a, b), saddle});
    }
    if (sweep_.deaths.size() > earlier + 1)
      std::sort(sweep_.deaths.begin() + static_cast<std::ptrdiff_t>(earlier), sweep_.deaths.end(),
                [](const Death& x, const Death& y) { return x.basin > y.basin; });
  }

 private:
  Sweep& sweep_;
  core::UnionFind components_;  // roots are the eldest
};

}  // namespace

Sweeps sweep(const core::ScalarField& field, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const Index n = mesh.vertex_count();
  const std::vector<VertexType> types = vertex_types(mesh, field.ranks());
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

  const auto meet = [&](Elder& elder, const Saddle& saddle, const std::vector<Index>& basins) {
    elder.meet(saddle.rank, std::span<const Index>(basins).subspan(ends.offset[field.order()[saddle.rank]],
                                                                   2 * saddle.multiplicity + 2));
  };
  core::parallel_for(0, 2, 1, [&](std::size_t which, std::size_t) {
    if (which == 0) {
      Elder elder(result.up);
      for (const Saddle& saddle : result.saddles) meet(elder, saddle, ends.lower);
    } else {
      Elder elder(result.down);
      for (std::size_t s = result.saddles.size(); s-- > 0;) meet(elder, result.saddles[s], ends.higher);
    }
  });
  return result;
}

}  // namespace morsel::persistence::detail
