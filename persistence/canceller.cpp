#include "morsel/persistence/canceller.h"

#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/persistence/link_ends.h"
#include "morsel/persistence/plateaus.h"

namespace morsel::persistence::detail {

using core::ScalarField;

Canceller::Canceller(const ScalarField& f, const core::Progress& progress)
    : f_(f), progress_(progress), sweeps_(sweep(f, progress)), diagram_(unsorted_diagram(f, sweeps_)) {}

ScalarField Canceller::run(std::span<const PersistencePair> staying) const {
  if (staying.size() == diagram_.finite_count) return f_;
  progress_.throw_if_cancelled();
  const std::vector<Role> roles = survivors(staying);
  const Releveled releveled = reconstruct(f_, sweeps_, roles, progress_);
  progress_.throw_if_cancelled();
  core::FlatArray<Index> rank = order_plateaus(f_, releveled, roles);
  std::vector<double> values(f_.values().begin(), f_.values().end());
  core::parallel_for_each(values.size(), [&](std::size_t v) {
    const Index place = releveled.place[v];
    if (place != f_.ranks()[v]) values[v] = f_.value(f_.order()[place]);
  });
  return {f_.mesh(), std::move(values), std::move(rank)};
}

/// The extrema that stay, chosen once, from f.
std::vector<Role> Canceller::survivors(std::span<const PersistencePair> staying) const {
  std::vector<Role> roles(f_.mesh().vertex_count(), Role::regular);
  for (const EssentialExtrema& extrema : diagram_.essential_extrema) {
    roles[extrema.minimum] = Role::minimum;
    if (!extrema.top_is_cap) roles[extrema.top] = Role::maximum;
  }
  for (const PersistencePair& pair : staying)
    roles[pair.extremum] = pair.kind == PairKind::minimum_saddle ? Role::minimum : Role::maximum;
  return roles;
}

}  // namespace morsel::persistence::detail
