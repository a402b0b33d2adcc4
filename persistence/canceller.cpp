#include "morsel/persistence/canceller.h"

#include <algorithm>
#include <utility>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"

namespace morsel::persistence::detail {

using core::kNone;
using core::ScalarField;

Canceller::Canceller(const ScalarField& f, const core::Progress& progress)
    : f_(f),
      mesh_(f.mesh()),
      progress_(progress),
      up_(sweep(mesh_, f.ranks(), Direction::up, progress)),
      down_(sweep(mesh_, f.ranks(), Direction::down, progress)),
      diagram_(pair_sweeps(f, up_, down_)),
      level_(mesh_.vertex_count()) {
  for (const Index v : f.order()) {
    if (value_of_level_.empty() || value_of_level_.back() < f.value(v)) value_of_level_.push_back(f.value(v));
    level_[v] = level_count() - 1;
  }
}

ScalarField Canceller::run(std::size_t cancelled) const {
  if (cancelled == 0) return f_;
  progress_.throw_if_cancelled();
  const std::vector<Role> roles = survivors(cancelled);
  std::vector<Index> level = level_;
  if (flood(roles, level)) {
    std::vector<Index> offsets;
    const std::vector<Index> order = sort_by_level(f_, level, level_count(), offsets);
    std::vector<Index> rank(order.size());
    for (Index i = 0; i < order.size(); ++i) rank[order[i]] = i;
    carve(sweep(mesh_, rank, Direction::down, progress_), roles, level);
  } else {
    carve(down_, roles, level);  // f's own sweep still holds
  }
  progress_.throw_if_cancelled();
  std::vector<Index> rank = order_plateaus(f_, level, level_count(), roles);
  std::vector<double> values(f_.values().begin(), f_.values().end());
  for (Index v = 0; v < values.size(); ++v)
    if (level[v] != level_[v]) values[v] = value_of_level_[level[v]];
  return {mesh_, std::move(values), std::move(rank)};
}

/// What stays, chosen once, from f.
std::vector<Role> Canceller::survivors(std::size_t cancelled) const {
  std::vector<Role> roles(mesh_.vertex_count(), Role::regular);
  for (const EssentialExtrema& extrema : diagram_.essential_extrema) {
    roles[extrema.minimum] = Role::minimum;
    if (!extrema.top_is_cap) roles[extrema.top] = Role::maximum;
  }
  for (const PersistencePair& pair : diagram_.finite_pairs().subspan(cancelled))
    roles[pair.extremum] = pair.kind == PairKind::minimum_saddle ? Role::minimum : Role::maximum;
  return roles;
}

/// Raises the basins of the minima that go to where they overflow; returns whether any vertex changed. A
/// vertex is connected to its basin's minimum below itself, so both are flooded to the same level.
bool Canceller::flood(const std::vector<Role>& roles, std::vector<Index>& level) const {
  std::vector<bool> kept(up_.basin_count());
  for (Index b = 0; b < up_.basin_count(); ++b) kept[b] = roles[up_.extremum[b]] == Role::minimum;
  const std::vector<Index> overflow = overflow_saddles(up_, kept);
  bool changed = false;
  for (Index v = 0; v < level.size(); ++v) {
    const Index saddle = overflow[up_.basin[v]];
    if (saddle == kNone || level[v] >= level_[saddle]) continue;
    level[v] = level_[saddle];
    changed = true;
  }
  return changed;
}

/// Lowers the basins of the maxima that go; `down` is a sweep over the vertices by (level, rank in f), in
/// which the maxima that stay are still maxima.
void Canceller::carve(const Sweep& down, const std::vector<Role>& roles, std::vector<Index>& level) const {
  std::vector<bool> kept(down.basin_count());
  for (Index b = 0; b < down.basin_count(); ++b)
    kept[b] = down.is_cap(b) || roles[down.extremum[b]] == Role::maximum;
  const std::vector<Index> overflow = overflow_saddles(down, kept);
  std::vector<Index> bottom(overflow.size(), 0);  // read first: saddles may be carved themselves
  for (Index b = 0; b < down.basin_count(); ++b)
    bottom[b] = overflow[b] == kNone ? level_count() : level[overflow[b]];
  for (Index v = 0; v < level.size(); ++v) level[v] = std::min(level[v], bottom[down.basin[v]]);
}

std::size_t critical_count(const ScalarField& field) {
  const auto rank = field.ranks();
  return core::parallel_reduce(
      0, rank.size(), core::kGrain, std::size_t{0},
      [&](std::size_t first, std::size_t last) {
        std::size_t count = 0;
        for (auto v = static_cast<Index>(first); v < last; ++v) {
          const core::LinkPart lower = core::link_part(
              field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return rank[u] < rank[v]; },
              [](Index) {});
          if (lower.runs != 1) ++count;  // none: an extremum; several: a saddle
        }
        return count;
      },
      [](std::size_t sum, std::size_t part) { return sum + part; });
}

}  // namespace morsel::persistence::detail
