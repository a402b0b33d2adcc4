#include "morsel/morse/critical_points.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/field/classification.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

using core::Index;

CriticalPoint classify_vertex(const core::ScalarField& field, Index v) {
  const core::VertexKind kind = core::vertex_kind(field, v);
  return {v, kind.type, kind.multiplicity};
}

CriticalPoints counts_of(std::span<const CriticalPoint> points) {
  CriticalPoints counts;
  for (const CriticalPoint& point : points) {
    const bool is_saddle = point.type == CriticalType::saddle;
    counts.minima += point.type == CriticalType::minimum ? 1 : 0;
    counts.saddles += is_saddle ? 1 : 0;
    counts.saddle_multiplicity += is_saddle ? point.multiplicity : 0;
  }
  counts.maxima = points.size() - counts.minima - counts.saddles;
  return counts;
}

namespace {

/// LinkChanges::bits() from which on a vertex is a saddle whose link must be walked.
constexpr std::uint8_t kMany = 2 * core::LinkChanges::kMostChanges;

/// The kind of a vertex by its bits, below kMany: looked up since computing it would branch.
struct Verdict {
  CriticalType type = CriticalType::regular;
  bool is_critical = false;
  std::uint8_t multiplicity = 1;
};

constexpr std::array<Verdict, kMany> make_verdicts() {
  std::array<Verdict, kMany> verdicts{};
  for (std::size_t bits = 0; bits < verdicts.size(); ++bits) {
    const auto kind = core::LinkChanges::from_bits(static_cast<std::uint8_t>(bits)).kind();
    verdicts[bits] = {kind.type, kind.type != CriticalType::regular,
                      static_cast<std::uint8_t>(kind.multiplicity)};
  }
  return verdicts;
}

/// Fills `points` with the critical points from vertex v on, and returns their counts alone. Which vertices
/// are critical is as good as random, so nothing branches on it.
CriticalPoints find_critical(const core::ScalarField& field, std::span<const core::LinkChanges> changes,
                             Index v, std::span<CriticalPoint> points) {
  static constexpr auto kVerdicts = make_verdicts();
  for (std::size_t found = 0; found < points.size(); ++v) {
    if (changes[v].bits() >= kMany) {
      points[found++] = classify_vertex(field, v);
      continue;
    }
    const Verdict verdict = kVerdicts[changes[v].bits()];
    points[found] = {v, verdict.type, verdict.multiplicity};
    found += verdict.is_critical ? 1 : 0;
  }
  return counts_of(points);
}

}  // namespace

CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress) {
  progress.update("critical points", 0);
  const std::vector<core::LinkChanges> changes = core::link_changes(field.mesh(), field.ranks());
  progress.update("critical points", 0.6);

  const std::size_t vertices = field.mesh().vertex_count();
  std::vector<std::size_t> offset((vertices + core::kGrain - 1) / core::kGrain + 1, 0);
  core::parallel_for(0, vertices, core::kGrain, [&](std::size_t first, std::size_t last) {
    offset[first / core::kGrain + 1] =
        static_cast<std::size_t>(std::count_if(changes.begin() + static_cast<std::ptrdiff_t>(first),
                                               changes.begin() + static_cast<std::ptrdiff_t>(last),
                                               [](core::LinkChanges c) { return !c.is_regular(); }));
  });
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<CriticalPoint> points(offset.back());
  CriticalPoints result = core::parallel_reduce(
      0, vertices, core::kGrain, CriticalPoints{},
      [&](std::size_t first, std::size_t) {
        progress.throw_if_cancelled();
        const std::size_t begin = offset[first / core::kGrain];
        const std::size_t end = offset[first / core::kGrain + 1];
        return find_critical(field, changes, static_cast<Index>(first),
                             std::span(points).subspan(begin, end - begin));
      },
      [](CriticalPoints sum, const CriticalPoints& part) {
        sum.minima += part.minima;
        sum.saddles += part.saddles;
        sum.saddle_multiplicity += part.saddle_multiplicity;
        sum.maxima += part.maxima;
        return sum;
      });
  result.points = std::move(points);
  progress.update("critical points", 1);
  return result;
}

}  // namespace morsel::morse
