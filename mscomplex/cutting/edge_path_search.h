#pragma once
/// Shortest paths along the edges of a mesh.

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/cutting/cut_edges.h"

namespace morsel::mscomplex {

/// Whether a search may go along a half-edge, and whether it ends with it.
enum class Step { pass, blocked, goal };

/// Dijkstra's search (1959) with Euclidean lengths, many times on one mesh: the time of a search is that of
/// the vertices it visits.
class EdgePathSearch {
 public:
  explicit EdgePathSearch(const core::TriangleMesh& mesh) : mesh_(mesh), reached_(mesh.vertex_count()) {}

  /// The half-edges of a shortest path that begins with one of `seeds` and ends with a half-edge that is a
  /// goal, if it is shorter than `bound`; empty otherwise. at(h) returns what going along h means; vertices
  /// that are entered must be inner ones. Of equally short paths the same one always.
  template <class At>
  std::vector<core::Index> find(std::span<const core::Index> seeds, double bound, const At& at,
                                const core::Progress& progress) {
    double shortest = bound;
    core::Index goal = core::kNone;
    const auto go = [&](double base, core::Index h) {
      const Step step = at(h);
      if (step == Step::blocked) return;
      const double d = base + edge_length(mesh_, h);
      if (!(d < shortest)) return;
      if (step == Step::goal) {
        shortest = d;
        goal = h;
        return;
      }
      const core::Index v = mesh_.target(h);
      if (!(d < reached_[v].distance)) return;
      if (reached_[v].by == core::kNone) visited_.push_back(v);
      reached_[v] = {d, h};
      queue_.emplace(d, v);
    };
    for (const core::Index h : seeds) go(0, h);
    for (std::size_t count = 0; !queue_.empty(); ++count) {
      const auto [d, v] = queue_.top();
      if (!(d < shortest)) break;
      queue_.pop();
      if (count % 65536 == 0) progress.throw_if_cancelled();
      if (d > reached_[v].distance) continue;
      mesh_.for_each_outgoing(v, [&, base = d](core::Index h) { go(base, h); });
    }
    std::vector<core::Index> path;
    for (core::Index h = goal; h != core::kNone; h = reached_[mesh_.origin(h)].by) path.push_back(h);
    std::reverse(path.begin(), path.end());
    clear();
    return path;
  }

 private:
  void clear() {
    for (const core::Index v : visited_) reached_[v] = {};
    visited_.clear();
    queue_ = {};
  }

  struct Reached {  // together, since each visit is a cache miss
    double distance = std::numeric_limits<double>::infinity();
    core::Index by = core::kNone;  // the half-edge
  };
  using Entry = std::pair<double, core::Index>;
  core::TriangleMesh mesh_;
  std::vector<Reached> reached_;  // per vertex
  std::vector<core::Index> visited_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace morsel::mscomplex
