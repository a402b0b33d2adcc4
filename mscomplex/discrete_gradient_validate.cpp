// The gradient's tables against the definition of a discrete gradient from lower stars.

#include <algorithm>
#include <vector>

#include "morsel/core/require.h"
#include "morsel/mscomplex/discrete_gradient.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

namespace {

constexpr core::Require require_gradient("DiscreteGradient::validate");

/// Follows next() from everywhere; a walk that meets itself is a closed V-path.
template <class Next>
void require_acyclic(Index count, const Next& next, const char* what) {
  std::vector<Index> walk_of(count, kNone);
  for (Index i = 0; i < count; ++i) {
    Index j = i;
    for (; j != kNone && walk_of[j] == kNone; j = next(j)) walk_of[j] = i;
    require_gradient(j == kNone || walk_of[j] != i, what, i);
  }
}

}  // namespace

void DiscreteGradient::validate() const {
  // Every cell's pairs, counted.
  std::vector<Index> edge_pairs(mesh_.edge_count(), 0);
  std::vector<Index> ring;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    if (lower_[v] == kNone) continue;
    mesh_.neighbors(v, ring);
    require_gradient(std::find(ring.begin(), ring.end(), lower_[v]) != ring.end(),
                     "paired with no edge of its own: vertex", v);
  }
  for (Index e = 0; e < mesh_.edge_count(); ++e) {
    const auto [a, b] = mesh_.edge_vertices(e);
    require_gradient(lower_[a] != b || lower_[b] != a, "both ends are paired with edge", e);
    if (lower_[a] == b || lower_[b] == a) ++edge_pairs[e];
  }
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    require_gradient(side_[t] <= kCritical, "no such side of triangle", t);
    if (side_[t] == kCritical) continue;
    const Index e = mesh_.edge(3 * t + side_[t]);
    ++edge_pairs[e];
    require_gradient(paired_triangle(e) == t, "paired_triangle() of edge", e);
  }
  for (Index e = 0; e < mesh_.edge_count(); ++e) {
    require_gradient(edge_pairs[e] <= 1, "several pairs of edge", e);
    require_gradient(is_critical_edge(e) == (edge_pairs[e] == 0), "is_critical_edge() of edge", e);
  }
  require_acyclic(
      mesh_.vertex_count(), [&](Index v) { return descend(v); }, "closed V-path through vertex");
  require_acyclic(
      mesh_.triangle_count(), [&](Index t) { return ascend(t); }, "closed V-path through triangle");

  // The lists are the cells in no pair, in their order.
  std::vector<Index> minima;
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (lower_[v] == kNone) minima.push_back(v);
  require_gradient(minima == minima_, "list of minima; vertices", static_cast<Index>(minima.size()));
  const auto by_vertex = [](const CriticalCell& a, const CriticalCell& b) { return a.vertex < b.vertex; };
  const auto check_list = [&](const std::vector<CriticalCell>& list, const auto& is_critical, Index cells,
                              const char* what) {
    require_gradient(std::is_sorted(list.begin(), list.end(), by_vertex), what,
                     static_cast<Index>(list.size()));
    std::vector<Index> listed;
    for (const CriticalCell& critical : list) listed.push_back(critical.cell);
    std::sort(listed.begin(), listed.end());
    std::vector<Index> found;
    for (Index cell = 0; cell < cells; ++cell)
      if (is_critical(cell)) found.push_back(cell);
    require_gradient(listed == found, what, static_cast<Index>(found.size()));
  };
  check_list(
      saddles_, [&](Index e) { return edge_pairs[e] == 0; }, mesh_.edge_count(), "list of saddles; edges");
  check_list(
      maxima_, [&](Index t) { return side_[t] == kCritical; }, mesh_.triangle_count(),
      "list of maxima; triangles");

  std::vector<long> euler(mesh_.component_count(), 0);
  for (const Index v : minima_) ++euler[mesh_.component_of_vertex(v)];
  for (const CriticalCell& s : saddles_) --euler[mesh_.component_of_vertex(s.vertex)];
  for (const CriticalCell& m : maxima_) ++euler[mesh_.component_of_vertex(m.vertex)];
  for (Index c = 0; c < mesh_.component_count(); ++c)
    require_gradient(euler[c] == mesh_.euler_characteristic(c), "Euler's identity in component", c);
}

void DiscreteGradient::validate(const core::ScalarField& field) const {
  require_gradient(field.mesh().is_same(mesh_), "the field is on another mesh than the gradient; vertices",
                   mesh_.vertex_count());
  validate();
  const auto rank = field.ranks();
  const auto by_rank = [&](Index a, Index b) { return rank[a] < rank[b]; };
  const auto highest = [&](auto cell) { return *std::max_element(cell.begin(), cell.end(), by_rank); };
  std::vector<Index> ring;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    mesh_.neighbors(v, ring);
    const Index lowest = *std::min_element(ring.begin(), ring.end(), by_rank);
    require_gradient(lower_[v] == (rank[lowest] < rank[v] ? lowest : kNone),
                     "not its lowest neighbour: the pair of vertex", v);
  }
  for (Index t = 0; t < mesh_.triangle_count(); ++t)
    if (side_[t] != kCritical)
      require_gradient(
          highest(mesh_.edge_vertices(mesh_.edge(3 * t + side_[t]))) == highest(mesh_.triangle(t)),
          "pair across lower stars: triangle", t);
  for (const CriticalCell& m : maxima_)
    require_gradient(m.vertex == highest(mesh_.triangle(m.cell)), "not at its highest vertex: triangle",
                     m.cell);
  for (const CriticalCell& s : saddles_)
    require_gradient(s.vertex == highest(mesh_.edge_vertices(s.cell)), "not at its highest vertex: edge",
                     s.cell);
  const auto lower_end_rank = [&](const CriticalCell& saddle) {
    const auto [a, b] = mesh_.edge_vertices(saddle.cell);
    return std::min(rank[a], rank[b]);
  };
  require_gradient(std::is_sorted(saddles_.begin(), saddles_.end(),
                                  [&](const CriticalCell& a, const CriticalCell& b) {
                                    return a.vertex < b.vertex ||
                                           (a.vertex == b.vertex && lower_end_rank(a) < lower_end_rank(b));
                                  }),
                   "order of saddles at one vertex; saddles", static_cast<Index>(saddles_.size()));
}

}  // namespace morsel::mscomplex
