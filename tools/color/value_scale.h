#pragma once
/// The mapping of values to colours.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "morsel/tools/color/colormap.h"

namespace morsel::tools {

/// The request, before the values are known.
struct ScaleRequest {
  /// A name, or nothing: "blue-orange" where there is a centre, else "sand".
  std::string colormap;
  enum class Center {
    automatic,  ///< of values of both signs zero, or the median where one sign is that of less than a tenth;
                ///< none where limits are given
    zero,
    median,
    none
  };
  Center center = Center::automatic;
  /// Percent of the vertices whose values are cut off at either end, in [0, 50).
  double clip = 2;
  /// Instead of clip: the values at the ends.
  std::optional<std::pair<double, double>> limits;
};

/// "2%", or "LOW/HIGH" in the field's unit with LOW < HIGH; throws InvalidArgument otherwise.
void parse_range(std::string_view text, ScaleRequest& request);

/// Values to colours, linearly.
struct ValueScale {
  Colormap map;
  double low;
  double high;                   ///< above low
  std::optional<double> center;  ///< in the middle of the map
  bool clipped_below;            ///< whether there are values below low
  bool clipped_above;

  double position(double value) const { return (value - low) / (high - low); }
};

/// With a centre both ends are equally far from it: as far as the farther of the two percentiles. Where that
/// leaves no range (constant values), it is widened to one around the value. Values: one or more, finite.
/// O(n).
ValueScale choose_scale(std::span<const double> values, const ScaleRequest& request = {});

}  // namespace morsel::tools
