// The gradient's tables against the definition of a discrete gradient from lower stars.

#include <algorithm>
#include <vector>

#include "morsel/core/require.h"
#include "morsel/mscomplex/discrete_gradient.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

constexpr core::Require require("DiscreteGradient::validate");

/// Follows next() from everywhere; a walk that meets itself is a closed V-path.
template <class Next>
void require_acyclic(Index count, const Next& next, const char* what) {
  std::vector<Index> walk_of(count, kNone);
  for (Index i = 0; i < count; ++i) {
    Index j = i;
    for (; j != kNone && walk_of[j] == kNone; j = next(j)) walk_of[j] = i;
    require(j == kNone || walk_of[j] != i, what, i);
  }
}

}  // namespace

void DiscreteGradient::validate(const core::ScalarField& field) const {
  require(field.mesh().is_same(mesh_), "the field is on another mesh than the gradient; vertices",
          mesh_.vertex_count());
  const auto rank = field.ranks();
  const auto highest = [&](auto cell) {
    return *std::max_element(cell.begin(), cell.end(), [&](Index a, Index b) { return rank[a] < rank[b]; });
  };

  // Every cell's pairs, counted.
  std::vector<Index> vertex_pairs(mesh_.vertex_count(), 0);
  std::vector<Index> edge_pairs(mesh_.edge_count(), 0);
  std::vector<Index> ring;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    mesh_.neighbors(v, ring);
    const Index lowest =
        *std::min_element(ring.begin(), ring.end(), [&](Index a, Index b) { return rank[a] < rank[b]; });
    require(lower_[v] == (rank[lowest] < rank[v] ? lowest : kNone),
            "not its lowest neighbour: the pair of vertex", v);
    if (lower_[v] != kNone) ++vertex_pairs[v];
  }
  for (Index e = 0; e < mesh_.edge_count(); ++e) {
    const auto [a, b] = mesh_.edge_vertices(e);
    require(lower_[a] != b || lower_[b] != a, "both ends are paired with edge", e);
    if (lower_[a] == b || lower_[b] == a) ++edge_pairs[e];
  }
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    require(side_[t] <= kCritical, "no such side of triangle", t);
    if (side_[t] == kCritical) continue;
    const Index e = mesh_.edge(3 * t + side_[t]);
    ++edge_pairs[e];
    require(highest(mesh_.edge_vertices(e)) == highest(mesh_.triangle(t)),
            "pair across lower stars: triangle", t);
    require(paired_triangle(e) == t, "paired_triangle() of edge", e);
  }
  for (Index e = 0; e < mesh_.edge_count(); ++e) require(edge_pairs[e] <= 1, "several pairs of edge", e);

  require_acyclic(
      mesh_.vertex_count(), [&](Index v) { return descend(v); }, "closed V-path through vertex");
  require_acyclic(
      mesh_.triangle_count(), [&](Index t) { return ascend(t); }, "closed V-path through triangle");

  // The lists are the cells in no pair, in their order.
  std::vector<Index> minima;
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (vertex_pairs[v] == 0) minima.push_back(v);
  require(std::equal(minima.begin(), minima.end(), minima_.begin(), minima_.end()),
          "list of minima; vertices", static_cast<Index>(minima.size()));

  std::vector<CriticalCell> saddles;
  std::vector<CriticalCell> maxima;
  for (Index e = 0; e < mesh_.edge_count(); ++e) {
    require(is_critical_edge(e) == (edge_pairs[e] == 0), "is_critical_edge() of edge", e);
    if (edge_pairs[e] == 0) saddles.push_back({e, highest(mesh_.edge_vertices(e))});
  }
  for (Index t = 0; t < mesh_.triangle_count(); ++t)
    if (side_[t] == kCritical) maxima.push_back({t, highest(mesh_.triangle(t))});
  const auto lower_end_rank = [&](const CriticalCell& saddle) {
    const auto [a, b] = mesh_.edge_vertices(saddle.cell);
    return std::min(rank[a], rank[b]);
  };
  std::sort(saddles.begin(), saddles.end(), [&](const CriticalCell& a, const CriticalCell& b) {
    return a.vertex < b.vertex || (a.vertex == b.vertex && lower_end_rank(a) < lower_end_rank(b));
  });
  std::sort(maxima.begin(), maxima.end(),
            [](const CriticalCell& a, const CriticalCell& b) { return a.vertex < b.vertex; });
  require(saddles == saddles_, "list of saddles; edges", static_cast<Index>(saddles.size()));
  require(maxima == maxima_, "list of maxima; triangles", static_cast<Index>(maxima.size()));

  std::vector<long> euler(mesh_.component_count(), 0);
  for (const Index v : minima_) ++euler[mesh_.component_of_vertex(v)];
  for (const CriticalCell& s : saddles_) --euler[mesh_.component_of_vertex(s.vertex)];
  for (const CriticalCell& m : maxima_) ++euler[mesh_.component_of_vertex(m.vertex)];
  for (Index c = 0; c < mesh_.component_count(); ++c)
    require(euler[c] == mesh_.euler_characteristic(c), "Euler's identity in component", c);
}

}  // namespace morsel::mscomplex
