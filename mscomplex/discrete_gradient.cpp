#include "morsel/mscomplex/discrete_gradient.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// The link of one vertex, counter-clockwise, and its runs of lower neighbours.
struct DiscreteGradient::Scratch {
  struct Neighbor {
    Index halfedge;  // leaving the vertex; kNone for the last neighbour at a boundary, which none leads to
    Index rank;
  };
  std::vector<Neighbor> ring;
  std::vector<std::pair<Index, Index>> other_runs;  // rank of the lowest neighbour, its position in the ring
};

/// Triangle i of the star lies between neighbours i and i + 1, so neighbour i's edge is side `halfedge` of
/// triangle i and side previous(halfedge of i − 1) of triangle i − 1.
void DiscreteGradient::process_lower_star(std::span<const Index> rank, Index v, Scratch& scratch,
                                          CriticalCells& critical) {
  const Index center = rank[v];
  auto& ring = scratch.ring;
  ring.clear();
  const auto is_lower = [&](Index u, Index halfedge) {
    ring.push_back({halfedge, rank[u]});
    return ring.back().rank < center;
  };
  const auto type = core::vertex_kind(mesh_, v, is_lower).type;
  const bool boundary = ring.back().halfedge == kNone;
  const Index last = boundary ? ring[ring.size() - 2].halfedge : ring.back().halfedge;

  if (type == core::CriticalType::minimum) {
    lower_[v] = kNone;
    critical.minima.push_back(v);
    return;
  }

  const auto neighbor_vertex = [&](std::size_t i) {
    return ring[i].halfedge != kNone ? mesh_.target(ring[i].halfedge) : mesh_.apex(last);
  };
  const auto pair_with_next = [&](std::size_t i) {
    const Index side = ring[i].halfedge;
    side_[side / 3] = static_cast<std::uint8_t>(side % 3);
  };
  const auto pair_with_previous = [&](std::size_t i) {
    const Index side = TriangleMesh::previous(ring[i == 0 ? ring.size() - 1 : i - 1].halfedge);
    side_[side / 3] = static_cast<std::uint8_t>(side % 3);
  };
  const auto is_lower_rank = [](const Scratch::Neighbor& a, const Scratch::Neighbor& b) {
    return a.rank < b.rank;
  };
  const std::size_t n = ring.size();

  if (type == core::CriticalType::maximum) {
    // Two fronts of pairs leave the lowest neighbour on both sides. ProcessLowerStars always advances the one
    // whose next triangle is lower, so they meet at the highest triangle.
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), is_lower_rank), ring.end());
    lower_[v] = neighbor_vertex(0);
    std::size_t highest = 0;
    std::pair<Index, Index> highest_ranks{0, 0};
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = ring[i].rank;
      const Index b = ring[i + 1 == n ? 0 : i + 1].rank;
      const std::pair<Index, Index> ranks{std::max(a, b), std::min(a, b)};
      if (ranks > highest_ranks) {
        highest_ranks = ranks;
        highest = i;
      }
    }
    for (std::size_t i = 1; i <= highest; ++i) pair_with_previous(i);
    for (std::size_t i = highest + 1; i < n; ++i) pair_with_next(i);
    const Index t = TriangleMesh::triangle_of(ring[highest].halfedge);
    side_[t] = kCritical;
    critical.maxima.push_back({t, v});
    return;
  }

  // The critical edges come from the runs themselves; by Banchoff's count they are as many as the saddle's
  // multiplicity. Behind an upper neighbour, a closed link is a path like an open one.
  if (!boundary && ring.front().rank < center)
    std::rotate(ring.begin(),
                std::find_if(ring.begin(), ring.end(), [&](const auto& u) { return u.rank > center; }),
                ring.end());
  std::size_t steepest = n;
  auto& others = scratch.other_runs;
  others.clear();
  for (std::size_t i = 0; i < n;) {
    if (ring[i].rank > center) {
      ++i;
      continue;
    }
    std::size_t lowest = i;
    std::size_t end = i;
    for (; end < n && ring[end].rank < center; ++end)
      if (ring[end].rank < ring[lowest].rank) lowest = end;
    for (std::size_t j = i; j < lowest; ++j) pair_with_next(j);
    for (std::size_t j = lowest + 1; j < end; ++j) pair_with_previous(j);
    std::size_t higher = lowest;
    if (steepest == n || ring[lowest].rank < ring[steepest].rank) std::swap(steepest, higher);
    if (higher != n) others.emplace_back(ring[higher].rank, static_cast<Index>(higher));
    i = end;
  }
  lower_[v] = neighbor_vertex(steepest);
  if (others.empty()) return;
  std::sort(others.begin(), others.end());
  for (const auto& [unused, i] : others) {
    const Index halfedge = ring[i].halfedge != kNone ? ring[i].halfedge : TriangleMesh::previous(last);
    critical.saddles.push_back({mesh_.edge(halfedge), v});
  }
}

DiscreteGradient::DiscreteGradient(const core::ScalarField& field, const core::Progress& progress)
    : mesh_(field.mesh()), lower_(mesh_.vertex_count()), side_(mesh_.triangle_count()) {
  progress.update("discrete gradient", 0);
  const auto append = [](auto& sum, const auto& part) { sum.insert(sum.end(), part.begin(), part.end()); };
  CriticalCells critical = core::parallel_reduce(
      0, mesh_.vertex_count(), core::kGrain, CriticalCells{},
      [&](std::size_t first, std::size_t last) {
        progress.throw_if_cancelled();
        CriticalCells part;
        Scratch scratch;
        for (std::size_t v = first; v < last; ++v)
          process_lower_star(field.ranks(), static_cast<Index>(v), scratch, part);
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
