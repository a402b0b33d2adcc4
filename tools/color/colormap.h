#pragma once
/// Perceptually uniform colour maps, readable by the colour-blind.

#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/color/color.h"

namespace morsel::tools {

/// A path through the colours.
class Colormap {
 public:
  /// One of colormap_names(); throws InvalidArgument, listing them, for another name.
  explicit Colormap(std::string_view name);

  const std::string& name() const { return name_; }
  /// Whether the middle is neutral and both ends have the same lightness.
  bool is_diverging() const { return diverging_; }
  /// The colour at t in [0, 1]; beyond, that of the end.
  Color operator()(double t) const;

 private:
  std::string name_;
  bool diverging_ = false;
  std::vector<Color> table_;  // evenly spaced
};

/// Diverging ones first. "viridis" is of van der Walt and Smith (2015, CC0), "cividis" of Nuñez, Anderton,
/// Renslow (2018, CC0), both by 33 points of their tables. "blue-orange", "purple-green" and "sand" are
/// defined here, in OKLab: their lightness falls evenly from the middle to the ends, or from the lower end to
/// the upper.
std::vector<std::string> colormap_names();

}  // namespace morsel::tools
