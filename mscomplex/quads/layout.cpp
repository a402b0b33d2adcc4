// The layout of a complex.

#include "morsel/core/error.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/arc_drawing.h"
#include "morsel/mscomplex/quads/layout_conditions.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;

QuadLayout embed_layout(const MorseSmaleComplex& complex, const LayoutOptions& options,
                        const core::Progress& progress) {
  if (options.relaxation < 0)
    throw core::InvalidArgument("a layout cannot be relaxed a negative number of times");
  require_arcs(complex);
  require_no_dangling(complex);
  const int steps = options.relaxation + 1;
  progress.update("quad layout", 0);
  ArcDrawing drawing(complex);
  drawing.draw_first(ArcDrawing::most_at_first(drawing.mesh().triangle_count()));
  for (int round = 1; round < steps; ++round) {
    progress.update("quad layout", double(round) / steps);
    drawing.relax(progress);
  }
  QuadLayout layout{complex.mesh(),   drawing.mesh().mesh(), drawing.node_vertex(), {}, {}, {},
                    drawing.missed(), drawing.left()};
  layout.arcs.resize(complex.arc_count());
  for (Index arc = 0; arc < complex.arc_count(); ++arc) drawing.follow(arc, layout.arcs[arc]);
  for (Index q = 0; q < complex.quad_count(); ++q) layout.patches.push_back(complex.quad(q));
  layout.patch_of_triangle.assign(layout.surface.triangle_count(), kNone);
  DiscFinder finder(drawing.mesh());
  for (Index q = 0; q < complex.quad_count(); ++q) {
    const Disc disc = finder.find(drawing.start_of(2 * q), "patch " + std::to_string(q));
    for (const Index t : disc.triangles) layout.patch_of_triangle[t] = q;
  }
  progress.update("quad layout", 1);
  return layout;
}

}  // namespace morsel::mscomplex
