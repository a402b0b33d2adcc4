#include "morsel/mscomplex/complex.h"

#include <bit>
#include <cstddef>
#include <limits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/follow.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::Point;
using core::TriangleMesh;

namespace detail {

/// From critical edges to saddles, in half a byte an edge: a bit each, counts before each word, and the
/// saddles by edge.
class SaddleOfEdge {
 public:
  SaddleOfEdge(Index edge_count, std::span<const CriticalCell> saddles)
      : bits_(std::size_t{edge_count} / 64 + 1, 0), before_(bits_.size()), saddle_(saddles.size()) {
    for (const CriticalCell& s : saddles) bits_[s.cell / 64] |= std::uint64_t{1} << s.cell % 64;
    Index count = 0;
    for (std::size_t w = 0; w < bits_.size(); ++w) {
      before_[w] = count;
      count += static_cast<Index>(std::popcount(bits_[w]));
    }
    for (std::size_t i = 0; i < saddles.size(); ++i) saddle_[place(saddles[i].cell)] = static_cast<Index>(i);
  }
  bool is_critical(Index e) const { return (bits_[e / 64] >> e % 64 & 1) != 0; }
  Index operator[](Index e) const { return saddle_[place(e)]; }

 private:
  std::size_t place(Index e) const {
    const std::uint64_t below = bits_[e / 64] & ((std::uint64_t{1} << e % 64) - 1);
    return before_[e / 64] + static_cast<Index>(std::popcount(below));
  }
  std::vector<std::uint64_t> bits_;
  std::vector<Index> before_;
  std::vector<Index> saddle_;
};

}  // namespace detail

/// Finds the ends of arcs, then their order: the V-paths that end in one extremum form a tree, embedded in
/// the surface; a walk around it meets the arcs that enter it in their cyclic order, though many share the
/// last edge.
class MorseSmaleComplex::Builder {
 public:
  explicit Builder(MorseSmaleComplex& complex)
      : complex_(complex),
        gradient_(complex.gradient_),
        mesh_(gradient_.mesh()),
        saddle_of_edge_(mesh_.edge_count(), gradient_.saddles()) {}

  void find_ends() {
    vertex_end_.assign(mesh_.vertex_count(), kNone);
    triangle_end_.assign(mesh_.triangle_count(), kNone);
    const auto minima = gradient_.minima();
    for (std::size_t i = 0; i < minima.size(); ++i) vertex_end_[minima[i]] = static_cast<Index>(i);
    const auto maxima = gradient_.maxima();
    for (std::size_t i = 0; i < maxima.size(); ++i)
      triangle_end_[maxima[i].cell] = complex_.maximum_node(static_cast<Index>(i));
    for (Index k = 0; k < mesh_.boundary_loop_count(); ++k)
      for (const Index h : mesh_.boundary_loop(k))
        if (gradient_.is_paired(h)) triangle_end_[TriangleMesh::triangle_of(h)] = complex_.cap_node(k);

    const auto saddles = gradient_.saddles();
    complex_.arc_end_.resize(complex_.arc_count());
    core::parallel_for_each(saddles.size(), [&](std::size_t i) {
      const Index h = mesh_.edge_halfedge(saddles[i].cell);
      Index* end = complex_.arc_end_.data() + 4 * i;
      end[0] = end_of_vertex(mesh_.origin(h));
      end[1] = end_across(h);
      end[2] = end_of_vertex(mesh_.target(h));
      end[3] = end_of_triangle(TriangleMesh::triangle_of(h));
    });
  }

  void order_ends() {
    const Index extrema = complex_.node_count() - complex_.saddle_count();
    auto& offset = complex_.around_offset_;
    offset.assign(std::size_t{extrema} + 1, 0);
    for (const Index end : complex_.arc_end_) ++offset[complex_.extremum(end) + 1];
    for (Index i = 0; i < extrema; ++i) offset[i + 1] += offset[i];
    complex_.around_.resize(complex_.arc_count());
    complex_.slot_.resize(complex_.arc_count());
    constexpr std::size_t kTrees = 64;  // a walk around one may be long
    core::parallel_for(0, extrema, kTrees, [&](std::size_t first, std::size_t last) {
      for (auto i = static_cast<Index>(first); i < last; ++i) {
        if (offset[i] == offset[i + 1]) continue;
        Index slot = offset[i];
        walk_around(i, [&](Index arc) {
          complex_.slot_[arc] = slot;
          complex_.around_[slot++] = arc;
        });
      }
    });
  }

 private:
  Index end_of_vertex(Index v) {
    return follow(vertex_end_, v, [&](Index u) { return gradient_.descend(u); });
  }
  Index end_of_triangle(Index t) {
    return follow(triangle_end_, t, [&](Index u) { return gradient_.ascend(u); });
  }
  Index end_across(Index h) {
    const Index across = mesh_.twin(h);
    if (across != kNone) return end_of_triangle(TriangleMesh::triangle_of(across));
    return complex_.cap_node(mesh_.boundary_loop_of_vertex(mesh_.origin(h)));
  }

  template <class Found>
  void walk_around(Index extremum, const Found& found) const {
    const Index minima = complex_.minimum_count();
    const Index maxima = complex_.maximum_count();
    if (extremum < minima) {
      walk_around_minimum(gradient_.minima()[extremum], found);
    } else if (extremum - minima < maxima) {
      const Index start = 3 * gradient_.maxima()[extremum - minima].cell;
      walk_around_triangles(start, start, found);
    } else {
      // Seen from the cap, its boundary runs against the half-edges of the triangles.
      const auto loop = mesh_.boundary_loop(extremum - minima - maxima);
      for (std::size_t i = loop.size(); i-- > 0;) {
        const Index h = loop[i];
        if (saddle_of_edge_.is_critical(mesh_.edge(h)))
          found(4 * saddle_of_edge_[mesh_.edge(h)] + 1);
        else if (gradient_.is_paired(h))
          walk_around_triangles(TriangleMesh::next(h), h, found);
      }
    }
  }

  /// The edges around v counter-clockwise, as half-edges that leave v, except the last one at a boundary,
  /// which only has one that enters v.
  Index next_edge(Index v, Index x) const {
    if (mesh_.origin(x) != v) return mesh_.vertex_halfedge(v);
    const Index arriving = TriangleMesh::previous(x);
    const Index twin = mesh_.twin(arriving);
    return twin != kNone ? twin : arriving;
  }
  Index other_side(Index x) const { return mesh_.twin(x) != kNone ? mesh_.twin(x) : x; }

  template <class Found>
  void walk_around_minimum(Index minimum, const Found& found) const {
    const Index start = mesh_.vertex_halfedge(minimum);
    Index v = minimum;
    Index x = start;
    do {
      const Index origin = mesh_.origin(x);
      const Index u = origin == v ? mesh_.target(x) : origin;
      const bool is_way_down = gradient_.descend(v) == u;
      if (is_way_down || gradient_.descend(u) == v) {
        if (is_way_down || vertex_end_[u] != kNone) {  // only where arcs arrive from
          v = u;
          x = other_side(x);
        }
      } else if (const Index e = mesh_.edge(x); saddle_of_edge_.is_critical(e)) {
        const bool from_origin = mesh_.origin(mesh_.edge_halfedge(e)) == v;
        found(4 * saddle_of_edge_[e] + (from_origin ? 0 : 2));
      }
      x = next_edge(v, x);
    } while (v != minimum || x != start);
  }

  /// Walks around the tree of triangles from side x of one to side `stop`, which is not visited itself unless
  /// it is x.
  template <class Found>
  void walk_around_triangles(Index x, Index stop, const Found& found) const {
    do {
      const Index across = mesh_.twin(x);
      if (gradient_.is_paired(x)) {
        x = across;  // up
      } else if (across != kNone && gradient_.is_paired(across)) {
        if (triangle_end_[TriangleMesh::triangle_of(across)] != kNone) x = across;
      } else if (const Index e = mesh_.edge(x); saddle_of_edge_.is_critical(e)) {
        found(4 * saddle_of_edge_[e] + (x == mesh_.edge_halfedge(e) ? 3 : 1));
      }
      x = TriangleMesh::next(x);
    } while (x != stop);
  }

  MorseSmaleComplex& complex_;
  const DiscreteGradient& gradient_;
  const TriangleMesh& mesh_;
  detail::SaddleOfEdge saddle_of_edge_;
  std::vector<Index> vertex_end_;    // node; kNone off the arcs
  std::vector<Index> triangle_end_;  // node; kNone off the arcs
};

MorseSmaleComplex::MorseSmaleComplex(const core::ScalarField& field, DiscreteGradient gradient,
                                     const core::Progress& progress)
    : gradient_(std::move(gradient)) {
  if (!gradient_.mesh().is_same(field.mesh()))
    throw core::InvalidArgument("the gradient is on another mesh than the field: compute it from this field");
  progress.update("Morse-Smale complex", 0);
  node_value_.resize(node_count());
  Index next = 0;
  for (const Index v : gradient_.minima()) node_value_[next++] = field.value(v);
  for (const CriticalCell& s : gradient_.saddles()) node_value_[next++] = field.value(s.vertex);
  for (const CriticalCell& m : gradient_.maxima()) node_value_[next++] = field.value(m.vertex);
  while (next < node_count()) node_value_[next++] = std::numeric_limits<double>::infinity();
  Builder builder(*this);
  builder.find_ends();
  progress.update("Morse-Smale complex", 0.5);
  builder.order_ends();
  progress.update("Morse-Smale complex", 1);
}

NodeKind MorseSmaleComplex::kind(Index node) const {
  if (node < minimum_count()) return NodeKind::minimum;
  if (node < maximum_node(0)) return NodeKind::saddle;
  return node < cap_node(0) ? NodeKind::maximum : NodeKind::cap;
}

Node MorseSmaleComplex::node(Index node) const {
  const auto from = [&](NodeKind node_kind, const CriticalCell& cell) {
    return Node{node_kind, cell.cell, cell.vertex, node_value_[node]};
  };
  switch (kind(node)) {
    case NodeKind::minimum:
      return from(NodeKind::minimum, {gradient_.minima()[node], gradient_.minima()[node]});
    case NodeKind::saddle:
      return from(NodeKind::saddle, gradient_.saddles()[node - minimum_count()]);
    case NodeKind::maximum:
      return from(NodeKind::maximum, gradient_.maxima()[node - maximum_node(0)]);
    case NodeKind::cap:
      break;
  }
  const Index loop = node - cap_node(0);
  return from(NodeKind::cap, {loop, mesh().origin(mesh().boundary_loop(loop).front())});
}

std::span<const Index> MorseSmaleComplex::arcs_ending_at(Index node) const {
  if (kind(node) == NodeKind::saddle) return {};
  const Index i = extremum(node);
  return std::span(around_).subspan(around_offset_[i], around_offset_[i + 1] - around_offset_[i]);
}

Index MorseSmaleComplex::next_around_end(Index arc) const {
  const Index i = extremum(arc_end_[arc]);
  const Index slot = slot_[arc] + 1;
  return around_[slot == around_offset_[i + 1] ? around_offset_[i] : slot];
}

Index MorseSmaleComplex::previous_around_end(Index arc) const {
  const Index i = extremum(arc_end_[arc]);
  const Index slot = slot_[arc];
  return around_[(slot == around_offset_[i] ? around_offset_[i + 1] : slot) - 1];
}

/// With the quad on the left: down arc 2q, up the arc before it around the minimum, then along the arc before
/// that one around its saddle, and back from the top.
Quad MorseSmaleComplex::quad(Index q) const {
  const Index down = 2 * q;
  const Index up = down + 1;
  const Index other_down = previous_around_end(down);
  const Index other_up = previous_around_saddle(other_down);
  return {{arc_end(down), arc_saddle(other_down), arc_end(up), arc_saddle(down)},
          {other_down, other_up, up, down}};
}

Index MorseSmaleComplex::quad_left_of(Index arc) const {
  return arc_kind(arc) == ArcKind::descending ? arc / 2 : (previous_around_end(arc) - 1) / 2;
}

Index MorseSmaleComplex::quad_right_of(Index arc) const { return quad_left_of(previous_around_saddle(arc)); }

void MorseSmaleComplex::trace_cells(Index arc, std::vector<Index>& cells) const {
  cells.clear();
  const CriticalCell& saddle = gradient_.saddles()[arc / 4];
  const Index h = mesh().edge_halfedge(saddle.cell);
  if (arc_kind(arc) == ArcKind::descending) {
    const Index start = arc % 4 == 0 ? mesh().origin(h) : mesh().target(h);
    if (start != saddle.vertex) cells.push_back(saddle.vertex);
    for (Index v = start; v != kNone; v = gradient_.descend(v)) cells.push_back(v);
    return;
  }
  const Index side = arc % 4 == 3 ? h : mesh().twin(h);
  if (side == kNone) return;
  for (Index t = TriangleMesh::triangle_of(side); t != kNone; t = gradient_.ascend(t)) cells.push_back(t);
}

void MorseSmaleComplex::trace(Index arc, std::vector<Point>& points) const {
  points.clear();
  const TriangleMesh& m = mesh();
  const auto midpoint = [&](Index h) -> Point {
    return (m.position(m.origin(h)) + m.position(m.target(h))) / 2;
  };
  const CriticalCell& saddle = gradient_.saddles()[arc / 4];
  const Index h = m.edge_halfedge(saddle.cell);
  points.push_back(m.position(saddle.vertex));
  if (arc_kind(arc) == ArcKind::descending) {
    const Index start = arc % 4 == 0 ? m.origin(h) : m.target(h);
    for (Index v = start == saddle.vertex ? gradient_.descend(start) : start; v != kNone;
         v = gradient_.descend(v))
      points.push_back(m.position(v));
    return;
  }
  const Index side = arc % 4 == 3 ? h : m.twin(h);
  if (side == kNone) {
    points.push_back(midpoint(h));
    return;
  }
  for (Index t = TriangleMesh::triangle_of(side); t != kNone; t = gradient_.ascend(t)) {
    const auto& [a, b, c] = m.triangle(t);
    points.push_back((m.position(a) + m.position(b) + m.position(c)) / 3);
    const Index crossed = gradient_.paired_halfedge(t);
    points.push_back(crossed != kNone ? midpoint(crossed) : m.position(node(arc_end(arc)).vertex));
  }
}

}  // namespace morsel::mscomplex
