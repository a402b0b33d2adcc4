#include "morsel/persistence/pairing.h"

#include <algorithm>

#include "morsel/core/parallel_sort.h"
#include "morsel/core/union_find.h"
#include "morsel/persistence/sweep.h"

namespace morsel::persistence {

namespace detail {
namespace {

/// Calls pair(basin, saddle) for each basin that ends at a saddle and top(basin) for each that never does.
template <class Pair, class Top>
void elder_rule(const Sweep& sweep, const Pair& pair, const Top& top) {
  core::UnionFind components(sweep.basin_count());  // roots are the eldest
  for (const Merge& merge : sweep.merges) {
    const Index a = components.find(merge.a);
    const Index b = components.find(merge.b);
    if (a == b) continue;
    pair(std::max(a, b), merge.saddle);
    components.unite(a, b);
  }
  for (Index b = 0; b < sweep.basin_count(); ++b)
    if (components.find(b) == b) top(b);
}

/// The order of Diagram::pairs.
struct Earlier {
  const core::ScalarField& field;
  bool operator()(const PersistencePair& a, const PersistencePair& b) const {
    const bool a_cap = a.kind == PairKind::saddle_cap;
    const bool b_cap = b.kind == PairKind::saddle_cap;
    if (a_cap != b_cap) return b_cap;
    if (!a_cap && a.persistence() != b.persistence()) return a.persistence() < b.persistence();
    if (a.kind != b.kind) return a.kind < b.kind;
    const bool up = a.kind == PairKind::minimum_saddle;
    if (a.saddle != b.saddle) return up == field.is_lower(a.saddle, b.saddle);
    if (a_cap) return a.extremum < b.extremum;
    return up == field.is_lower(b.extremum, a.extremum);
  }
};

}  // namespace

Diagram pair_sweeps(const core::ScalarField& field, const Sweep& up, const Sweep& down) {
  const core::TriangleMesh& mesh = field.mesh();
  const Index n = mesh.vertex_count();
  Diagram diagram;
  diagram.pairs.reserve(up.saddles.size());
  diagram.essential_extrema.resize(mesh.component_count());
  std::vector<Index> unpaired(n, 0);
  for (const Saddle& saddle : up.saddles) unpaired[saddle.vertex] = saddle.multiplicity;

  elder_rule(
      up,
      [&](Index basin, Index saddle) {
        const Index minimum = up.extremum[basin];
        diagram.pairs.push_back(
            {minimum, saddle, PairKind::minimum_saddle, field.value(minimum), field.value(saddle)});
        --unpaired[saddle];
      },
      [&](Index basin) {
        const Index minimum = up.extremum[basin];
        diagram.essential_extrema[mesh.component_of_vertex(minimum)].minimum = minimum;
      });
  elder_rule(
      down,
      [&](Index basin, Index saddle) {
        const Index top = down.extremum[basin];
        if (down.is_cap(basin)) {
          diagram.pairs.push_back({top - n, saddle, PairKind::saddle_cap, field.value(saddle), kInfinite});
        } else {
          diagram.pairs.push_back(
              {top, saddle, PairKind::saddle_maximum, field.value(saddle), field.value(top)});
        }
        --unpaired[saddle];
      },
      [&](Index basin) {
        const Index top = down.extremum[basin];
        const bool cap = down.is_cap(basin);
        const Index component = cap ? mesh.component_of_loop(top - n) : mesh.component_of_vertex(top);
        diagram.essential_extrema[component].top = cap ? top - n : top;
        diagram.essential_extrema[component].top_is_cap = cap;
      });

  core::parallel_sort(diagram.pairs.begin(), diagram.pairs.end(), Earlier{field});
  diagram.finite_count = static_cast<std::size_t>(
      std::partition_point(diagram.pairs.begin(), diagram.pairs.end(),
                           [](const PersistencePair& pair) { return pair.kind != PairKind::saddle_cap; }) -
      diagram.pairs.begin());
  for (const Saddle& saddle : up.saddles)
    if (unpaired[saddle.vertex] > 0)
      diagram.essential_saddles.push_back({saddle.vertex, unpaired[saddle.vertex]});
  return diagram;
}

}  // namespace detail

Diagram pair_extrema(const core::ScalarField& field, const core::Progress& progress) {
  progress.update("persistence pairs", 0);
  const detail::Sweep up = detail::sweep(field.mesh(), field.ranks(), detail::Direction::up, progress);
  progress.update("persistence pairs", 0.4);
  const detail::Sweep down = detail::sweep(field.mesh(), field.ranks(), detail::Direction::down, progress);
  progress.update("persistence pairs", 0.8);
  Diagram diagram = detail::pair_sweeps(field, up, down);
  progress.update("persistence pairs", 1);
  return diagram;
}

}  // namespace morsel::persistence
