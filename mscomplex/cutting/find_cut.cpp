// A cut graph from the arcs of a complex: a spanning tree and its complement.

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "morsel/core/error.h"
#include "morsel/mscomplex/cut.h"
#include "morsel/mscomplex/cutting/cut_edges.h"
#include "morsel/mscomplex/cutting/edge_path_search.h"
#include "morsel/mscomplex/follow.h"

namespace morsel::mscomplex {
namespace {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// The primal side: descending paths, which end at minima and where they meet the boundary.
class Descents {
 public:
  explicit Descents(const DiscreteGradient& gradient)
      : gradient_(gradient), length_(gradient.mesh().vertex_count(), -1) {}

  /// The next vertex on the path down, kNone at its end.
  Index next(Index v) const { return gradient_.mesh().is_boundary_vertex(v) ? kNone : gradient_.descend(v); }
  /// The length of the path down from v; all calls together O(n).
  double length(Index v) {
    way_.clear();
    for (; length_[v] < 0 && next(v) != kNone; v = next(v)) way_.push_back(v);
    if (length_[v] < 0) length_[v] = 0;
    double sum = length_[v];
    const TriangleMesh& mesh = gradient_.mesh();
    for (auto w = way_.rbegin(); w != way_.rend(); ++w) {
      sum += (mesh.position(*w) - mesh.position(next(*w))).norm();
      length_[*w] = sum;
    }
    return sum;
  }

 private:
  const DiscreteGradient& gradient_;
  std::vector<double> length_;  // per vertex; −1: not known yet
  std::vector<Index> way_;
};

/// The edges between trees of ascending paths that are on no descending path: the critical ones and those
/// that lead down from a boundary vertex into the surface.
std::vector<Index> crossings(const DiscreteGradient& gradient) {
  const TriangleMesh& mesh = gradient.mesh();
  std::vector<Index> edges;
  for (const CriticalCell& saddle : gradient.saddles())
    if (!mesh.is_boundary_edge(saddle.cell)) edges.push_back(saddle.cell);
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const Index boundary : mesh.boundary_loop(k)) {
      const Index v = mesh.origin(boundary);
      mesh.for_each_outgoing(v, [&](Index h) {
        if (mesh.target(h) == gradient.descend(v) && mesh.twin(h) != kNone) edges.push_back(mesh.edge(h));
      });
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The dual side: the path up from each triangle, to a critical triangle or to the boundary edge where it
/// leaves the surface.
class Ascents {
 public:
  explicit Ascents(const DiscreteGradient& gradient)
      : gradient_(gradient), top_(gradient.mesh().triangle_count(), kNone) {
    const TriangleMesh& mesh = gradient.mesh();
    for (const CriticalCell& maximum : gradient.maxima()) top_[maximum.cell] = count_++;
    for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
      for (const Index h : mesh.boundary_loop(k))
        if (gradient.is_paired(h)) top_[TriangleMesh::triangle_of(h)] = count_++;
  }
  Index count() const { return count_; }
  Index top(Index triangle) {
    return follow(std::span<Index>(top_), triangle, [&](Index t) { return gradient_.ascend(t); });
  }

 private:
  const DiscreteGradient& gradient_;
  std::vector<Index> top_;  // per triangle; kNone: not known yet
  Index count_ = 0;
};

/// The crossings that are not in a spanning tree of the tops that prefers those with long paths down.
std::vector<Index> uncrossed(const DiscreteGradient& gradient, Descents& descents) {
  const TriangleMesh& mesh = gradient.mesh();
  const std::vector<Index> edges = crossings(gradient);
  std::vector<double> length;
  for (const Index e : edges) {
    const auto [a, b] = mesh.edge_vertices(e);
    length.push_back(edge_length(mesh, mesh.edge_halfedge(e)) + descents.length(a) + descents.length(b));
  }
  std::vector<Index> order(edges.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return length[i] > length[j]; });

  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                      boost::property<boost::edge_weight_t, Index>>;
  Ascents ascents(gradient);
  Graph graph(ascents.count());
  for (Index place = 0; place < order.size(); ++place) {  // its weight: no two are the same
    const Index h = mesh.edge_halfedge(edges[order[place]]);
    boost::add_edge(ascents.top(TriangleMesh::triangle_of(h)),
                    ascents.top(TriangleMesh::triangle_of(mesh.twin(h))), place, graph);
  }
  std::vector<boost::graph_traits<Graph>::edge_descriptor> tree;
  boost::kruskal_minimum_spanning_tree(graph, std::back_inserter(tree));
  std::vector<std::uint8_t> is_crossed(edges.size(), 0);
  for (const auto& edge : tree) is_crossed[order[boost::get(boost::edge_weight, graph, edge)]] = 1;
  std::vector<Index> rest;
  for (Index i = 0; i < edges.size(); ++i)
    if (is_crossed[i] == 0) rest.push_back(edges[i]);
  return rest;
}

/// The edges and the paths down from their ends.
Walls with_ways_down(const DiscreteGradient& gradient, const std::vector<Index>& edges,
                     const Descents& descents) {
  const TriangleMesh& mesh = gradient.mesh();
  Walls walls(mesh, edges);
  std::vector<std::uint8_t> is_walked(mesh.vertex_count(), 0);
  for (const Index e : edges)
    for (Index v : mesh.edge_vertices(e))
      for (Index w; is_walked[v] == 0 && (w = descents.next(v)) != kNone; v = w) {
        is_walked[v] = 1;
        mesh.for_each_outgoing(v, [&](Index h) {
          if (mesh.target(h) == w) walls.add(mesh.edge(h));
        });
      }
  return walls;
}

/// Removes dangling edges until there are none.
void prune(const TriangleMesh& mesh, Walls& walls) {
  for (Index start = 0; start < mesh.vertex_count(); ++start)
    for (Index v = start; walls.degree(v) == 1;) {
      Index away = kNone;
      mesh.for_each_outgoing(v, [&](Index h) {
        if (walls.is_cut(mesh.edge(h))) away = h;
      });
      walls.remove(mesh.edge(away));
      v = mesh.target(away);
    }
}

/// Adds the paths that open the closed components of genus 0.
void open_spheres(const core::ScalarField& field, Walls& walls, const core::Progress& progress) {
  const TriangleMesh& mesh = field.mesh();
  std::vector<Index> lowest(mesh.component_count(), kNone), highest = lowest;
  for (const Index v : field.order()) {
    const Index c = mesh.component_of_vertex(v);
    if (lowest[c] == kNone) lowest[c] = v;
    highest[c] = v;
  }
  std::optional<EdgePathSearch> search;
  std::vector<Index> seeds;
  for (Index c = 0; c < mesh.component_count(); ++c) {
    if (mesh.euler_characteristic(c) != 2) continue;
    const Index from = lowest[c], to = highest[c];
    seeds.clear();
    mesh.for_each_outgoing(from, [&](Index h) {
      if (mesh.target(h) != to) seeds.push_back(h);  // a single edge opens nothing
    });
    if (!search) search.emplace(mesh);
    const std::vector<Index> path = search->find(
        seeds, std::numeric_limits<double>::infinity(),
        [&](Index h) {
          return mesh.target(h) == to ? Step::goal : mesh.target(h) == from ? Step::blocked : Step::pass;
        },
        progress);
    if (path.empty())
      throw core::BadInput("no path of finite length leads from the lowest to the highest vertex");
    for (const Index h : path) walls.add(mesh.edge(h));
  }
}

}  // namespace

CutGraph find_cut(const MorseSmaleComplex& complex, const core::ScalarField& field,
                  const core::Progress& progress) {
  const TriangleMesh& mesh = complex.mesh();
  if (!mesh.is_same(field.mesh()))
    throw core::InvalidArgument("the complex is on another mesh than the field");
  progress.update("cut graph", 0);
  Descents descents(complex.gradient());
  Walls walls = with_ways_down(complex.gradient(), uncrossed(complex.gradient(), descents), descents);
  progress.update("cut graph", 0.5);
  prune(mesh, walls);
  open_spheres(field, walls, progress);
  std::vector<Index> edges;
  for (Index e = 0; e < mesh.edge_count(); ++e)
    if (walls.is_cut(e)) edges.push_back(e);
  CutGraph graph = make_cut_graph(mesh, std::move(edges));
  progress.update("cut graph", 1);
  return graph;
}

}  // namespace morsel::mscomplex
