#pragma once
/// The discrete gradient of a scalar field: which cell of the surface is paired with which.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::mscomplex {

/// An edge or triangle in no pair of the gradient, and the vertex where the field is critical: the cell's
/// highest.
struct CriticalCell {
  core::Index cell = core::kNone;
  core::Index vertex = core::kNone;
  friend bool operator==(const CriticalCell&, const CriticalCell&) = default;
};

/// The discrete gradient of a field from its lower stars (Robins, Wood, Sheppard 2011, "Theory and algorithms
/// for constructing discrete Morse complexes from grayscale digital images", ProcessLowerStars), on the
/// capped surface: each boundary loop is closed by a virtual critical face at +∞. A cell is paired with one
/// facet or cofacet of the same highest vertex, or critical. Critical cells agree with the classification of
/// the vertices (Banchoff 1970): one critical vertex a minimum, `multiplicity` critical edges a saddle, one
/// critical triangle a maximum.
///
/// On a surface the paper's queues reduce to a rule: a vertex is paired with the edge to its lowest lower
/// neighbour; the lower link falls into runs of consecutive neighbours, and the lowest of every other run
/// gives a critical edge; the remaining edges are paired with the triangles beside them, away from their
/// run's lowest; and where the whole link is lower, the highest triangle (by sorted ranks) stays critical.
///
/// Immutable; copies are deep. Memory: 4 bytes a vertex and 1 a triangle, and the critical cells.
/// with_reversed() makes a simpler gradient, whose critical cells are some of the field's.
class DiscreteGradient {
 public:
  /// O(n + Σ runs log runs), whatever the degrees; parallel over vertices, the same bits for every number of
  /// threads.
  explicit DiscreteGradient(const core::ScalarField& field, const core::Progress& progress = {});

  const core::TriangleMesh& mesh() const { return mesh_; }

  /// Critical vertices, ascending.
  std::span<const core::Index> minima() const { return minima_; }
  /// Critical edges by ascending saddle vertex, then by rank of the lower end; a saddle vertex has as many in
  /// a row as its multiplicity.
  std::span<const CriticalCell> saddles() const { return saddles_; }
  /// Critical triangles by ascending vertex. The caps, critical too, are not among them.
  std::span<const CriticalCell> maxima() const { return maxima_; }

  /// The other end of the edge that v is paired with (from lower stars v's lowest neighbour); kNone at a
  /// minimum.
  core::Index descend(core::Index v) const { return lower_[v]; }
  std::span<const core::Index> descents() const { return lower_; }
  /// The half-edge, in triangle t, of the edge that t is paired with; kNone at a critical triangle.
  core::Index paired_halfedge(core::Index t) const {
    return side_[t] == kCritical ? core::kNone : 3 * t + side_[t];
  }
  /// Whether half-edge h is the one that its triangle is paired with.
  bool is_paired(core::Index h) const { return side_[h / 3] == h % 3; }
  /// The triangle across the edge that t is paired with: the next one on the V-path up. kNone at a critical
  /// triangle and where that path leaves the surface, into the cap of the boundary loop at
  /// paired_halfedge(t).
  core::Index ascend(core::Index t) const {
    if (side_[t] == kCritical) return core::kNone;
    const core::Index across = mesh_.twin(3 * t + side_[t]);
    return across == core::kNone ? core::kNone : core::TriangleMesh::triangle_of(across);
  }

  /// The vertex that edge e is paired with; kNone if with none. O(1).
  core::Index paired_vertex(core::Index e) const {
    const auto [a, b] = mesh_.edge_vertices(e);
    return lower_[a] == b ? a : lower_[b] == a ? b : core::kNone;
  }
  /// The triangle that edge e is paired with; kNone if with none. O(1).
  core::Index paired_triangle(core::Index e) const {
    const core::Index h = mesh_.edge_halfedge(e);
    if (is_paired(h)) return core::TriangleMesh::triangle_of(h);
    const core::Index across = mesh_.twin(h);
    return across != core::kNone && is_paired(across) ? core::TriangleMesh::triangle_of(across) : core::kNone;
  }
  /// Whether edge e is in no pair. O(1).
  bool is_critical_edge(core::Index e) const {
    return paired_vertex(e) == core::kNone && paired_triangle(e) == core::kNone;
  }

  /// The gradient with the V-paths of these arcs reversed one after the other, so that the saddle and the
  /// extremum at each arc's ends are critical no longer (Forman 1998, "Morse theory for cell complexes").
  /// Arcs are numbered as the Morse-Smale complex of this gradient has them: 4i + k for side k of
  /// saddles()[i]; earlier reversals change where an arc ends. Throws InvalidArgument for a saddle that
  /// does not exist (any more), an arc that ends in a cap, and one whose saddle reaches the same extremum on
  /// both sides, which would close a V-path. The result's pairs no longer share their highest vertices. O(n)
  /// and the lengths of both V-paths from each saddle.
  DiscreteGradient with_reversed(std::span<const core::Index> arcs) const;

  /// Checks what every discrete gradient must be, for tests: each cell in at most one pair, no closed V-path,
  /// lists that name exactly the cells in no pair in their order, Euler's identity component by component.
  /// Throws std::logic_error naming the first contradiction. O(n).
  void validate() const;
  /// Checks also that it is that of `field`'s lower stars: pairs of facet and cofacet with one highest
  /// vertex, each vertex paired with the edge to its lowest neighbour, critical cells at their highest
  /// vertex. O(n).
  void validate(const core::ScalarField& field) const;

 private:
  static constexpr std::uint8_t kCritical = 3;
  class LowerStar;
  struct CriticalCells {
    std::vector<core::Index> minima;
    std::vector<CriticalCell> saddles;
    std::vector<CriticalCell> maxima;
  };
  void reverse_descent(core::Index edge, core::Index arc);
  void reverse_ascent(core::Index edge, core::Index arc);

  core::TriangleMesh mesh_;
  std::vector<core::Index> lower_;  // per vertex
  std::vector<std::uint8_t> side_;  // per triangle: which of its half-edges, or kCritical
  std::vector<core::Index> minima_;
  std::vector<CriticalCell> saddles_;
  std::vector<CriticalCell> maxima_;
};

}  // namespace morsel::mscomplex
