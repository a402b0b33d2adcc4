#pragma once
/// The colour bar beside a picture.

#include <string>
#include <vector>

#include "morsel/tools/color/value_scale.h"
#include "morsel/tools/render/canvas.h"

namespace morsel::tools::render {

/// The name of a field's quantity ("mean curvature") and its unit in terms of the mesh's ("1/length"; empty
/// if it has none or is unknown).
struct Quantity {
  std::string words;
  std::string unit;
};
/// Of the function's field, or of what methods `made` of it (MethodChain::quantity()), which has no unit.
Quantity quantity_of(const std::string& function, const std::string& unit, const std::string& made = {});

/// Round numbers from low to high, five or so (never more than nine).
std::vector<double> ticks(double low, double high);
/// The shortest text that distinguishes the ticks, with a minus sign (U+2212).
std::string tick_text(double value, double step);

/// The width of the bar's strip; `em` is the size of its letters.
int legend_width(Canvas& canvas, const ValueScale& scale, const Quantity& quantity, double em);
/// Draws it into a strip from `x` on, in the middle of `height`. Values that are cut off are shown by
/// arrowheads.
void draw_legend(Canvas& canvas, const ValueScale& scale, const Quantity& quantity, double em, double x,
                 double height);

}  // namespace morsel::tools::render
