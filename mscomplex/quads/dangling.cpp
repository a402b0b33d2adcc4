// Finding and cancelling dangling arcs.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/layout_conditions.h"

namespace morsel::mscomplex {

using core::Index;

namespace {

struct Dangling {
  double persistence;
  Index node;
  Index arc;
};

std::vector<Dangling> find_dangling(const MorseSmaleComplex& complex) {
  std::vector<Dangling> found;
  for (Index n = 0; n < complex.node_count(); ++n) {
    const auto arcs = complex.arcs_ending_at(n);
    if (arcs.size() != 1 || complex.kind(n) == NodeKind::cap) continue;
    const double saddle = complex.node(complex.arc_saddle(arcs[0])).value;
    found.push_back({std::abs(saddle - complex.node(n).value), n, arcs[0]});
  }
  std::sort(found.begin(), found.end(), [](const Dangling& a, const Dangling& b) {
    return std::pair(a.persistence, a.node) < std::pair(b.persistence, b.node);
  });
  return found;
}

}  // namespace

void require_arcs(const MorseSmaleComplex& complex) {
  const core::TriangleMesh& mesh = complex.mesh();
  std::vector<bool> has_saddle(mesh.component_count(), false);
  for (const CriticalCell& s : complex.gradient().saddles())
    has_saddle[mesh.component_of_vertex(s.vertex)] = true;
  const auto bare = std::find(has_saddle.begin(), has_saddle.end(), false);
  if (bare != has_saddle.end())
    throw core::BadInput(
        "there is no quad layout: " +
        (has_saddle.size() == 1
             ? std::string("the field")
             : "on component " + std::to_string(bare - has_saddle.begin()) + " of the surface the field") +
        " has one minimum, one maximum or boundary loop, and no saddle (any more); a field with more "
        "critical points, such as an eigenfunction of higher index, would help");
}

void require_no_dangling(const MorseSmaleComplex& complex) {
  const std::vector<Dangling> dangling = find_dangling(complex);
  if (dangling.empty()) return;
  throw core::BadInput(
      std::to_string(dangling.size()) + " extrema have a single arc, which no quad patch can have on " +
      "both sides, the first at vertex " + std::to_string(complex.node(dangling[0].node).vertex) +
      ": cancel them first (repair_dangling)");
}

RepairedComplex repair_dangling(const core::ScalarField& field, MorseSmaleComplex complex,
                                const core::Progress& progress) {
  RepairedComplex result{std::move(complex), {}};
  for (;;) {
    require_arcs(result.complex);
    const MorseSmaleComplex& now = result.complex;
    std::vector<Index> arcs;
    std::vector<bool> used(now.saddle_count(), false);
    for (const Dangling& d : find_dangling(now)) {
      if (used[d.arc / 4]) continue;  // its saddle is cancelled with another one; left to the next round
      used[d.arc / 4] = true;
      arcs.push_back(d.arc);
      result.repairs.push_back(
          {now.kind(d.node), now.node(d.node).vertex, now.node(now.arc_saddle(d.arc)).vertex, d.persistence});
    }
    if (arcs.empty()) return result;
    result.complex = MorseSmaleComplex(field, now.gradient().with_reversed(arcs), progress);
  }
}

}  // namespace morsel::mscomplex
