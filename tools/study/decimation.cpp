#include "morsel/tools/study/decimation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <queue>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/tools/study/random_stream.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::kNone;
using core::Point;
using core::Triangle;
using core::TriangleMesh;

constexpr double kLeastCosine = 0.2;  // of the angle that a triangle's normal may turn by

/// A surface whose edges can be collapsed. Edges are looked up in a set, triangles at the corner that has the
/// fewest, so that a vertex of very large degree costs no more than others.
class ShrinkingMesh {
 public:
  explicit ShrinkingMesh(const TriangleMesh& mesh)
      : mesh_(mesh),
        triangles_(mesh.triangles().begin(), mesh.triangles().end()),
        around_(mesh.vertex_count()),
        degree_(mesh.vertex_count()),
        alive_(mesh.vertex_count(), true),
        on_boundary_(mesh.vertex_count()) {
    for (Index t = 0; t < mesh.triangle_count(); ++t)
      for (const Index v : triangles_[t]) around_[v].push_back(t);
    edges_.reserve(mesh.edge_count());
    for (Index e = 0; e < mesh.edge_count(); ++e)
      edges_.insert(key(mesh.edge_vertices(e)[0], mesh.edge_vertices(e)[1]));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      degree_[v] = static_cast<Index>(around_[v].size());
      on_boundary_[v] = mesh.is_boundary_vertex(v);
    }
  }

  /// By number, ascending.
  std::vector<Index> neighbors(Index v) const {
    std::vector<Index> ring;
    for (const Index t : around_[v])
      for (const Index u : triangles_[t])
        if (u != v && u != kNone) ring.push_back(u);
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  }

  bool is_edge(Index u, Index w) const { return edges_.contains(key(u, w)); }

  /// Whether u may be moved onto its neighbour w.
  bool can_collapse(Index u, Index w) const {
    const Index few = fewest({u, w});
    const Index many = few == u ? w : u;
    std::vector<Index> apexes;
    for (const Index t : around_[few])
      if (has(t, many)) apexes.push_back(apex(t, u, w));
    if (on_boundary_[u] && (!on_boundary_[w] || apexes.size() != 1)) return false;
    if (degree_[u] == 1 && degree_[w] == 1) return false;  // a single triangle
    std::sort(apexes.begin(), apexes.end());
    if (std::ranges::adjacent_find(apexes) != apexes.end()) return false;
    for (const Index v : neighbors(few))  // they may share no others
      if (v != many && !std::ranges::binary_search(apexes, v) && is_edge(v, many)) return false;
    return std::ranges::all_of(around_[u], [&](Index t) {
      return is_gone(t) || has(t, w) || (!is_there(replaced(t, u, w)) && keeps_side(t, u, w));
    });
  }

  void collapse(Index u, Index w) {
    for (const Index v : neighbors(u)) {
      edges_.erase(key(u, v));
      if (v != w) edges_.insert(key(v, w));
    }
    for (const Index t : around_[u]) {
      if (is_gone(t)) continue;
      if (has(t, w)) {
        const Triangle corners = std::exchange(triangles_[t], {kNone, kNone, kNone});
        for (const Index v : corners)
          if (v != u) forget_one(v);
      } else {
        triangles_[t] = replaced(t, u, w);
        around_[w].push_back(t);
        ++degree_[w];
      }
    }
    around_[u].clear();
    degree_[u] = 0;
    alive_[u] = false;
  }

  bool is_alive(Index v) const { return alive_[v]; }
  /// Those that are left.
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> left;
    for (const Triangle& t : triangles_)
      if (t[0] != kNone) left.push_back(t);
    return left;
  }

 private:
  static std::uint64_t key(Index u, Index w) { return std::uint64_t{std::min(u, w)} << 32 | std::max(u, w); }
  bool is_gone(Index t) const { return triangles_[t][0] == kNone; }
  bool has(Index t, Index v) const { return std::ranges::find(triangles_[t], v) != triangles_[t].end(); }

  Index fewest(std::initializer_list<Index> vertices) const {
    return std::ranges::min(vertices, {}, [&](Index v) { return around_[v].size(); });
  }

  /// One of the triangles around v is gone. They are swept when they are half of the list.
  void forget_one(Index v) {
    if (--degree_[v] < around_[v].size() / 2) std::erase_if(around_[v], [&](Index t) { return is_gone(t); });
  }

  Index apex(Index t, Index u, Index w) const {
    return *std::ranges::find_if(triangles_[t], [&](Index v) { return v != u && v != w; });
  }

  Triangle replaced(Index t, Index u, Index w) const {
    Triangle corners = triangles_[t];
    std::ranges::replace(corners, u, w);
    return corners;
  }

  /// Whether there is a triangle on these three vertices already (on a tetrahedron there may be).
  bool is_there(const Triangle& corners) const {
    return std::ranges::any_of(around_[fewest({corners[0], corners[1], corners[2]})], [&](Index t) {
      return std::ranges::all_of(corners, [&](Index v) { return has(t, v); });
    });
  }

  Point area(const Triangle& t) const {
    const Point& o = mesh_.position(t[0]);
    return (mesh_.position(t[1]) - o).cross(mesh_.position(t[2]) - o);
  }

  bool keeps_side(Index t, Index u, Index w) const {
    const Point before = area(triangles_[t]);
    const Point after = area(replaced(t, u, w));
    return before.norm() == 0 || before.normalized().dot(after.normalized()) > kLeastCosine;
  }

  const TriangleMesh& mesh_;
  std::vector<Triangle> triangles_;         // kNone where it is gone
  std::vector<std::vector<Index>> around_;  // triangles, by vertex, some of them gone
  std::vector<Index> degree_;               // how many are not
  std::unordered_set<std::uint64_t> edges_;
  std::vector<bool> alive_;
  std::vector<bool> on_boundary_;
};

}  // namespace

core::LoadedMesh decimated(const core::LoadedMesh& clean, double share, std::uint64_t seed,
                           std::uint64_t trial) {
  const TriangleMesh& mesh = clean.mesh;
  const auto wanted = static_cast<Index>(std::llround(share * mesh.vertex_count()));
  ShrinkingMesh shrinking(mesh);
  using Candidate = std::tuple<double, Index, Index>;  // cost, the vertex that goes, the one it is moved onto
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  const auto propose = [&](Index u, Index w) {
    const double factor = 1 + RandomStream(seed, RandomUse::decimation, {trial, u, w}).uniform();
    queue.emplace(factor * (mesh.position(u) - mesh.position(w)).norm(), u, w);
  };
  // By vertex: candidates that it is in and that were refused since an edge was collapsed onto it.
  std::vector<std::vector<std::pair<Index, Index>>> refused(mesh.vertex_count());
  Candidate last{-1, kNone, kNone};
  for (Index u = 0; u < mesh.vertex_count(); ++u)
    for (const Index w : shrinking.neighbors(u)) propose(u, w);
  Index left = mesh.vertex_count();
  while (left > wanted && !queue.empty()) {
    core::throw_if_stopped();
    const Candidate candidate = queue.top();
    queue.pop();
    if (std::exchange(last, candidate) == candidate) continue;
    const auto [cost, u, w] = candidate;
    if (!shrinking.is_edge(u, w)) continue;
    if (!shrinking.can_collapse(u, w)) {
      for (const Index v : {u, w}) refused[v].emplace_back(u, w);
      continue;
    }
    const std::vector<Index> moved = shrinking.neighbors(u);
    shrinking.collapse(u, w);
    --left;
    for (const Index v : moved)
      if (v != w && shrinking.is_edge(v, w)) {
        propose(v, w);
        propose(w, v);
      }
    for (const auto& [from, to] : std::exchange(refused[w], {}))  // they may be possible now
      if (shrinking.is_edge(from, to)) propose(from, to);
  }
  if (left > wanted)
    throw core::BadInput("the surface cannot be decimated to " + std::to_string(wanted) + " vertices: when " +
                         std::to_string(left) + " of its " + std::to_string(mesh.vertex_count()) +
                         " are left, no edge can be collapsed any more");

  std::vector<Point> positions;
  std::vector<Index> number(mesh.vertex_count(), kNone);
  core::MeshSource source = clean.source;
  core::VertexNumbering& numbering = source.numbering;
  numbering.to_input.clear();
  const bool same = clean.source.numbering.from_input.empty();
  if (same) numbering.input_count = mesh.vertex_count();
  numbering.from_input.assign(numbering.input_count, kNone);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!shrinking.is_alive(v)) continue;
    number[v] = static_cast<Index>(positions.size());
    const Index input = clean.source.numbering.input_vertex(v);
    numbering.to_input.push_back(input);
    if (numbering.from_input[input] == kNone) numbering.from_input[input] = number[v];
    positions.push_back(mesh.position(v));
  }
  std::vector<Triangle> triangles = shrinking.triangles();
  for (Triangle& t : triangles)
    for (Index& v : t) v = number[v];
  return {{std::move(positions), std::move(triangles)}, std::move(source)};
}

}  // namespace morsel::tools
