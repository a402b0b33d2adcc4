#pragma once
/// One value a vertex, and the total order that the values induce.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/flat_array.h"

namespace morsel::core {

/// A piecewise-linear function on a mesh: one finite value per vertex and the total order of the vertices
/// that makes it a Morse function. Vertices are compared by (value, vertex number), "simulation of
/// simplicity" (Edelsbrunner and Mücke 1990), unless a method defines an order of its own. Algorithms compare
/// ranks, never values. A value type; immutable; safe to read from any number of threads. Memory: 16 bytes a
/// vertex.
class ScalarField {
 public:
  /// Orders by (value, vertex). `values` has one entry per vertex, in the function's own unit. Throws
  /// InvalidArgument on a wrong size and BadInput on a non-finite value, naming the first such vertex. Time
  /// and memory of vertex_order().
  ScalarField(TriangleMesh mesh, std::vector<double> values);

  /// Keeps the given order: `rank` is a permutation of 0 … n − 1 along which values never decrease (ranks
  /// decide only between equal values). Throws InvalidArgument if it is not. O(n), parallel.
  ScalarField(TriangleMesh mesh, std::vector<double> values, FlatArray<Index> rank);

  const TriangleMesh& mesh() const { return mesh_; }
  std::span<const double> values() const { return values_; }
  double value(Index v) const { return values_[v]; }
  /// Position of each vertex in the order: 0 is the lowest.
  std::span<const Index> ranks() const { return rank_; }
  Index rank(Index v) const { return rank_[v]; }
  /// The vertices from lowest to highest.
  std::span<const Index> order() const { return order_; }
  bool is_lower(Index a, Index b) const { return rank_[a] < rank_[b]; }

  double min() const { return values_[order_.front()]; }
  double max() const { return values_[order_.back()]; }
  /// max − min, in the field's unit.
  double extent() const { return max() - min(); }

  /// −f with the order reversed exactly, ties included. O(n).
  ScalarField negated() const;

 private:
  TriangleMesh mesh_;
  std::vector<double> values_;
  FlatArray<Index> rank_;
  FlatArray<Index> order_;
};

}  // namespace morsel::core
