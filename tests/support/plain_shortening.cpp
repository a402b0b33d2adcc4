// The slow reference of shortening: the whole cut is decomposed again after each change.

#include "support/plain_shortening.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/mscomplex/cut.h"
#include "morsel/mscomplex/cutting/cut_edges.h"
#include "morsel/mscomplex/cutting/edge_path_search.h"

namespace morsel::test {
namespace {

using namespace mscomplex;
using core::Index;
using core::kNone;
using core::TriangleMesh;

/// Replaced lengths must be shorter by more than what rounding makes of sums.
constexpr double kShorter = 1 - 1e-12;

/// One step along the rim of a surface with walls: all corners that it has at one vertex.
class RimWalk {
 public:
  /// From the rim's corner that half-edge `inside`, no wall, leaves; there must be walls at its origin.
  RimWalk(const TriangleMesh& mesh, const Walls& walls, Index inside) : mesh_(mesh), walls_(walls) {
    while (!walls.is_wall(TriangleMesh::previous(inside))) inside = mesh.twin(TriangleMesh::previous(inside));
    start_ = here_ = TriangleMesh::previous(inside);
  }
  /// Calls visit(h) for each half-edge that leaves the corner here inwards and goes on along the rim.
  template <class Visit>
  void step(const Visit& visit) {
    Index h = TriangleMesh::next(here_);
    for (; !walls_.is_wall(h); h = TriangleMesh::next(mesh_.twin(h))) visit(h);
    here_ = h;
  }
  bool is_round() const { return here_ == start_; }

 private:
  const TriangleMesh& mesh_;
  const Walls& walls_;
  Index start_;
  Index here_;  // a half-edge along the rim, into the corner
};

/// A path and when it was last tried.
struct Trial {
  std::vector<Index> halfedges;
  Index time = 0;
};

class Shortener {
 public:
  Shortener(const TriangleMesh& mesh, const CutGraph& cut)
      : mesh_(mesh),
        walls_(mesh, cut.edges),
        search_(mesh),
        is_near_(mesh.halfedge_count(), 0),
        time_of_edge_(mesh.edge_count(), 0) {
    std::vector<Index> edges = cut.edges;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    take(std::move(edges));
  }

  ShortenedCut run(std::size_t rounds, const core::Progress& progress) {
    ShortenedCut result;
    const std::size_t most = rounds * graph_.paths.size();
    for (std::size_t p; (p = next_path()) < graph_.paths.size() && result.attempts < most;
         ++result.attempts) {
      progress.update("shortening", static_cast<double>(result.attempts) / static_cast<double>(most));
      if (replace(p, progress)) ++result.replaced;
    }
    result.is_settled = next_path() == graph_.paths.size();
    result.cut = std::move(graph_);
    return result;
  }

 private:
  void take(std::vector<Index> edges) {
    graph_ = make_cut_graph(mesh_, std::move(edges));
    trials_.clear();
    for (const CutPath& path : graph_.paths) {
      Trial trial{halfedges_along(mesh_, path.vertices), kNone};
      for (const Index h : trial.halfedges) trial.time = std::min(trial.time, time_of_edge_[mesh_.edge(h)]);
      trials_.push_back(std::move(trial));
    }
  }

  /// The path whose trial is the longest ago, of those the longest; the number of paths if all were tried
  /// since the cut last changed.
  std::size_t next_path() const {
    std::size_t best = trials_.size();
    for (std::size_t p = 0; p < trials_.size(); ++p) {
      if (trials_[p].time >= time_of_change_) continue;
      if (best == trials_.size() || trials_[p].time < trials_[best].time ||
          (trials_[p].time == trials_[best].time && graph_.paths[p].length > graph_.paths[best].length))
        best = p;
    }
    return best;
  }

  bool replace(std::size_t p, const core::Progress& progress) {
    ++time_;
    const std::vector<Index>& old_path = trials_[p].halfedges;
    for (const Index h : old_path) walls_.remove(mesh_.edge(h));
    const std::vector<Index> path = shorter(old_path, graph_.paths[p].length, progress);
    const std::vector<Index>& kept = path.empty() ? old_path : path;
    for (const Index h : kept) {
      walls_.add(mesh_.edge(h));
      time_of_edge_[mesh_.edge(h)] = time_;
    }
    trials_[p].time = time_;
    if (path.empty()) return false;

    time_of_change_ = time_;
    std::vector<Index> edges;
    for (const Index e : graph_.edges)
      if (walls_.is_cut(e)) edges.push_back(e);
    const auto others = static_cast<std::ptrdiff_t>(edges.size());
    for (const Index h : path)
      if (!std::binary_search(edges.begin(), edges.begin() + others, mesh_.edge(h)))
        edges.push_back(mesh_.edge(h));
    std::sort(edges.begin() + others, edges.end());
    std::inplace_merge(edges.begin(), edges.begin() + others, edges.end());
    take(std::move(edges));
    return true;
  }

  /// The shortest path from rim to rim of the annulus that there is without the walls of this one, if it is
  /// shorter; else empty.
  std::vector<Index> shorter(const std::vector<Index>& path, double length, const core::Progress& progress) {
    const std::array ends = {path.front(), mesh_.twin(path.back())};
    for (const Index h : ends)
      if (walls_.degree(mesh_.origin(h)) == 0) return {};  // opens a sphere
    // Both rims alternately: the one with fewer corners suffices, and a hole in a large surface has few.
    std::array walks = {RimWalk(mesh_, walls_, ends[0]), RimWalk(mesh_, walls_, ends[1])};
    std::array<std::vector<Index>, 2> inwards;
    std::size_t near = 0;
    for (;; near = 1 - near) {
      walks[near].step([&](Index h) { inwards[near].push_back(h); });
      if (walks[near].is_round()) break;
    }
    for (const Index h : inwards[near]) is_near_[h] = 1;
    std::vector<Index> found = search_.find(
        inwards[near], length * kShorter,
        [&](Index h) {
          if (walls_.degree(mesh_.target(h)) == 0) return Step::pass;
          return is_near_[mesh_.twin(h)] != 0 ? Step::blocked : Step::goal;
        },
        progress);
    for (const Index h : inwards[near]) is_near_[h] = 0;
    return found;
  }

  TriangleMesh mesh_;
  Walls walls_;
  CutGraph graph_;
  std::vector<Trial> trials_;  // per path
  EdgePathSearch search_;
  std::vector<std::uint8_t> is_near_;  // per half-edge: leaves a corner of the rim that a search starts from
  std::vector<Index> time_of_edge_;    // per edge: of the last trial of the path that it was in
  Index time_ = 1;
  Index time_of_change_ = 1;
};

}  // namespace

ShortenedCut plain_shorten(const TriangleMesh& mesh, const CutGraph& cut, int rounds) {
  return Shortener(mesh, cut).run(static_cast<std::size_t>(rounds), {});
}

}  // namespace morsel::test
