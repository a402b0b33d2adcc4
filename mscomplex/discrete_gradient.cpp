#include "morsel/mscomplex/discrete_gradient.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// Processes one lower star after another.
///
/// Triangle i of the star lies between neighbours i and i + 1, so neighbour i's edge is side `halfedge` of
/// triangle i and side previous(halfedge of i − 1) of triangle i − 1.
class DiscreteGradient::LowerStar {
 public:
  LowerStar(DiscreteGradient& gradient, std::span<const Index> rank) : gradient_(gradient), rank_(rank) {}

  void process(Index v, CriticalCells& critical) {
    const Index center = rank_[v];
    ring_.clear();
    const auto is_lower = [&](Index u, Index halfedge) {
      ring_.push_back({halfedge, rank_[u]});
      return ring_.back().rank < center;
    };
    switch (core::vertex_kind(gradient_.mesh_, v, is_lower).type) {
      case core::CriticalType::minimum:
        gradient_.lower_[v] = kNone;
        critical.minima.push_back(v);
        break;
      case core::CriticalType::maximum:
        pair_around_maximum(v, critical);
        break;
      default:
        pair_runs(v, center, critical);
    }
  }

 private:
  struct Neighbor {
    Index halfedge;  // leaving the vertex; kNone for the last neighbour at a boundary, which none leads to
    Index rank;
  };

  /// Two fronts of pairs leave the lowest neighbour on both sides. ProcessLowerStars always advances the one
  /// whose next triangle is lower, so they meet at the highest triangle.
  void pair_around_maximum(Index v, CriticalCells& critical) {
    const std::size_t n = ring_.size();
    const auto is_lower = [](const Neighbor& a, const Neighbor& b) { return a.rank < b.rank; };
    std::rotate(ring_.begin(), std::min_element(ring_.begin(), ring_.end(), is_lower), ring_.end());
    gradient_.lower_[v] = gradient_.mesh_.target(ring_[0].halfedge);
    std::size_t highest = 0;
    std::pair<Index, Index> highest_ranks{0, 0};
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = ring_[i].rank;
      const Index b = ring_[i + 1 == n ? 0 : i + 1].rank;
      const std::pair<Index, Index> ranks{std::max(a, b), std::min(a, b)};
      if (ranks > highest_ranks) {
        highest_ranks = ranks;
        highest = i;
      }
    }
    for (std::size_t i = 1; i <= highest; ++i) pair_with_previous(i);
    for (std::size_t i = highest + 1; i < n; ++i) pair_with_next(i);
    const Index t = TriangleMesh::triangle_of(ring_[highest].halfedge);
    gradient_.side_[t] = kCritical;
    critical.maxima.push_back({t, v});
  }

  /// At a regular vertex or a saddle. The critical edges come from the runs themselves; by Banchoff's count
  /// they are as many as the saddle's multiplicity.
  void pair_runs(Index v, Index center, CriticalCells& critical) {
    const TriangleMesh& mesh = gradient_.mesh_;
    const std::size_t n = ring_.size();
    const bool boundary = ring_.back().halfedge == kNone;
    const Index last = ring_[boundary ? n - 2 : n - 1].halfedge;
    // Behind an upper neighbour, a closed link is a path like an open one.
    if (!boundary && ring_.front().rank < center)
      std::rotate(ring_.begin(),
                  std::find_if(ring_.begin(), ring_.end(), [&](const auto& u) { return u.rank > center; }),
                  ring_.end());
    const std::size_t steepest = pair_each_run(center);
    const Index leaving = ring_[steepest].halfedge;
    gradient_.lower_[v] = leaving != kNone ? mesh.target(leaving) : mesh.apex(last);
    if (other_runs_.empty()) return;
    std::sort(other_runs_.begin(), other_runs_.end());
    for (const auto& [unused, i] : other_runs_) {
      const Index halfedge = ring_[i].halfedge != kNone ? ring_[i].halfedge : TriangleMesh::previous(last);
      critical.saddles.push_back({mesh.edge(halfedge), v});
    }
  }

  /// Pairs the edges within each run away from its lowest neighbour. Returns the lowest neighbour of all;
  /// the lowest ones of the other runs are in `other_runs_` afterwards.
  std::size_t pair_each_run(Index center) {
    const std::size_t n = ring_.size();
    std::size_t steepest = n;
    other_runs_.clear();
    for (std::size_t i = 0; i < n;) {
      if (ring_[i].rank > center) {
        ++i;
        continue;
      }
      std::size_t lowest = i;
      std::size_t end = i;
      for (; end < n && ring_[end].rank < center; ++end)
        if (ring_[end].rank < ring_[lowest].rank) lowest = end;
      for (std::size_t j = i; j < lowest; ++j) pair_with_next(j);
      for (std::size_t j = lowest + 1; j < end; ++j) pair_with_previous(j);
      std::size_t higher = lowest;
      if (steepest == n || ring_[lowest].rank < ring_[steepest].rank) std::swap(steepest, higher);
      if (higher != n) other_runs_.emplace_back(ring_[higher].rank, static_cast<Index>(higher));
      i = end;
    }
    return steepest;
  }

  /// Pairs the edge to neighbour i with the triangle after it, or with the one before it.
  void pair_with_next(std::size_t i) { pair(ring_[i].halfedge); }
  void pair_with_previous(std::size_t i) { pair(TriangleMesh::previous(ring_[i - 1].halfedge)); }
  void pair(Index side) { gradient_.side_[side / 3] = static_cast<std::uint8_t>(side % 3); }

  DiscreteGradient& gradient_;
  std::span<const Index> rank_;
  std::vector<Neighbor> ring_;                       // the link, counter-clockwise
  std::vector<std::pair<Index, Index>> other_runs_;  // rank of the lowest neighbour, its position in the ring
};

DiscreteGradient::DiscreteGradient(const core::ScalarField& field, const core::Progress& progress)
    : mesh_(field.mesh()), lower_(mesh_.vertex_count()), side_(mesh_.triangle_count()) {
  progress.update("discrete gradient", 0);
  const auto append = [](auto& sum, const auto& part) { sum.insert(sum.end(), part.begin(), part.end()); };
  CriticalCells critical = core::parallel_reduce(
      0, mesh_.vertex_count(), core::kGrain, CriticalCells{},
      [&](std::size_t first, std::size_t last) {
        progress.throw_if_cancelled();
        CriticalCells part;
        LowerStar star(*this, field.ranks());
        for (std::size_t v = first; v < last; ++v) star.process(static_cast<Index>(v), part);
        return part;
      },
      [&](CriticalCells sum, const CriticalCells& part) {
        append(sum.minima, part.minima);
        append(sum.saddles, part.saddles);
        append(sum.maxima, part.maxima);
        return sum;
      });
  minima_ = std::move(critical.minima);
  saddles_ = std::move(critical.saddles);
  maxima_ = std::move(critical.maxima);
  progress.update("discrete gradient", 1);
}

}  // namespace morsel::mscomplex
