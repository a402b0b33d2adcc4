#include "morsel/morse/critical_points.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

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

namespace {

/// How often lower and higher neighbours alternate round each vertex: 2k times for k runs of lower neighbours.
/// Counted triangle by triangle, in the order in which they lie in memory: of a triangle's three vertices the
/// middle one sees a lower and a higher neighbour side by side, the other two do not. At a boundary edge the
/// cap is the third, so the higher vertex of the two is the middle one.
class Changes {
 public:
  /// Twice the number of changes, and 1 if the vertex is the highest of some triangle. From kMany on, where
  /// counting ends, the vertex is a saddle.
  using Tally = std::uint8_t;
  static constexpr Tally kMany = 254;

  explicit Changes(const core::ScalarField& field)
      : vertices_(field.mesh().vertex_count()),
        lanes_(std::min<std::size_t>(core::thread_count(), kMostLanes)),
        tally_(lanes_ * vertices_, 0) {
    const core::TriangleMesh& mesh = field.mesh();
    const auto rank = field.ranks();
    const auto triangles = mesh.triangles();
    core::parallel_for(0, lanes_, 1, [&](std::size_t lane, std::size_t) {
      Tally* tally = tally_.data() + lane * vertices_;
      const std::size_t last = triangles.size() * (lane + 1) / lanes_;
      for (std::size_t t = triangles.size() * lane / lanes_; t < last; ++t) {
        const core::Triangle& corner = triangles[t];
        const Index a = rank[corner[0]];
        const Index b = rank[corner[1]];
        const Index c = rank[corner[2]];
        const unsigned order = unsigned{a < b} | unsigned{b < c} << 1 | unsigned{c < a} << 2;
        count_change(tally[corner[kMiddle[order]]]);
        tally[corner[kHighest[order]]] |= 1;
      }
    });
    for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
      for (const Index h : mesh.boundary_loop(k)) {
        const Index a = mesh.origin(h);
        const Index b = mesh.target(h);
        count_change(tally_[rank[a] < rank[b] ? b : a]);
      }
  }

  /// Adds the lanes up for vertices first … last − 1, once, and returns how many of them are critical.
  std::size_t add_up(std::size_t first, std::size_t last) {
    for (std::size_t lane = 1; lane < lanes_; ++lane) {
      const Tally* more = tally_.data() + lane * vertices_;
      for (std::size_t v = first; v < last; ++v) {
        const int changes = (tally_[v] & kMany) + (more[v] & kMany);
        tally_[v] = static_cast<Tally>(std::min<int>(changes, kMany) | ((tally_[v] | more[v]) & 1));
      }
    }
    return last - first -
           std::count_if(tally_.begin() + first, tally_.begin() + last, [](Tally t) { return t / 4 == 1; });
  }

  Tally operator[](std::size_t v) const { return tally_[v]; }

 private:
  static constexpr std::size_t kMostLanes = 8;  // each with tallies of its own, so that threads never meet
  // By (a < b) + 2 (b < c) + 4 (c < a), which is never 0 nor 7.
  static constexpr std::array<std::uint8_t, 8> kMiddle = {0, 2, 0, 1, 1, 0, 2, 0};
  static constexpr std::array<std::uint8_t, 8> kHighest = {0, 1, 2, 2, 0, 1, 0, 0};

  static void count_change(Tally& tally) { tally += tally < kMany ? 2 : 0; }

  std::size_t vertices_;
  std::size_t lanes_;
  std::vector<Tally> tally_;  // per lane and vertex
};

/// What a tally below kMany says about its vertex.
struct Verdict {
  CriticalType type = CriticalType::regular;
  bool is_critical = false;
  std::uint8_t multiplicity = 1;
};

constexpr std::array<Verdict, Changes::kMany> make_verdicts() {
  std::array<Verdict, Changes::kMany> verdicts{};
  for (unsigned tally = 0; tally < verdicts.size(); ++tally) {
    const unsigned runs = tally / 4;
    if (runs == 0) verdicts[tally] = {tally == 0 ? CriticalType::minimum : CriticalType::maximum, true, 1};
    if (runs > 1) verdicts[tally] = {CriticalType::saddle, true, static_cast<std::uint8_t>(runs - 1)};
  }
  return verdicts;
}

/// Fills `points` with the critical points from vertex v on, and returns their counts alone. Which vertices
/// are critical is as good as random, so nothing branches on it.
CriticalPoints find_critical(const core::ScalarField& field, const Changes& changes, Index v,
                             std::span<CriticalPoint> points) {
  static constexpr auto kVerdicts = make_verdicts();
  for (std::size_t found = 0; found < points.size(); ++v) {
    if (changes[v] >= Changes::kMany) {
      points[found++] = classify_vertex(field, v);
      continue;
    }
    const Verdict verdict = kVerdicts[changes[v]];
    points[found] = {v, verdict.type, verdict.multiplicity};
    found += verdict.is_critical ? 1 : 0;
  }
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

}  // namespace

CriticalPoints classify(const core::ScalarField& field, const core::Progress& progress) {
  progress.update("critical points", 0);
  Changes changes(field);
  progress.update("critical points", 0.6);

  const std::size_t vertices = field.mesh().vertex_count();
  std::vector<std::size_t> offset((vertices + core::kGrain - 1) / core::kGrain + 1, 0);
  core::parallel_for(0, vertices, core::kGrain, [&](std::size_t first, std::size_t last) {
    offset[first / core::kGrain + 1] = changes.add_up(first, last);
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
