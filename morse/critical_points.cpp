#include "morsel/morse/critical_points.h"

#include <array>
#include <utility>

#include "morsel/core/link.h"
#include "morsel/core/parallel.h"

namespace morsel::morse {

using core::Index;

std::string_view to_string(CriticalType type) {
  static constexpr std::array<std::string_view, 4> kNames = {"regular", "minimum", "saddle", "maximum"};
  return kNames[static_cast<std::size_t>(type)];
}

CriticalPoint classify_vertex(const core::ScalarField& field, Index v) {
  const auto rank = field.ranks();
  const Index center = rank[v];
  const core::LinkPart lower = core::link_part(
      field.mesh(), v, /*cap_inside=*/false, [&](Index u) { return rank[u] < center; }, [](Index) {});
  if (lower.empty) return {v, CriticalType::minimum, 1};
  if (lower.whole) return {v, CriticalType::maximum, 1};
  if (lower.runs <= 1) return {v, CriticalType::regular, 1};
  return {v, CriticalType::saddle, lower.runs - 1};
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
