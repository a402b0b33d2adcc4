#include "morsel/morse/critical_points.h"

#include <array>
#include <utility>

#include "morsel/core/parallel.h"

namespace morsel::morse {

using core::Index;

std::string_view to_string(CriticalType type) {
  static constexpr std::array<std::string_view, 4> kNames = {"regular", "minimum", "saddle", "maximum"};
  return kNames[static_cast<std::size_t>(type)];
}

CriticalPoint classify_vertex(const core::ScalarField& field, Index v) {
  const core::TriangleMesh& mesh = field.mesh();
  const auto rank = field.ranks();
  const Index center = rank[v];
  const Index start = mesh.vertex_halfedge(v);
  const bool boundary = mesh.twin(start) == core::kNone;
  // Walk the link once and count where it turns from upper to lower; the cap closes a boundary fan as an
  // upper one.
  bool previous_lower = boundary ? false : rank[mesh.target(start)] < center;
  const bool first_lower = previous_lower;
  bool any_lower = previous_lower;
  bool any_upper = boundary || !previous_lower;
  Index lower_runs = 0;
  const auto visit = [&](Index u) {
    const bool lower = rank[u] < center;
    lower_runs += static_cast<Index>(lower && !previous_lower);
    any_lower |= lower;
    any_upper |= !lower;
    previous_lower = lower;
  };
  Index h = boundary ? start : mesh.next_around(start);
  if (boundary) {
    Index last = h;
    for (; h != core::kNone; h = mesh.next_around(h)) {
      visit(mesh.target(h));
      last = h;
    }
    visit(mesh.apex(last));
  } else {
    for (; h != start; h = mesh.next_around(h)) visit(mesh.target(h));
    lower_runs += static_cast<Index>(first_lower && !previous_lower);
  }
  if (!any_lower) return {v, CriticalType::minimum, 1};
  if (!any_upper) return {v, CriticalType::maximum, 1};
  if (lower_runs <= 1) return {v, CriticalType::regular, 1};
  return {v, CriticalType::saddle, lower_runs - 1};
}

CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress) {
  progress.update("critical points", 0);
  CriticalPoints result = core::parallel_reduce(
      0, field.mesh().vertex_count(), core::kGrain, CriticalPoints{},
      [&](std::size_t first, std::size_t last) {
        CriticalPoints part;
        for (std::size_t v = first; v < last; ++v) {
          const CriticalPoint point = classify_vertex(field, static_cast<Index>(v));
          if (point.type != CriticalType::regular) part.points.push_back(point);
        }
        return part;
      },
      [](CriticalPoints sum, CriticalPoints part) {
        sum.points.insert(sum.points.end(), part.points.begin(), part.points.end());
        return sum;
      });
  for (const CriticalPoint& point : result.points) {
    if (point.type == CriticalType::minimum) ++result.minima;
    if (point.type == CriticalType::maximum) ++result.maxima;
    if (point.type == CriticalType::saddle) {
      ++result.saddles;
      result.saddle_multiplicity += point.multiplicity;
    }
  }
  progress.update("critical points", 1);
  return result;
}

}  // namespace morsel::morse
