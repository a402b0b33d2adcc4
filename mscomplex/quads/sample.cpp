// From a layout to a quad mesh.

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/patch.h"
#include "morsel/mscomplex/quads/polygon_grid.h"
#include "morsel/mscomplex/quads/triangle_search.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::Point;

namespace {

/// The inner points that cut a polyline into n pieces of equal length.
void sample_polyline(const std::vector<Point>& line, Index n, Point* samples) {
  std::vector<double> length(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) length[i] = length[i - 1] + (line[i] - line[i - 1]).norm();
  std::size_t i = 1;
  for (Index k = 1; k < n; ++k) {
    const double along = length.back() * k / n;
    while (i + 1 < line.size() && length[i] < along) ++i;
    const double step = length[i] - length[i - 1];
    const double share = step > 0 ? std::clamp((along - length[i - 1]) / step, 0.0, 1.0) : 0.5;
    samples[k - 1] = line[i - 1] + share * (line[i] - line[i - 1]);
  }
}

/// The numbers of a quad mesh's vertices: nodes but caps, then arc by arc, loop piece by loop piece, patch by
/// patch.
class Numbering {
 public:
  Numbering(const QuadLayout& layout, Index n, const PolygonGrid& square, const PolygonGrid& pentagon)
      : layout_(layout),
        n_(n),
        arc_(layout.arcs.size()),
        rim_(layout.patches.size()),
        inside_(layout.patches.size()) {
    for (const Quad& quad : layout.patches) {
      arc_[quad.arcs[0]] = {quad.nodes[1], quad.nodes[0], 0};
      arc_[quad.arcs[1]] = {quad.nodes[1], quad.nodes[2], 0};
    }
    count_ = static_cast<Index>(layout.node_vertex.size()) - layout.cap_count();
    for (Arc& arc : arc_) {
      arc.first = count_;
      count_ += layout.is_cap(arc.end) ? n : n - 1;
    }
    for (std::size_t q = 0; q < rim_.size(); ++q) {
      rim_[q] = count_;
      if (is_pentagon(q)) count_ += n - 1;
    }
    for (std::size_t q = 0; q < inside_.size(); ++q) {
      inside_[q] = count_;
      count_ += static_cast<Index>((is_pentagon(q) ? pentagon : square).inside.size());
    }
  }

  Index count() const { return count_; }
  bool is_pentagon(std::size_t q) const { return layout_.is_cap(layout_.patches[q].nodes[2]); }
  Index first_on_arc(std::size_t arc) const { return arc_[arc].first; }
  bool ends_at_rim(std::size_t arc) const { return layout_.is_cap(arc_[arc].end); }
  Index first_on_rim(std::size_t q) const { return rim_[q]; }
  Index first_inside(std::size_t q) const { return inside_[q]; }

  /// The number of vertex i of patch q's grid.
  Index at(std::size_t q, Index i) const {
    const std::array<Index, 4>& arcs = layout_.patches[q].arcs;
    const Index side = i / n_;
    const Index k = i % n_;
    const Index sides = is_pentagon(q) ? 5 : 4;
    if (side >= sides) return inside_[q] + (i - sides * n_);
    switch (side) {
      case 0:
        return on_arc(arcs[3], k);
      case 1:
        return on_arc(arcs[0], n_ - k);
      case 2:
        return on_arc(arcs[1], k);
      default:
        if (side == 3 && sides == 5) return k == 0 ? on_arc(arcs[1], n_) : rim_[q] + (k - 1);
        return on_arc(arcs[2], n_ - k);
    }
  }

 private:
  struct Arc {
    Index saddle = kNone, end = kNone, first = 0;
  };
  Index on_arc(Index arc, Index k) const {
    if (k == 0) return arc_[arc].saddle;
    return k == n_ && !ends_at_rim(arc) ? arc_[arc].end : arc_[arc].first + (k - 1);
  }

  const QuadLayout& layout_;
  Index n_;
  std::vector<Arc> arc_;
  std::vector<Index> rim_;
  std::vector<Index> inside_;
  Index count_ = 0;
};

void sample_arcs(const QuadLayout& layout, const Numbering& number, Index n, std::vector<Point>& positions) {
  for (std::size_t i = 0; i < layout.node_vertex.size() - layout.cap_count(); ++i)
    positions[i] = layout.surface.position(layout.node_vertex[i]);
  core::parallel_for(0, layout.arcs.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) {
      std::vector<Point> line;
      for (const Index v : layout.arcs[a]) line.push_back(layout.surface.position(v));
      sample_polyline(line, n, &positions[number.first_on_arc(a)]);
      if (number.ends_at_rim(a)) positions[number.first_on_arc(a) + n - 1] = line.back();
    }
  });
}

void check_resolution(const QuadLayout& layout, Index n) {
  if (n < 2) throw core::InvalidArgument("a patch needs a resolution of 2 quads a side or more");
  if (layout.cap_count() > 0 && (n % 2 != 0 || n < 4))
    throw core::InvalidArgument("the resolution must be 4 or more and even, not " + std::to_string(n) +
                                ": patches at a boundary loop have five sides, and are cut into five");
  if (!(double(layout.patches.size()) * n * n < 1e9))
    throw core::InvalidArgument("a resolution of " + std::to_string(n) + " makes more than a billion quads");
}

}  // namespace

QuadMesh sample(const QuadLayout& layout, Index resolution, const core::Progress& progress) {
  const Index n = resolution;
  check_resolution(layout, n);
  progress.update("sampling patches", 0);
  const LayoutMesh mesh = labelled_surface(layout);
  const std::size_t patches = layout.patches.size();
  std::vector<PatchMap> maps;
  maps.reserve(patches);
  DiscFinder finder(mesh);
  for (Index q = 0; q < patches; ++q) maps.push_back(find_patch(mesh, layout, q, finder));
  progress.update("sampling patches", 0.2);

  const PolygonGrid square = polygon_grid(4, n);
  const PolygonGrid pentagon = polygon_grid(5, n);
  const Numbering number(layout, n, square, pentagon);
  QuadMesh result;
  result.resolution = n;
  result.positions.resize(number.count());
  sample_arcs(layout, number, n, result.positions);
  core::parallel_for(0, patches, 1, [&](std::size_t q, std::size_t) {
    progress.throw_if_cancelled();
    PatchMap& patch = maps[q];
    parametrise(mesh, static_cast<Index>(q), patch);
    const PolygonGrid& grid = patch.sides() == 5 ? pentagon : square;
    sample_inside(mesh, static_cast<Index>(q), patch, grid.inside,
                  result.positions.data() + number.first_inside(q));
    if (patch.sides() == 5) {
      std::vector<Point> rim;
      for (Index i = patch.corner[3]; i <= patch.corner[4]; ++i)
        rim.push_back(mesh.position(patch.disc.vertex[i]));
      sample_polyline(rim, n, &result.positions[number.first_on_rim(q)]);
    }
    patch = {};
  });
  if (layout.cap_count() > 0) {
    // The collars of the layout's surface lie slightly off the input.
    const TriangleSearch input(layout.input.positions(), layout.input.triangles());
    core::parallel_for(0, result.positions.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) result.positions[v] = input.nearest(result.positions[v]);
    });
  }

  for (std::size_t q = 0; q < patches; ++q)
    for (const auto& quad : (number.is_pentagon(q) ? pentagon : square).quads) {
      result.quads.push_back(
          {number.at(q, quad[0]), number.at(q, quad[1]), number.at(q, quad[2]), number.at(q, quad[3])});
      result.patch.push_back(static_cast<Index>(q));
    }
  progress.update("sampling patches", 1);
  return result;
}

}  // namespace morsel::mscomplex
