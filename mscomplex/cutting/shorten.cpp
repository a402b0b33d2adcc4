// Shortening a cut, path by path, in the annulus that the disc becomes when it is glued along one of them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/mscomplex/cut.h"
#include "morsel/mscomplex/cutting/cut_edges.h"
#include "morsel/mscomplex/cutting/edge_path_search.h"

namespace morsel::mscomplex {
namespace {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// New lengths must be shorter by more than the rounding errors of sums.
constexpr double kShorter = 1 - 1e-12;

/// One step along the rim of a surface with walls: all consecutive corners at one vertex.
class RimWalk {
 public:
  /// Starts at the rim's corner that half-edge `inside`, no wall, leaves; there must be walls at its origin.
  RimWalk(const TriangleMesh& mesh, const Walls& walls, Index inside) : mesh_(mesh), walls_(walls) {
    while (!walls.is_wall(TriangleMesh::previous(inside))) inside = mesh.twin(TriangleMesh::previous(inside));
    start_ = here_ = TriangleMesh::previous(inside);
  }
  /// Calls visit(h) for each half-edge that leaves the corner here inwards, and takes the next step along the
  /// rim.
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
  double length = 0;
  Index time = 0;
};

/// The key of a path in the order of trials: first the path tried longest ago, of equal ones the longest, of
/// those the first one of the cut.
struct Turn {
  Index time;
  double length;
  Index vertex;  // where the path begins
  Index edge;    // its first one
  std::size_t trial;
  bool operator>(const Turn& other) const {
    return std::tuple(time, -length, vertex, edge) >
           std::tuple(other.time, -other.length, other.vertex, other.edge);
  }
};

class Shortener {
 public:
  Shortener(const TriangleMesh& mesh, const CutGraph& cut)
      : mesh_(mesh),
        walls_(mesh, cut.edges),
        search_(mesh),
        is_near_(mesh.halfedge_count(), 0),
        time_of_edge_(mesh.edge_count(), 0),
        trial_of_edge_(mesh.edge_count(), 0) {
    std::vector<Index> edges = cut.edges;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    take(edges);
  }

  ShortenedCut run(std::size_t rounds, const core::Progress& progress) {
    ShortenedCut result;
    const std::size_t most = rounds * trials_.size();
    for (; !is_settled() && result.attempts < most; ++result.attempts) {
      progress.update("shortening", static_cast<double>(result.attempts) / static_cast<double>(most));
      const std::size_t next = turns_.top().trial;
      turns_.pop();
      if (replace(next, progress)) ++result.replaced;
    }
    result.is_settled = is_settled();
    std::vector<Index> edges;
    for (Index e = 0; e < mesh_.edge_count(); ++e)
      if (walls_.is_cut(e)) edges.push_back(e);
    result.cut = make_cut_graph(mesh_, std::move(edges));
    return result;
  }

 private:
  bool is_end(Index v) const { return walls_.degree(v) != 2 || mesh_.is_boundary_vertex(v); }

  /// Makes trials of the walls that are in none: whole paths, edges ascending.
  void take(const std::vector<Index>& edges) {
    for (TracedPath& path : trace_paths(mesh_, edges, [&](Index v, std::size_t) { return is_end(v); })) {
      Trial trial{std::move(path.halfedges), path.length, kNone};
      for (const Index h : trial.halfedges) {
        trial.time = std::min(trial.time, time_of_edge_[mesh_.edge(h)]);
        trial_of_edge_[mesh_.edge(h)] = trials_.size();
      }
      trials_.push_back(std::move(trial));
      line_up(trials_.size() - 1);
    }
  }

  void line_up(std::size_t trial) {
    const Trial& t = trials_[trial];
    const Index first = t.halfedges.front();
    turns_.push({t.time, t.length, mesh_.origin(first), mesh_.edge(first), trial});
  }

  /// Whether all paths were tried since the cut last changed.
  bool is_settled() {
    while (!turns_.empty() && trials_[turns_.top().trial].halfedges.empty())
      turns_.pop();  // no longer a path
    return turns_.empty() || turns_.top().time >= time_of_change_;
  }

  bool replace(std::size_t p, const core::Progress& progress) {
    ++time_;
    const std::vector<Index> old_path = std::move(trials_[p].halfedges);
    trials_[p].halfedges.clear();
    for (const Index h : old_path) walls_.remove(mesh_.edge(h));
    const std::vector<Index> path = shorter(old_path, trials_[p].length, progress);
    if (path.empty()) {
      for (const Index h : old_path) {
        walls_.add(mesh_.edge(h));
        time_of_edge_[mesh_.edge(h)] = time_;
      }
      trials_[p].halfedges = old_path;
      trials_[p].time = time_;
      line_up(p);
      return false;
    }

    time_of_change_ = time_;
    // At the old path's ends two paths may become one, at the new path's ends one may become two.
    std::vector<Index> edges;
    for (const Index v : {mesh_.origin(old_path.front()), mesh_.target(old_path.back()),
                          mesh_.origin(path.front()), mesh_.target(path.back())})
      if (!mesh_.is_boundary_vertex(v) && walls_.degree(v) <= 2)
        mesh_.for_each_outgoing(v, [&](Index h) {
          if (walls_.is_cut(mesh_.edge(h))) take_apart(trial_of_edge_[mesh_.edge(h)], edges);
        });
    for (const Index h : path) {
      walls_.add(mesh_.edge(h));
      time_of_edge_[mesh_.edge(h)] = time_;
      edges.push_back(mesh_.edge(h));
    }
    std::sort(edges.begin(), edges.end());
    take(edges);
    return true;
  }

  /// Ends a trial, once; its edges are added to `edges`.
  void take_apart(std::size_t trial, std::vector<Index>& edges) {
    for (const Index h : trials_[trial].halfedges) edges.push_back(mesh_.edge(h));
    trials_[trial].halfedges.clear();
  }

  /// The shortest path from rim to rim of the annulus that results without the walls of this trial, if it is
  /// shorter; else empty.
  std::vector<Index> shorter(const std::vector<Index>& path, double length, const core::Progress& progress) {
    const std::array ends = {path.front(), mesh_.twin(path.back())};
    for (const Index h : ends)
      if (walls_.degree(mesh_.origin(h)) == 0) return {};  // opens a sphere
    // Both rims in turns: the one with fewer corners suffices, and a hole in a large surface has few.
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
  std::vector<Trial> trials_;  // empty for paths that no longer exist
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns_;
  EdgePathSearch search_;
  std::vector<std::uint8_t> is_near_;  // per half-edge: leaves a corner of the rim that a search starts from
  std::vector<Index> time_of_edge_;    // per edge: of the last trial of the path that it was in
  std::vector<std::size_t> trial_of_edge_;  // per edge of the cut
  Index time_ = 1;
  Index time_of_change_ = 1;
};

}  // namespace

ShortenedCut shorten(const TriangleMesh& mesh, const CutGraph& cut, const ShortenOptions& options,
                     const core::Progress& progress) {
  if (options.rounds < 1)
    throw core::InvalidArgument("rounds of shortening must be at least 1, not " +
                                std::to_string(options.rounds));
  ShortenedCut result = Shortener(mesh, cut).run(static_cast<std::size_t>(options.rounds), progress);
  progress.update("shortening", 1);
  return result;
}

}  // namespace morsel::mscomplex
