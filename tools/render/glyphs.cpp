#include "morsel/tools/render/glyphs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/tools/color/surface_colors.h"

namespace morsel::tools::render {
namespace {

using core::Index;
using core::kNone;
using core::Point;
using core::TriangleMesh;

/// Arcs are not smoothed at vertices with more triangles. These are slivers whose bounding boxes lie one in
/// another, so that a ray passes a share of them, and rays for all arcs there would take quadratic time.
constexpr int kMostTriangles = 256;

/// Per vertex: whether it is a corner of a triangle at such a vertex.
std::vector<bool> crowded_vertices(const TriangleMesh& mesh) {
  std::vector<int> triangles(mesh.vertex_count(), 0);
  for (const core::Triangle& t : mesh.triangles())
    for (const Index v : t) ++triangles[v];
  std::vector<bool> crowded(mesh.vertex_count(), false);
  for (const core::Triangle& t : mesh.triangles())
    if (std::ranges::any_of(t, [&](Index v) { return triangles[v] > kMostTriangles; }))
      for (const Index v : t) crowded[v] = true;
  return crowded;
}

/// A corner of an arc on the surface.
struct Knot {
  Point point;
  Point normal;
  bool fixed = false;  // stays where it was made
};

/// The drawing of a complex: knots, and the steps between them, each once.
class Net {
 public:
  Net(const Body& body, const mscomplex::MorseSmaleComplex& complex)
      : body_(body), complex_(complex), crowded_(crowded_vertices(body.mesh)) {
    const mscomplex::DiscreteGradient& gradient = complex.gradient();
    vertex_.assign(mesh().vertex_count(), kNone);
    for (const mscomplex::CriticalCell& saddle : gradient.saddles()) {
      core::throw_if_stopped();
      descend(saddle);
      ascend(saddle);
    }
    for (const Index v : gradient.minima()) fix(v);
  }

  struct Step {
    Index a, b;
    bool descending;
  };
  std::vector<Knot> knots;
  std::vector<Step> steps;

 private:
  const TriangleMesh& mesh() const { return body_.mesh; }

  Index add(const Point& point, const Point& normal, bool fixed) {
    const double length = normal.norm();
    knots.push_back({point, length > 0 ? Point(normal / length) : Point::Zero(), fixed});
    return static_cast<Index>(knots.size() - 1);
  }
  Index at_vertex(Index v) {
    if (vertex_[v] == kNone) vertex_[v] = add(mesh().position(v), body_.normals[v], crowded_[v]);
    return vertex_[v];
  }
  void fix(Index v) {
    if (vertex_[v] != kNone) knots[vertex_[v]].fixed = true;
  }
  Index at_midpoint(Index h, bool fixed) {
    const Index a = mesh().origin(h), b = mesh().target(h);
    return add((mesh().position(a) + mesh().position(b)) / 2, body_.normals[a] + body_.normals[b],
               fixed || (crowded_[a] && crowded_[b]));
  }
  Index at_barycentre(Index t) {
    const auto& [a, b, c] = mesh().triangle(t);
    return add((mesh().position(a) + mesh().position(b) + mesh().position(c)) / 3,
               body_.normals[a] + body_.normals[b] + body_.normals[c],
               crowded_[a] && crowded_[b] && crowded_[c]);
  }

  void descend(const mscomplex::CriticalCell& saddle) {
    const auto [a, b] = mesh().edge_vertices(saddle.cell);
    steps.push_back({at_vertex(a), at_vertex(b), true});
    fix(saddle.vertex);
    if (way_down_.empty()) way_down_.assign(mesh().vertex_count(), false);
    for (const Index start : {a, b})
      for (Index v = start; !way_down_[v]; v = complex_.gradient().descend(v)) {
        way_down_[v] = true;
        const Index next = complex_.gradient().descend(v);
        if (next == kNone) break;
        steps.push_back({at_vertex(v), at_vertex(next), true});
      }
  }

  void ascend(const mscomplex::CriticalCell& saddle) {
    const mscomplex::DiscreteGradient& gradient = complex_.gradient();
    if (triangle_.empty()) triangle_.assign(mesh().triangle_count(), kNone);
    const Index h = mesh().edge_halfedge(saddle.cell);
    const bool at_boundary = mesh().twin(h) == kNone;
    const Index crossing = at_midpoint(h, at_boundary);
    steps.push_back({at_vertex(saddle.vertex), crossing, false});
    for (const Index side : {h, mesh().twin(h)}) {
      if (side == kNone) continue;
      Index from = crossing;
      for (Index t = TriangleMesh::triangle_of(side); t != kNone;) {
        const bool known = triangle_[t] != kNone;
        if (!known) triangle_[t] = at_barycentre(t);
        steps.push_back({from, triangle_[t], false});
        if (known) break;
        const Index crossed = gradient.paired_halfedge(t);
        if (crossed == kNone) {
          const auto& corners = mesh().triangle(t);
          // The maximum is the corner whose critical triangle this is; the lists are by vertex, so it is
          // looked up once a triangle.
          steps.push_back({triangle_[t], at_vertex(maximum_of(t, corners)), false});
          break;
        }
        from = at_midpoint(crossed, mesh().twin(crossed) == kNone);
        steps.push_back({triangle_[t], from, false});
        t = gradient.ascend(t);
      }
    }
  }

  Index maximum_of(Index t, const core::Triangle& corners) {
    const auto maxima = complex_.gradient().maxima();
    for (const Index v : corners) {
      const auto found =
          std::lower_bound(maxima.begin(), maxima.end(), v,
                           [](const mscomplex::CriticalCell& m, Index x) { return m.vertex < x; });
      if (found != maxima.end() && found->vertex == v && found->cell == t) {
        at_vertex(v);
        fix(v);
        return v;
      }
    }
    return corners[0];  // unreachable: an unpaired triangle is a maximum's
  }

  const Body& body_;
  const mscomplex::MorseSmaleComplex& complex_;
  std::vector<bool> crowded_;    // by vertex
  std::vector<Index> vertex_;    // knot of each vertex
  std::vector<Index> triangle_;  // knot of each triangle's barycentre
  std::vector<bool> way_down_;   // vertices from which the descending path is drawn
};

/// The point of the surface nearest along the normal, if there is one within reach.
bool to_surface(const Rays& rays, Point& point, const Point& normal, double reach) {
  const Vec3 p = point.cast<float>(), n = normal.cast<float>();
  const auto r = static_cast<float>(reach);
  Hit hit;
  float best = kFar;
  for (const float side : {1.f, -1.f})
    // From slightly behind, so that a point on the surface hits it.
    if (rays.first(p - side * 1e-5f * n, side * n, 0, r, hit) &&
        std::abs(hit.distance - 1e-5f) < std::abs(best))
      best = side * (hit.distance - 1e-5f);
  if (best == kFar) return false;
  point += double{best} * normal;
  return true;
}

void straighten(Net& net, const Rays& rays, double freedom) {
  constexpr int kRounds = 30;
  const std::size_t count = net.knots.size();
  std::vector<Point> sum(count);
  std::vector<Point> start(count);
  for (std::size_t i = 0; i < count; ++i) start[i] = net.knots[i].point;
  std::vector<int> degree(count);
  for (int round = 0; round < kRounds; ++round) {
    std::fill(sum.begin(), sum.end(), Point::Zero());
    std::fill(degree.begin(), degree.end(), 0);
    for (const Net::Step& step : net.steps) {
      sum[step.a] += net.knots[step.b].point;
      sum[step.b] += net.knots[step.a].point;
      ++degree[step.a];
      ++degree[step.b];
    }
    core::parallel_for_each(count, [&](std::size_t i) {
      Knot& knot = net.knots[i];
      if (knot.fixed || degree[i] < 2) return;
      Point moved = (knot.point + sum[i] / degree[i]) / 2;
      const double way = (moved - start[i]).norm();
      if (way > freedom) moved = start[i] + (freedom / way) * (moved - start[i]);
      const double reach = 2 * (moved - knot.point).norm() + 1e-4;
      if (to_surface(rays, moved, knot.normal, reach)) knot.point = moved;
    });
  }
}

/// Adds a step as capsules, halved where the straight segment leaves the surface by more than a tube can
/// hide. Between knots that have stayed it lies in a triangle.
void add_step(Scene& scene, const Rays& rays, const Knot& a, const Knot& b, double radius, const Color& color,
              int depth) {
  const double length = (b.point - a.point).norm();
  if (depth > 0 && length > 2 * radius && !(a.fixed && b.fixed)) {
    Knot middle{(a.point + b.point) / 2, a.normal + b.normal};
    const double n = middle.normal.norm();
    if (n > 0) {
      middle.normal /= n;
      const Point straight = middle.point;
      if (to_surface(rays, middle.point, middle.normal, length / 2) &&
          (middle.point - straight).norm() > 0.15 * radius) {
        add_step(scene, rays, a, middle, radius, color, depth - 1);
        add_step(scene, rays, middle, b, radius, color, depth - 1);
        return;
      }
    }
  }
  const double lift = 0.35 * radius;
  scene.capsules.push_back({(a.point + lift * a.normal).cast<float>(),
                            (b.point + lift * b.normal).cast<float>(), static_cast<float>(radius)});
  scene.capsule_colors.push_back(color);
}

}  // namespace

void add_points(Scene& scene, const morse::CriticalPoints& points, double radius,
                std::span<const Index> places) {
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Index v = places.empty() ? points.points[i].vertex : places[i];
    const Point center = scene.body.mesh.position(v) + 0.3 * radius * scene.body.normals[v];
    scene.balls.push_back({center.cast<float>(), static_cast<float>(radius)});
    scene.ball_colors.push_back(color_of(points.points[i].type));
  }
}

void add_arcs(Scene& scene, const Rays& rays, const mscomplex::MorseSmaleComplex& complex, double radius,
              double freedom, std::optional<mscomplex::ArcKind> only) {
  Net net(scene.body, complex);
  if (only)
    std::erase_if(net.steps, [&](const Net::Step& step) {
      return step.descending != (*only == mscomplex::ArcKind::descending);
    });
  if (freedom > 0) straighten(net, rays, freedom);
  for (const Net::Step& step : net.steps) {
    core::throw_if_stopped();
    add_step(scene, rays, net.knots[step.a], net.knots[step.b], radius,
             color_of(step.descending ? mscomplex::ArcKind::descending : mscomplex::ArcKind::ascending), 5);
  }
}

}  // namespace morsel::tools::render
