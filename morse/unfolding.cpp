#include "morsel/morse/unfolding.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "morsel/core/field/link.h"
#include "morsel/morse/critical_points.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::kNone;
using core::ScalarField;

/// Counts of the critical vertices among some vertices, as far as unfolding needs them.
struct Tally {
  long extrema = 0;
  long saddles = 0;
  long multiplicity = 0;

  void add(const CriticalPoint& point, long sign) {
    if (point.type == CriticalType::regular) return;
    const bool saddle = point.type == CriticalType::saddle;
    extrema += saddle ? 0 : sign;
    saddles += saddle ? sign : 0;
    multiplicity += saddle ? sign * static_cast<long>(point.multiplicity) : 0;
  }
};

/// The neighbour past which v is to be moved; kNone if there is none in this direction.
Index find_move(const ScalarField& field, Index v, bool up) {
  std::vector<Index> passed;
  core::for_each_neighbor(field.mesh(), v, [&](Index u) {
    if (field.is_lower(v, u) == up) passed.push_back(u);
  });
  std::sort(passed.begin(), passed.end(),
            [&](Index a, Index b) { return up ? field.is_lower(a, b) : field.is_lower(b, a); });
  Tally before;
  before.add(classify_vertex(field, v), 1);
  Tally others;  // how the neighbours' tally changed so far
  for (const Index u : passed) {
    // The position of v now: just past u.
    const auto v_is_lower_than = [&](Index w) { return up ? field.is_lower(u, w) : !field.is_lower(w, u); };
    others.add(classify_vertex(field, u), -1);
    others.add(classify_link(field.mesh(), u, [&](Index w) { return w == v ? !up : field.is_lower(w, u); }),
               1);
    Tally now = others;
    now.add(classify_link(field.mesh(), v, [&](Index w) { return !v_is_lower_than(w); }), 1);
    if (now.extrema == before.extrema && now.multiplicity == before.multiplicity &&
        now.saddles == before.saddles + 1)
      return u;
  }
  return kNone;
}

/// v right after u in the order (right before it if not `up`), with its value.
ScalarField moved(const ScalarField& field, Index v, Index u, bool up) {
  std::vector<double> values(field.values().begin(), field.values().end());
  values[v] = values[u];
  core::FlatArray<Index> rank(field.ranks().size());
  const Index from = field.rank(v);
  const Index to = field.rank(u);
  for (std::size_t w = 0; w < rank.size(); ++w) {
    const Index r = field.rank(static_cast<Index>(w));
    if (r == from)
      rank[w] = to;
    else if (up)
      rank[w] = r > from && r <= to ? r - 1 : r;
    else
      rank[w] = r >= to && r < from ? r + 1 : r;
  }
  return {field.mesh(), std::move(values), std::move(rank)};
}

}  // namespace

std::optional<Unfolding> unfold_saddle(const ScalarField& field, Index v) {
  if (classify_vertex(field, v).multiplicity < 2) return std::nullopt;
  const Index above = find_move(field, v, true);
  const Index below = find_move(field, v, false);
  if (above == kNone && below == kNone) return std::nullopt;
  const auto change = [&](Index u) {
    return u == kNone ? HUGE_VAL : std::abs(field.value(u) - field.value(v));
  };
  const bool up = change(above) <= change(below);
  const Index u = up ? above : below;
  return Unfolding{moved(field, v, u, up), change(u)};
}

}  // namespace morsel::morse
