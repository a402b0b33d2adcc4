#include "morsel/mscomplex/quad_regions.h"

#include <algorithm>
#include <cstdint>

#include "morsel/core/parallel/parallel.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

namespace {

/// Walks along the rims of the discs, counter-clockwise, and labels the triangles whose lowest corner it
/// visits.
class DiscWalk {
 public:
  DiscWalk(const core::ScalarField& field, const MorseSmaleComplex& complex, std::vector<Index>& quad)
      : mesh_(complex.mesh()), rank_(field.ranks()), gradient_(complex.gradient()), quad_(quad) {}

  /// The stretch after a critical edge, in the disc of the triangle of half-edge `side`.
  void from_triangle(Index side, Index label) { walk({TriangleMesh::next(side), false}, label); }
  /// The same in the cap's disc, after the edge of boundary half-edge `side`.
  void from_cap(Index side, Index label) { walk({boundary_into(mesh_.origin(side)), true}, label); }

 private:
  bool is_descent(Index h) const {
    const Index a = mesh_.origin(h);
    const Index b = mesh_.target(h);
    return gradient_.descend(a) == b || gradient_.descend(b) == a;
  }
  bool is_crossed(Index h) const {
    if (gradient_.is_paired(h)) return true;
    const Index across = mesh_.twin(h);
    return across != kNone && gradient_.is_paired(across);
  }

  void visit(Index corner, Index label) {
    const Index t = TriangleMesh::triangle_of(corner);
    const Index here = rank_[mesh_.origin(corner)];
    if (here < rank_[mesh_.target(corner)] && here < rank_[mesh_.apex(corner)]) quad_[t] = label;
  }

  /// A corner on the rim and the edge there that is next, counter-clockwise: that of the half-edge, which
  /// leaves the corner in its triangle; or, in a cap, which runs along its loop the other way, of the
  /// boundary half-edge that ends there.
  struct Place {
    Index halfedge;
    bool in_cap;
  };

  /// From `place` to the next critical edge.
  void walk(Place place, Index label) {
    for (;;) {
      const Index h = place.halfedge;
      if (!place.in_cap) visit(h, label);
      if (is_crossed(h)) {
        const Index across = place.in_cap ? h : mesh_.twin(h);
        place = across == kNone ? Place{boundary_into(mesh_.origin(h)), true}
                                : Place{TriangleMesh::next(across), false};
      } else if (is_descent(h)) {
        place.halfedge = place.in_cap ? boundary_into(mesh_.origin(h)) : TriangleMesh::next(h);
      } else {
        return;
      }
    }
  }

  /// The boundary half-edge that ends in boundary vertex v.
  Index boundary_into(Index v) const {
    Index last = kNone;
    mesh_.for_each_outgoing(v, [&](Index h) { last = h; });
    return TriangleMesh::previous(last);
  }

  const TriangleMesh& mesh_;
  std::span<const Index> rank_;
  const DiscreteGradient& gradient_;
  std::vector<Index>& quad_;
};

}  // namespace

std::vector<Index> quad_of_triangles(const core::ScalarField& field, const MorseSmaleComplex& complex) {
  const TriangleMesh& mesh = complex.mesh();
  const auto saddles = complex.gradient().saddles();
  std::vector<Index> quad(mesh.triangle_count(), kNone);
  DiscWalk walk(field, complex, quad);
  core::parallel_for(0, saddles.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index left = mesh.edge_halfedge(saddles[i].cell);
      const Index right = mesh.twin(left);
      const auto q = static_cast<Index>(2 * i);  // left of the descending arc from the half-edge's origin
      walk.from_triangle(left, q + 1);
      if (right != kNone)
        walk.from_triangle(right, q);
      else
        walk.from_cap(left, q);
    }
  });
  return quad;
}

Index cell_count(const core::ScalarField& field, const MorseSmaleComplex& complex) {
  const TriangleMesh& mesh = complex.mesh();
  const std::vector<Index> quad = quad_of_triangles(field, complex);
  std::vector<std::uint8_t> occurs(complex.quad_count() + mesh.component_count(), 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index without_quad = complex.quad_count() + mesh.component_of_vertex(mesh.triangle(t)[0]);
    occurs[quad[t] != kNone ? quad[t] : without_quad] = 1;
  }
  return static_cast<Index>(std::ranges::count(occurs, 1));
}

}  // namespace morsel::mscomplex
