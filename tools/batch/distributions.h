#pragma once
/// Plots of a whole collection: how the methods' numbers of critical points are distributed over its meshes.

#include <string>
#include <vector>

#include "morsel/tools/plot/plot.h"

namespace morsel::tools::batch {

/// One method on all meshes: the i-th of each is of one mesh.
struct MethodTotals {
  std::string name;  ///< as given
  std::vector<double> vertices;
  std::vector<double> totals;
};

/// The histogram of the meshes' numbers of critical points, in bins of equal width on a logarithmic axis, a
/// line a method.
plot::Plot histogram(const std::vector<MethodTotals>& methods);

/// The share of meshes with at most so many critical points, a line a method.
plot::Plot cumulative(const std::vector<MethodTotals>& methods);

/// Critical points against vertices, a mark a mesh and method.
plot::Plot against_size(const std::vector<MethodTotals>& methods);

/// Edges of the bins that histogram() counts in: powers of 10 with four bins between two of them, from one
/// that is no larger than the smallest value to one that is larger than the largest. All values must be > 0,
/// and there must be one.
std::vector<double> logarithmic_bins(const std::vector<double>& values);

}  // namespace morsel::tools::batch
