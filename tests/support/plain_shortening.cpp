// The slow reference of shortening: the whole cut is decomposed again after each change, and rims are found
// by searches among triangles.

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

/// The rims of a surface with walls, by searches among the triangles around each vertex: no half-edge is
/// followed to its twin or successor.
class Rims {
 public:
  explicit Rims(const TriangleMesh& mesh) : mesh_(mesh), around_(mesh.vertex_count()) {
    for (Index t = 0; t < mesh.triangle_count(); ++t)
      for (const Index v : mesh.triangles()[t]) around_[v].push_back(t);
  }

  struct Rim {
    std::size_t corners = 0;
    std::vector<Index> inwards;  // the half-edges that leave the corners, but for walls
  };
  /// The rim from the corner of `triangle` at v on, at which there must be walls.
  Rim rim(const Walls& walls, Index v, Index triangle) const {
    Rim result;
    const std::vector<Index> start = corner(walls, v, triangle);
    std::vector<Index> here = start;
    Index vertex = v;
    do {
      for (std::size_t i = 0; i + 1 < here.size(); ++i) result.inwards.push_back(leaving(here[i], vertex));
      ++result.corners;
      const Index last = here.back();
      vertex = after(last, vertex);
      here = corner(walls, vertex, last);
    } while (vertex != v || here != start);
    return result;
  }

 private:
  std::size_t place(Index t, Index v) const {
    std::size_t i = 0;
    while (mesh_.triangles()[t][i] != v) ++i;
    return i;
  }
  Index after(Index t, Index v) const { return mesh_.triangles()[t][(place(t, v) + 1) % 3]; }
  Index before(Index t, Index v) const { return mesh_.triangles()[t][(place(t, v) + 2) % 3]; }
  Index leaving(Index t, Index v) const { return static_cast<Index>(3 * t + place(t, v)); }
  Index entering(Index t, Index v) const { return static_cast<Index>(3 * t + (place(t, v) + 2) % 3); }

  /// The triangles around v that are connected to one of them by shared edges that are no walls, in the order
  /// in which the vertex after v in one is the vertex before v in the next.
  std::vector<Index> corner(const Walls& walls, Index v, Index triangle) const {
    std::vector<Index> connected = {triangle};
    for (std::size_t k = 0; k < connected.size(); ++k)
      for (const Index t : around_[v])
        if (std::find(connected.begin(), connected.end(), t) == connected.end() &&
            share(walls, v, connected[k], t))
          connected.push_back(t);
    const auto first = std::find_if(connected.begin(), connected.end(),
                                    [&](Index t) { return walls.is_wall(entering(t, v)); });
    std::vector<Index> ordered = {*first};
    while (ordered.size() < connected.size())
      ordered.push_back(*std::find_if(connected.begin(), connected.end(),
                                      [&](Index t) { return before(t, v) == after(ordered.back(), v); }));
    return ordered;
  }
  /// Whether triangles a and b around v share an edge at v that is no wall.
  bool share(const Walls& walls, Index v, Index a, Index b) const {
    return (after(a, v) == before(b, v) && !walls.is_wall(leaving(a, v))) ||
           (before(a, v) == after(b, v) && !walls.is_wall(entering(a, v)));
  }

  TriangleMesh mesh_;
  std::vector<std::vector<Index>> around_;  // per vertex: its triangles
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
        rims_(mesh),
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
    const std::array rims = {rims_.rim(walls_, mesh_.origin(ends[0]), TriangleMesh::triangle_of(ends[0])),
                             rims_.rim(walls_, mesh_.origin(ends[1]), TriangleMesh::triangle_of(ends[1]))};
    const std::vector<Index>& inwards = rims[rims[0].corners <= rims[1].corners ? 0 : 1].inwards;
    for (const Index h : inwards) is_near_[h] = 1;
    std::vector<Index> found = search_.find(
        inwards, length * kShorter,
        [&](Index h) {
          if (walls_.degree(mesh_.target(h)) == 0) return Step::pass;
          return is_near_[mesh_.twin(h)] != 0 ? Step::blocked : Step::goal;
        },
        progress);
    for (const Index h : inwards) is_near_[h] = 0;
    return found;
  }

  TriangleMesh mesh_;
  Walls walls_;
  Rims rims_;
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
