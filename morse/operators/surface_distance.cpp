#include "morsel/morse/operators/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::kNone;
using core::TriangleMesh;

struct Place {
  double x;
  double y;
};

double length(const TriangleMesh& mesh, Index a, Index b) {
  return (mesh.position(a) - mesh.position(b)).norm();
}

/// The apex of a triangle whose base runs along the x axis from the origin.
Place apex(double base, double left, double right) {
  return {(base + (left - right) * (left + right) / base) / 2, 2 * triangle_area({base, left, right}) / base};
}

/// Across edge e, unfolded, from the corner on one side of it to that on the other.
double straight_across(const TriangleMesh& mesh, Index e) {
  const Index h = mesh.edge_halfedge(e);
  const Index twin = mesh.twin(h);
  if (twin == kNone) return HUGE_VAL;
  const Index a = mesh.origin(h);
  const Index b = mesh.target(h);
  const double base = length(mesh, a, b);
  if (!(base > 0)) return HUGE_VAL;
  const auto place = [&](Index corner) {
    return apex(base, length(mesh, a, corner), length(mesh, corner, b));
  };
  const Place above = place(mesh.apex(h));
  const Place below = place(mesh.apex(twin));
  const double height = above.y + below.y;
  const double part = height > 0 ? above.y / height : 0;
  const double crossing = above.x + (below.x - above.x) * part;
  return crossing >= 0 && crossing <= base ? std::hypot(below.x - above.x, height) : HUGE_VAL;
}

}  // namespace

SurfaceDistances::SurfaceDistances(const TriangleMesh& mesh) : mesh_(mesh), exponent_(0) {
  UnitSized sized = unit_sized(mesh);
  mesh_ = std::move(sized.mesh);
  exponent_ = sized.exponent;
  across_.resize(mesh_.edge_count());
  core::parallel_for_each(across_.size(),
                          [&](std::size_t e) { across_[e] = straight_across(mesh_, static_cast<Index>(e)); });
}

template <class Visit>
void SurfaceDistances::for_each_path(Index v, const Visit& visit) const {
  Index last = kNone;
  mesh_.for_each_outgoing(v, [&](Index h) {
    visit(mesh_.target(h), length(mesh_, v, mesh_.target(h)));
    const Index facing = TriangleMesh::next(h);
    if (mesh_.twin(facing) != kNone) visit(mesh_.apex(mesh_.twin(facing)), across_[mesh_.edge(facing)]);
    last = mesh_.apex(h);
  });
  if (mesh_.is_boundary_vertex(v)) visit(last, length(mesh_, v, last));
}

std::vector<double> SurfaceDistances::to_nearest_other(std::span<const Index> vertices) const {
  // From all at once. The shortest path from one to the nearest other one passes from what is nearest to the
  // one to what is nearest to the other.
  ShortestPaths paths(mesh_.vertex_count());
  std::vector<Index> nearest(mesh_.vertex_count(), kNone);  // by its place in `vertices`
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    paths.lower(vertices[i], 0);
    nearest[vertices[i]] = static_cast<Index>(i);
  }
  paths.run([&](Index from, double d) {
    for_each_path(from, [&](Index u, double path) {
      if (paths.lower(u, d + path)) nearest[u] = nearest[from];
    });
  });
  std::vector<double> result(vertices.size(), HUGE_VAL);
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    for_each_path(v, [&](Index u, double path) {
      if (nearest[v] == nearest[u]) return;
      for (const Index one : {nearest[v], nearest[u]})
        result[one] =
            std::min(result[one], std::ldexp(paths.distance(v) + path + paths.distance(u), exponent_));
    });
  return result;
}

std::vector<Index> SurfaceDistances::farthest_points(Index start, std::size_t count) const {
  std::vector<Index> chosen;
  const auto reach_from = [&](ShortestPaths& paths, Index source) {
    core::throw_if_stopped();
    paths.lower(source, 0);
    paths.run([&](Index from, double d) {
      for_each_path(from, [&](Index u, double path) { paths.lower(u, d + path); });
    });
  };
  const auto farthest = [&](const ShortestPaths& paths, bool only_reached) {
    Index best = kNone;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (only_reached && std::isinf(paths.distance(v))) continue;
      if (best == kNone || paths.distance(v) > paths.distance(best)) best = v;
    }
    return best;
  };
  ShortestPaths from_start(mesh_.vertex_count());
  reach_from(from_start, start);
  ShortestPaths from_chosen(mesh_.vertex_count());
  for (Index next = farthest(from_start, true); chosen.size() < count; next = farthest(from_chosen, false)) {
    if (!(from_chosen.distance(next) > 0)) break;
    chosen.push_back(next);
    reach_from(from_chosen, next);
  }
  return chosen;
}

SurfaceDistances::Search::Search(const SurfaceDistances& distances)
    : distances_(distances), paths_(distances.mesh_.vertex_count()) {}

const std::vector<SurfaceDistances::Reached>& SurfaceDistances::Search::within(Index v, double radius) {
  const double limit = std::ldexp(radius, -distances_.exponent_);
  const auto lower = [&](Index u, double d) {
    if (d < limit) paths_.lower(u, d);
  };
  reached_.clear();
  lower(v, 0);
  paths_.run([&](Index from, double d) {
    reached_.push_back({from, std::ldexp(d, distances_.exponent_)});
    distances_.for_each_path(from, [&](Index u, double path) { lower(u, d + path); });
  });
  for (const Reached& reached : reached_) paths_.forget(reached.vertex);  // all that was lowered
  return reached_;
}

bool SpacedVertices::take(Index v) {
  if (is_near_[v]) return false;
  is_near_[v] = true;
  for (const auto& [u, distance] : search_.within(v, spacing_)) is_near_[u] = true;
  return true;
}

}  // namespace morsel::morse
