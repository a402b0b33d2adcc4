#pragma once
/// The Morse-Smale complex and the segments by plain tracing in the gradient of the printed algorithm: the
/// oracle for mscomplex.

#include <array>
#include <map>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "support/lower_star_oracle.h"

namespace morsel::test {

class ComplexOracle {
 public:
  explicit ComplexOracle(const core::ScalarField& field);

  const GradientOracle& gradient() const { return gradient_; }

  /// The vertices from `vertex` down to a minimum.
  std::vector<core::Index> way_down(core::Index vertex) const;
  /// The triangles from `triangle` up to a critical one, or to where the surface ends.
  std::vector<Cell> way_up(const Cell& triangle) const;
  /// Where way_up() ends: a critical triangle, or the smallest vertex of the boundary loop.
  Cell top(const Cell& triangle) const;

  /// The triangles at an edge: two, or one at a boundary.
  const std::vector<Cell>& triangles_at(const Cell& edge) const { return cofaces_.at(edge); }
  /// The smallest vertex of the loop at a boundary edge.
  Cell cap_at(const Cell& edge) const;

  /// By the rule for vertices: the top of the highest triangle in the star.
  Cell top_of_vertex(core::Index vertex) const;
  /// By the rule for triangles: the minimum of the lowest vertex.
  core::Index minimum_of_triangle(const Cell& triangle) const;

  /// An arc that enters an extremum: the critical edge, and the vertex or triangle beside it where the arc
  /// begins (the cap for one that has no triangle).
  using ArcName = std::array<Cell, 2>;
  /// The arcs that end in a minimum, critical triangle or cap, counter-clockwise, by recursion over the tree
  /// of V-paths.
  std::vector<ArcName> around_minimum(core::Index vertex) const;
  std::vector<ArcName> around_maximum(core::Index triangle) const;
  std::vector<ArcName> around_cap(core::Index loop) const;

 private:
  void collect_at_vertex(core::Index vertex, core::Index from, std::vector<ArcName>& arcs) const;
  void collect_across(core::Index vertex_a, core::Index vertex_b, const Cell& here,
                      std::vector<ArcName>& arcs) const;

  core::ScalarField field_;
  GradientOracle gradient_;
  std::map<Cell, Cell> facet_;  // of a paired cell: the other way round
  std::map<Cell, std::vector<Cell>> cofaces_;
  std::map<Cell, core::Triangle> corners_;  // of a triangle, counter-clockwise
  std::map<Cell, bool> critical_;
};

}  // namespace morsel::test
