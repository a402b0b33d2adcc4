#include "morsel/tools/study/decimation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <string>
#include <tuple>
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

/// A surface whose edges can be collapsed.
class ShrinkingMesh {
 public:
  explicit ShrinkingMesh(const TriangleMesh& mesh)
      : mesh_(mesh),
        triangles_(mesh.triangles().begin(), mesh.triangles().end()),
        around_(mesh.vertex_count()),
        alive_(mesh.vertex_count(), true),
        on_boundary_(mesh.vertex_count()) {
    for (Index t = 0; t < mesh.triangle_count(); ++t)
      for (const Index v : triangles_[t]) around_[v].push_back(t);
    for (Index v = 0; v < mesh.vertex_count(); ++v) on_boundary_[v] = mesh.is_boundary_vertex(v);
  }

  /// By number, ascending.
  std::vector<Index> neighbors(Index v) const {
    std::vector<Index> ring;
    for (const Index t : around_[v])
      for (const Index u : triangles_[t])
        if (u != v) ring.push_back(u);
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  }

  bool is_edge(Index u, Index w) const {
    return alive_[u] && alive_[w] && std::ranges::any_of(around_[u], [&](Index t) { return has(t, w); });
  }

  /// Whether u may be moved onto its neighbour w.
  bool can_collapse(Index u, Index w) const {
    std::vector<Index> apexes;
    for (const Index t : around_[u])
      if (has(t, w)) apexes.push_back(apex(t, u, w));
    if (on_boundary_[u] && (!on_boundary_[w] || apexes.size() != 1)) return false;
    if (around_[u].size() == 1 && around_[w].size() == 1) return false;  // a single triangle
    std::sort(apexes.begin(), apexes.end());
    std::vector<Index> shared;
    std::ranges::set_intersection(neighbors(u), neighbors(w), std::back_inserter(shared));
    if (shared != apexes) return false;
    return std::ranges::all_of(around_[u], [&](Index t) {
      return has(t, w) || (!is_there(replaced(t, u, w), w) && keeps_side(t, u, w));
    });
  }

  void collapse(Index u, Index w) {
    for (const Index t : around_[u]) {
      if (has(t, w)) {
        for (const Index v : triangles_[t])
          if (v != u) std::erase(around_[v], t);
        triangles_[t] = {kNone, kNone, kNone};
      } else {
        triangles_[t] = replaced(t, u, w);
        around_[w].push_back(t);
      }
    }
    around_[u].clear();
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
  bool has(Index t, Index v) const { return std::ranges::find(triangles_[t], v) != triangles_[t].end(); }

  Index apex(Index t, Index u, Index w) const {
    return *std::ranges::find_if(triangles_[t], [&](Index v) { return v != u && v != w; });
  }

  Triangle replaced(Index t, Index u, Index w) const {
    Triangle corners = triangles_[t];
    std::ranges::replace(corners, u, w);
    return corners;
  }

  /// Whether w has a triangle on these three vertices already (on a tetrahedron it may).
  bool is_there(const Triangle& corners, Index w) const {
    return std::ranges::any_of(around_[w], [&](Index t) {
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
  std::vector<std::vector<Index>> around_;  // triangles, by vertex
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
  for (Index u = 0; u < mesh.vertex_count(); ++u)
    for (const Index w : shrinking.neighbors(u)) propose(u, w);
  Index left = mesh.vertex_count();
  while (left > wanted && !queue.empty()) {
    core::throw_if_stopped();
    const auto [cost, u, w] = queue.top();
    queue.pop();
    if (!shrinking.is_edge(u, w) || !shrinking.can_collapse(u, w)) continue;
    shrinking.collapse(u, w);
    --left;
    for (const Index v : shrinking.neighbors(w)) {  // also those refused before: they may be possible now
      propose(v, w);
      propose(w, v);
    }
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
