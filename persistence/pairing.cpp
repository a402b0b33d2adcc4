#include "morsel/persistence/pairing.h"

#include <algorithm>
#include <span>

#include "morsel/core/parallel/parallel.h"
#include "morsel/persistence/elder_rule.h"
#include "morsel/persistence/sweep.h"

namespace morsel::persistence {

namespace detail {
namespace {

/// Calls visit(basin) for each basin that never ends.
template <class Visit>
void for_each_essential(const Sweep& sweep, const Visit& visit) {
  std::vector<bool> ends(sweep.basin_count(), false);
  for (const Death& death : sweep.deaths) ends[death.basin] = true;
  for (Index b = 0; b < sweep.basin_count(); ++b)
    if (!ends[b]) visit(b);
}

void add_essential_extrema(const core::TriangleMesh& mesh, const Sweeps& sweeps, Diagram& diagram) {
  const Index n = mesh.vertex_count();
  diagram.essential_extrema.resize(mesh.component_count());
  for_each_essential(sweeps.up, [&](Index basin) {
    const Index minimum = sweeps.up.extremum[basin];
    diagram.essential_extrema[mesh.component_of_vertex(minimum)].minimum = minimum;
  });
  for_each_essential(sweeps.down, [&](Index basin) {
    const Index top = sweeps.down.extremum[basin];
    const bool cap = sweeps.down.is_cap(basin);
    EssentialExtrema& extrema =
        diagram.essential_extrema[cap ? mesh.component_of_loop(top - n) : mesh.component_of_vertex(top)];
    extrema.top = cap ? top - n : top;
    extrema.top_is_cap = cap;
  });
}

void add_essential_saddles(const core::ScalarField& field, const Sweeps& sweeps, Diagram& diagram) {
  auto up = sweeps.up.deaths.begin();
  auto down = sweeps.down.deaths.rbegin();
  for (const auto& [rank, multiplicity] : sweeps.saddles) {
    Index unpaired = multiplicity;
    for (; up != sweeps.up.deaths.end() && up->saddle == rank; ++up) --unpaired;
    for (; down != sweeps.down.deaths.rend() && down->saddle == rank; ++down) --unpaired;
    if (unpaired > 0) diagram.essential_saddles.push_back({field.order()[rank], unpaired});
  }
  std::sort(diagram.essential_saddles.begin(), diagram.essential_saddles.end(),
            [](const EssentialSaddle& a, const EssentialSaddle& b) { return a.vertex < b.vertex; });
}

}  // namespace

Diagram unsorted_diagram(const core::ScalarField& field, const Sweeps& sweeps) {
  const Sweep& up = sweeps.up;
  const Sweep& down = sweeps.down;
  const Index n = field.mesh().vertex_count();
  Diagram diagram;
  // First in the order of the sweeps, caps last.
  std::vector<Death> capped;
  std::vector<Death> falling;
  for (const Death& death : down.deaths) (down.is_cap(death.basin) ? capped : falling).push_back(death);
  diagram.finite_count = up.deaths.size() + falling.size();
  diagram.pairs.resize(diagram.finite_count);
  core::parallel_for_each(up.deaths.size(), [&](std::size_t i) {
    const Index minimum = up.extremum[up.deaths[i].basin];
    const Index saddle = field.order()[up.deaths[i].saddle];
    diagram.pairs[i] = {minimum, saddle, PairKind::minimum_saddle, field.value(minimum), field.value(saddle)};
  });
  core::parallel_for_each(falling.size(), [&](std::size_t i) {
    const Index maximum = down.extremum[falling[i].basin];
    const Index saddle = field.order()[falling[i].saddle];
    diagram.pairs[up.deaths.size() + i] = {maximum, saddle, PairKind::saddle_maximum, field.value(saddle),
                                           field.value(maximum)};
  });
  for (const Death& death : capped) {
    const Index saddle = field.order()[death.saddle];
    diagram.pairs.push_back(
        {down.extremum[death.basin] - n, saddle, PairKind::saddle_cap, field.value(saddle), kInfinite});
  }
  add_essential_extrema(field.mesh(), sweeps, diagram);
  add_essential_saddles(field, sweeps, diagram);
  return diagram;
}

void sort_pairs(Diagram& diagram) {
  sort_by_persistence(std::span(diagram.pairs).first(diagram.finite_count),
                      [](const PersistencePair& pair) { return pair.persistence(); });
}

}  // namespace detail

Diagram pair_extrema(const core::ScalarField& field, const core::Progress& progress) {
  progress.update("persistence pairs", 0);
  const detail::Sweeps sweeps = detail::sweep(field, progress);
  progress.update("persistence pairs", 0.8);
  Diagram diagram = detail::unsorted_diagram(field, sweeps);
  detail::sort_pairs(diagram);
  progress.update("persistence pairs", 1);
  return diagram;
}

}  // namespace morsel::persistence
