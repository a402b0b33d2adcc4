// The complex against plain tracing of its arcs and against Euler's identity.

#include <algorithm>
#include <vector>

#include "morsel/core/require.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

namespace {

constexpr core::Require require_complex("MorseSmaleComplex::validate");

bool is_side_of(const TriangleMesh& mesh, Index edge, Index t) {
  return mesh.edge(3 * t) == edge || mesh.edge(3 * t + 1) == edge || mesh.edge(3 * t + 2) == edge;
}

void check_arc(const MorseSmaleComplex& complex, Index arc, std::vector<Index>& cells) {
  const TriangleMesh& mesh = complex.mesh();
  const Node saddle = complex.node(complex.arc_saddle(arc));
  const Node end = complex.node(complex.arc_end(arc));
  complex.trace_cells(arc, cells);
  if (MorseSmaleComplex::arc_kind(arc) == ArcKind::descending) {
    require_complex(end.kind == NodeKind::minimum, "no minimum at the end of descending arc", arc);
    require_complex(cells.size() >= 2 && cells.front() == saddle.vertex, "start of arc", arc);
    require_complex(cells.back() == end.vertex, "end of arc", arc);
    const auto [a, b] = mesh.edge_vertices(saddle.cell);
    const bool by_edge = arc % 4 == (mesh.origin(mesh.edge_halfedge(saddle.cell)) == saddle.vertex ? 2 : 0);
    require_complex(cells[1] == (by_edge ? a + b - saddle.vertex : complex.gradient().descend(saddle.vertex)),
                    "first step of arc", arc);
    for (std::size_t i = 2; i < cells.size(); ++i)
      require_complex(cells[i] == complex.gradient().descend(cells[i - 1]), "vertices apart along arc", arc);
    return;
  }
  require_complex(end.kind == NodeKind::maximum || end.kind == NodeKind::cap,
                  "no maximum or cap at the end of ascending arc", arc);
  require_complex(cells.empty() || is_side_of(mesh, saddle.cell, cells.front()), "start of arc", arc);
  const auto leaves_at = [&](Index h) {
    require_complex(mesh.twin(h) == kNone && end.kind == NodeKind::cap &&
                        mesh.boundary_loop_of_vertex(mesh.origin(h)) == end.cell,
                    "way out of arc", arc);
  };
  if (cells.empty()) {
    leaves_at(mesh.edge_halfedge(saddle.cell));
  } else if (end.kind == NodeKind::maximum) {
    require_complex(cells.back() == end.cell, "end of arc", arc);
  } else {
    leaves_at(complex.gradient().paired_halfedge(cells.back()));
  }
}

}  // namespace

void MorseSmaleComplex::validate() const {
  require_complex(
      arc_end_.size() == arc_count() && slot_.size() == arc_count() && around_.size() == arc_count(),
      "table sizes; arcs", arc_count());
  std::vector<Index> cells;
  for (Index a = 0; a < arc_count(); ++a) check_arc(*this, a, cells);

  Index listed = 0;
  for (Index node = 0; node < node_count(); ++node) {
    const auto arcs = arcs_ending_at(node);
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const Index next = arcs[(i + 1) % arcs.size()];
      require_complex(arc_end_[arcs[i]] == node, "order around a node has an arc of another node, arc",
                      arcs[i]);
      require_complex(slot_[arcs[i]] == listed++, "order around a node, arc", arcs[i]);
      require_complex(next_around_end(arcs[i]) == next && previous_around_end(next) == arcs[i],
                      "next or previous of arc", arcs[i]);
    }
  }
  require_complex(listed == arc_count(), "arcs around all ends:", listed);

  const auto component = [&](Index node) { return mesh().component_of_vertex(this->node(node).vertex); };
  std::vector<Index> seen(arc_count(), 0);
  std::vector<long> euler(mesh().component_count(), 0);
  for (Index node = 0; node < node_count(); ++node) ++euler[component(node)];
  for (Index a = 0; a < arc_count(); ++a) {
    --euler[component(arc_saddle(a))];
    require_complex(component(arc_saddle(a)) == component(arc_end_[a]), "another component at the end of arc",
                    a);
  }
  for (Index q = 0; q < quad_count(); ++q) {
    const auto [nodes, arcs] = quad(q);
    require_complex(kind(nodes[0]) == NodeKind::minimum && kind(nodes[1]) == NodeKind::saddle &&
                        (kind(nodes[2]) == NodeKind::maximum || kind(nodes[2]) == NodeKind::cap) &&
                        kind(nodes[3]) == NodeKind::saddle,
                    "nodes of quad", q);
    for (const auto& [a, saddle, end] :
         {std::array{arcs[0], nodes[1], nodes[0]}, std::array{arcs[1], nodes[1], nodes[2]},
          std::array{arcs[2], nodes[3], nodes[2]}, std::array{arcs[3], nodes[3], nodes[0]}})
      require_complex(arc_saddle(a) == saddle && arc_end(a) == end, "arcs and nodes of quad", q);
    require_complex(arcs[3] == 2 * q && previous_around_end(arcs[1]) == arcs[2],
                    "the walk does not close around quad", q);
    // Seen from their saddles, arcs 1 and 3 have the quad on their left, arcs 0 and 2 on their right.
    require_complex(quad_left_of(arcs[1]) == q && quad_left_of(arcs[3]) == q && quad_right_of(arcs[0]) == q &&
                        quad_right_of(arcs[2]) == q,
                    "sides of the arcs of quad", q);
    for (const Index a : arcs) ++seen[a];
    ++euler[component(nodes[0])];
  }
  for (Index a = 0; a < arc_count(); ++a) require_complex(seen[a] == 2, "not between two quads: arc", a);
  for (Index c = 0; c < mesh().component_count(); ++c)
    require_complex(euler[c] == mesh().euler_characteristic(c) + long{mesh().boundary_loop_count(c)},
                    "Euler's identity in component", c);
}

}  // namespace morsel::mscomplex
