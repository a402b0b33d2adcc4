#include "support/greedy_hierarchy.h"

#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace morsel::test {

using core::Index;
using mscomplex::NodeKind;

std::vector<GreedyCancellation> cancel_greedily(const mscomplex::MorseSmaleComplex& complex) {
  std::vector<Index> end(complex.arc_count());
  std::vector<std::vector<Index>> arcs(complex.node_count());
  std::vector<double> value(complex.node_count());
  std::vector<bool> is_cap(complex.node_count());
  for (Index n = 0; n < complex.node_count(); ++n) {
    value[n] = complex.node(n).value;
    is_cap[n] = complex.kind(n) == NodeKind::cap;
  }
  std::vector<bool> gone(complex.node_count(), false);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto length = [&](Index arc) { return std::abs(value[complex.arc_saddle(arc)] - value[end[arc]]); };
  const auto push = [&](Index arc) {
    if (!is_cap[end[arc]]) queue.emplace(length(arc), arc);
  };
  for (Index a = 0; a < complex.arc_count(); ++a) {
    end[a] = complex.arc_end(a);
    arcs[end[a]].push_back(a);
    push(a);
  }
  std::vector<GreedyCancellation> result;
  while (!queue.empty()) {
    const auto [difference, arc] = queue.top();
    queue.pop();
    const Index saddle = complex.arc_saddle(arc);
    if (gone[saddle] || is_cap[end[arc]] || length(arc) != difference) continue;
    const Index extremum = end[arc];
    const Index survivor = end[arc % 4 < 2 ? arc + 2 : arc - 2];
    if (extremum == survivor) continue;
    result.push_back({saddle, extremum, difference});
    gone[saddle] = true;
    for (const Index a : arcs[extremum]) {
      if (gone[complex.arc_saddle(a)]) continue;
      end[a] = survivor;
      arcs[survivor].push_back(a);
      push(a);
    }
    arcs[extremum] = {};
  }
  return result;
}

}  // namespace morsel::test
