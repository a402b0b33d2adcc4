#pragma once
/// The Morse-Smale complex of a scalar field: critical cells, the arcs between them, and the quads that the
/// arcs bound.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/discrete_gradient.h"

namespace morsel::mscomplex {

enum class NodeKind : std::uint8_t { minimum, saddle, maximum, cap };
enum class ArcKind : std::uint8_t { descending, ascending };

/// A critical cell, or the cap of a boundary loop.
struct Node {
  NodeKind kind = NodeKind::minimum;
  core::Index cell = core::kNone;  ///< the vertex, edge, triangle or boundary loop
  core::Index vertex =
      core::kNone;   ///< the critical vertex: the cell's highest; for a cap its loop's smallest number
  double value = 0;  ///< the field at `vertex`; +∞ for a cap
};

/// The two ends of an arc. Every arc starts at a saddle.
struct Arc {
  core::Index saddle = core::kNone;  ///< node
  core::Index end = core::kNone;     ///< node: a minimum if descending, else a maximum or cap
  ArcKind kind = ArcKind::descending;
};

/// A face of the complex, counter-clockwise: arcs[i] joins nodes[i] and nodes[(i + 1) % 4].
struct Quad {
  std::array<core::Index, 4> nodes;  ///< minimum, saddle, maximum or cap, saddle
  std::array<core::Index, 4> arcs;
};

/// The Morse-Smale complex (Edelsbrunner, Harer, Zomorodian 2003), from the discrete gradient, on the capped
/// surface.
///
/// Nodes are numbered minima first (by vertex), then saddles (one per critical edge, so that a multiple
/// saddle counts once per multiplicity; by vertex), maxima (by vertex), caps (by loop). Arcs 4i … 4i + 3 are
/// those of the i-th saddle, counter-clockwise around it: descending from the origin of its edge's half-edge,
/// ascending on that half-edge's right, descending from its target, ascending on its left. A descending arc
/// follows the pairs vertex → edge; an ascending one crosses the edges of the pairs edge → triangle, and ends
/// in the loop's cap where it leaves the surface.
///
/// Component by component: arcs = 4 × saddles, quads = arcs / 2, nodes − arcs + quads = χ of the capped
/// surface. A component with one minimum and one maximum (or cap) and no saddle has no arc and no quad. An
/// Index counts all of them: saddles never outnumber half the triangles.
///
/// Immutable; safe to read from any number of threads. Memory: 48 bytes a saddle and 12 a node besides the
/// gradient. Arcs that merge share the rest of their V-paths, and the sum of their lengths may be quadratic,
/// so geometry is traced on demand.
class MorseSmaleComplex {
 public:
  /// The complex of `gradient`, which must be on the field's mesh (throws InvalidArgument otherwise). O(n),
  /// parallel, the same bits for every number of threads.
  MorseSmaleComplex(const core::ScalarField& field, DiscreteGradient gradient,
                    const core::Progress& progress = {});
  explicit MorseSmaleComplex(const core::ScalarField& field, const core::Progress& progress = {})
      : MorseSmaleComplex(field, DiscreteGradient(field, progress), progress) {}

  const DiscreteGradient& gradient() const { return gradient_; }
  const core::TriangleMesh& mesh() const { return gradient_.mesh(); }

  // Nodes.
  core::Index minimum_count() const { return static_cast<core::Index>(gradient_.minima().size()); }
  core::Index saddle_count() const { return static_cast<core::Index>(gradient_.saddles().size()); }
  core::Index maximum_count() const { return static_cast<core::Index>(gradient_.maxima().size()); }
  core::Index cap_count() const { return mesh().boundary_loop_count(); }
  core::Index node_count() const { return minimum_count() + saddle_count() + maximum_count() + cap_count(); }
  NodeKind kind(core::Index node) const;
  Node node(core::Index node) const;
  core::Index saddle_node(core::Index i) const { return minimum_count() + i; }
  core::Index maximum_node(core::Index i) const { return minimum_count() + saddle_count() + i; }
  core::Index cap_node(core::Index loop) const { return maximum_node(maximum_count()) + loop; }

  // Arcs.
  core::Index arc_count() const { return 4 * saddle_count(); }
  static ArcKind arc_kind(core::Index arc) { return arc % 2 == 0 ? ArcKind::descending : ArcKind::ascending; }
  core::Index arc_saddle(core::Index arc) const { return saddle_node(arc / 4); }
  core::Index arc_end(core::Index arc) const { return arc_end_[arc]; }
  Arc arc(core::Index arc) const { return {arc_saddle(arc), arc_end(arc), arc_kind(arc)}; }

  // The cyclic order, counter-clockwise, seen from outside: that of a walk around the tree of merged
  // V-paths, and around a loop against its half-edges.
  /// The arcs that end in a node that is not a saddle, from an arbitrary one on; no arc is listed twice.
  /// Empty for a saddle.
  std::span<const core::Index> arcs_ending_at(core::Index node) const;
  core::Index next_around_saddle(core::Index arc) const { return arc % 4 == 3 ? arc - 3 : arc + 1; }
  core::Index previous_around_saddle(core::Index arc) const { return arc % 4 == 0 ? arc + 3 : arc - 1; }
  core::Index next_around_end(core::Index arc) const;
  core::Index previous_around_end(core::Index arc) const;
  /// Calls visit(arc) for each arc at a node, counter-clockwise.
  template <class Visit>
  void for_each_arc_around(core::Index node, Visit&& visit) const {
    if (kind(node) == NodeKind::saddle)
      for (core::Index k = 0; k < 4; ++k) visit(4 * (node - minimum_count()) + k);
    else
      for (const core::Index arc : arcs_ending_at(node)) visit(arc);
  }

  // Quads: quad q lies on the left of descending arc 2q, seen from the saddle.
  core::Index quad_count() const { return arc_count() / 2; }
  Quad quad(core::Index q) const;
  core::Index quad_left_of(core::Index arc) const;   ///< of `arc` as it leaves its saddle
  core::Index quad_right_of(core::Index arc) const;  ///< of `arc` as it leaves its saddle

  // Geometry; each call is linear in the arc's length and replaces the contents of the vector.
  /// Descending: the vertices from the saddle's vertex to the minimum, neighbours each. Ascending: the
  /// triangles from the one beside the saddle's edge to the maximum's, or to the last before the cap (none
  /// where the saddle's edge is on the boundary), neighbours each.
  void trace_cells(core::Index arc, std::vector<core::Index>& cells) const;
  /// The arc as a polyline of two points or more, from the saddle's vertex on. Descending: along mesh edges
  /// to the minimum. Ascending: by barycentres of triangles and midpoints of the edges crossed, to the
  /// maximum's vertex, or to the midpoint of the boundary edge where it enters the cap. So arcs meet only
  /// where V-paths merge, and never cross.
  void trace(core::Index arc, std::vector<core::Point>& points) const;

  /// Checks ends against plain tracing, cyclic orders, quads and Euler's identity component by component, for
  /// tests. Throws std::logic_error naming the first contradiction. Time: the sum of the arcs' lengths.
  void validate() const;

 private:
  class Builder;
  core::Index extremum(core::Index node) const {
    return node < minimum_count() ? node : node - saddle_count();
  }

  DiscreteGradient gradient_;
  std::vector<double> node_value_;
  std::vector<core::Index> arc_end_;        // per arc: node
  std::vector<core::Index> around_offset_;  // per node that is no saddle, and the end
  std::vector<core::Index> around_;         // arcs in cyclic order
  std::vector<core::Index> slot_;           // per arc: its place in around_
};

}  // namespace morsel::mscomplex
