// From a layout to a quad mesh.

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/patch.h"

namespace morsel::mscomplex {

using core::Index;
using core::Point;

namespace {

/// Points that cut a polyline into n pieces of one length, but for its ends.
void sample_arc(const core::TriangleMesh& surface, const std::vector<Index>& arc, Index n, Point* samples) {
  std::vector<double> length(arc.size(), 0.0);
  for (std::size_t i = 1; i < arc.size(); ++i)
    length[i] = length[i - 1] + (surface.position(arc[i]) - surface.position(arc[i - 1])).norm();
  std::size_t i = 1;
  for (Index k = 1; k < n; ++k) {
    const double along = length.back() * k / n;
    while (i + 1 < arc.size() && length[i] < along) ++i;
    const double step = length[i] - length[i - 1];
    const double share = step > 0 ? std::clamp((along - length[i - 1]) / step, 0.0, 1.0) : 0.5;
    const Point& a = surface.position(arc[i - 1]);
    samples[k - 1] = a + share * (surface.position(arc[i]) - a);
  }
}

/// The numbers of a quad mesh's vertices.
class Numbering {
 public:
  Numbering(const QuadLayout& layout, Index n)
      : layout_(layout),
        n_(n),
        first_on_arcs_(static_cast<Index>(layout.node_vertex.size())),
        first_in_patches_(first_on_arcs_ + static_cast<Index>(layout.arcs.size()) * (n - 1)) {}

  Index on_arc(Index arc, Index k) const { return first_on_arcs_ + arc * (n_ - 1) + (k - 1); }
  Index in_patch(Index q, Index i, Index j) const {
    return first_in_patches_ + q * (n_ - 1) * (n_ - 1) + (j - 1) * (n_ - 1) + (i - 1);
  }
  Index count() const {
    return first_in_patches_ + static_cast<Index>(layout_.patches.size()) * (n_ - 1) * (n_ - 1);
  }
  /// At (i, j) of the patch's grid, 0 ≤ i, j ≤ n.
  Index at(Index q, Index i, Index j) const {
    const Quad& quad = layout_.patches[q];
    const bool left = i == 0;
    const bool right = i == n_;
    if (j == 0) return left ? quad.nodes[3] : right ? quad.nodes[0] : on_arc(quad.arcs[3], i);
    if (j == n_) return left ? quad.nodes[2] : right ? quad.nodes[1] : on_arc(quad.arcs[1], n_ - i);
    if (left) return on_arc(quad.arcs[2], j);
    if (right) return on_arc(quad.arcs[0], n_ - j);
    return in_patch(q, i, j);
  }

 private:
  const QuadLayout& layout_;
  Index n_;
  Index first_on_arcs_;
  Index first_in_patches_;
};

}  // namespace

QuadMesh sample(const QuadLayout& layout, Index resolution, const core::Progress& progress) {
  const Index n = resolution;
  if (n < 2) throw core::InvalidArgument("a patch needs a resolution of 2 quads a side or more");
  const double vertices = double(layout.patches.size()) * n * n;
  if (!(vertices < 1e9))
    throw core::InvalidArgument("a resolution of " + std::to_string(n) + " makes more than a billion quads");
  progress.update("sampling patches", 0);
  const LayoutMesh mesh = labelled_surface(layout);
  const auto patches = static_cast<Index>(layout.patches.size());
  std::vector<PatchMap> maps;
  maps.reserve(patches);
  DiscFinder finder(mesh);
  for (Index q = 0; q < patches; ++q) maps.push_back(find_patch(mesh, layout, q, finder));
  progress.update("sampling patches", 0.2);

  const Numbering number(layout, n);
  QuadMesh result;
  result.resolution = n;
  result.positions.resize(number.count());
  for (std::size_t i = 0; i < layout.node_vertex.size(); ++i)
    result.positions[i] = layout.surface.position(layout.node_vertex[i]);
  core::parallel_for(0, layout.arcs.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a)
      sample_arc(layout.surface, layout.arcs[a], n,
                 &result.positions[number.on_arc(static_cast<Index>(a), 1)]);
  });
  core::parallel_for(0, patches, 1, [&](std::size_t q, std::size_t) {
    progress.throw_if_cancelled();
    const auto patch = static_cast<Index>(q);
    parametrise(mesh, patch, maps[q]);
    sample_inside(mesh, patch, maps[q], n, &result.positions[number.in_patch(patch, 1, 1)]);
    maps[q] = {};
  });

  result.quads.resize(std::size_t{patches} * n * n);
  result.patch.resize(result.quads.size());
  for (Index q = 0; q < patches; ++q)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const std::size_t at = (std::size_t{q} * n + j) * n + i;
        result.quads[at] = {number.at(q, i, j), number.at(q, i + 1, j), number.at(q, i + 1, j + 1),
                            number.at(q, i, j + 1)};
        result.patch[at] = q;
      }
  progress.update("sampling patches", 1);
  return result;
}

}  // namespace morsel::mscomplex
