#pragma once
/// The plots of a comparison: persistence diagrams, counts against persistence and against iteration.

#include <cstddef>
#include <string>
#include <vector>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::plot {

/// The points of a persistence diagram by type. x is the birth, y the death, +∞ for essential classes.
struct DiagramPoints {
  std::vector<double> x;
  std::vector<double> y;
};

/// What the plots show of a method.
struct MethodCurves {
  std::string name;  ///< as given on the command line
  DiagramPoints minimum_saddle;
  DiagramPoints saddle_maximum;
  DiagramPoints saddle_cap;
  /// Each component's minimum, the saddles that are paired with no extremum and, of closed components, the
  /// maximum. (The top class of a bounded component is a cap, which is born at +∞ and has no point in a
  /// diagram.)
  DiagramPoints essential;
  std::vector<double> persistences;  ///< of the finite pairs, ascending
  /// Critical points after each iteration of all steps together, the input first; empty if no step iterates.
  std::vector<std::size_t> counts;

  std::size_t pairs() const {
    return minimum_saddle.x.size() + saddle_maximum.x.size() + saddle_cap.x.size();
  }
};

MethodCurves curves_of(const MethodOutcome& outcome);

/// The persistence diagram of one method, a column wide. `field` is what the axes are labelled with.
Plot diagram_plot(const MethodCurves& method, const std::string& field);

/// The diagrams of all methods with the same axes, side by side on the width of a page.
Plot diagram_sheet(const std::vector<MethodCurves>& methods, const std::string& field);

/// The number of finite pairs with at least a persistence against that persistence, both logarithmic; a line
/// a method. It begins at a 100,000th of the largest persistence; smaller ones, zeros included, are not
/// counted.
Plot persistence_plot(const std::vector<MethodCurves>& methods, const std::string& field);

/// Critical points against iteration, a line for each method that iterates; without panels if none does.
Plot iteration_plot(const std::vector<MethodCurves>& methods);

}  // namespace morsel::tools::plot
