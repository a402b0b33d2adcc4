#pragma once
/// The bilateral filter's sums over pairs of cells, shared between the points of a cell.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/aligned.h"
#include "morsel/morse/smoothing/block_tree.h"
#include "morsel/morse/smoothing/cell_pairs.h"
#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {

/// Sums over all points x of a cell's partners (see CellPairs) at all points v of the cell, in time that does
/// not grow with their product. Both weights become products of a function of v and one of x:
///
///   exp(−(a − b)²/2) = c Σ_k exp(−(a − s_k)²) exp(−(b − s_k)²) for places s_k = s_0 + k h in units of σ_s.
///   With h = 0.5 this holds to 6e-9, relatively, for pairs with (a + b)/2 far from the ends of the grid
///   (Poisson's sum), and to 2e-5 of the largest weight for all those it is used for;
///
///   exp(−‖A + p − q‖²/2), with A the offset of the cells' centres and p, q those of the points, by its
///   Taylor polynomial in p − q (the fast Gauss transform of Greengard and Strain 1991 with Taylor series on
///   both sides).
///
/// So a cell keeps Σ_x (−q)^m/m! exp(−(b − s_k)²) per monomial m and place k, which its partners read. For
/// points whose value is too near the grid's ends, or for which a small error would grow too much, the sums
/// are computed exactly, point by point, and so they are for a few hundred more, to measure the error.
///
/// All arrays are in the order of the tree. The same bits for any number of threads.
class SharedSums {
 public:
  struct Options {
    double radius;
    double sigma;
    double tolerance;  ///< as in CellPairs
  };
  /// O(n). The tree must outlive this.
  SharedSums(const BlockTree& tree, const Options& options, const PairKernels& kernels,
             const core::Progress& progress);

  const CellPairs& pairs() const { return pairs_; }
  /// Roughly how many times faster than visiting all pairs; none if it is not applicable to these values.
  std::optional<double> gain(std::span<const double> values, double sigma_s) const;
  /// Adds the shared pairs to Σ w d and Σ w, which hold the other pairs, and updates the error. `values`
  /// begins at a cache line and has room for all lanes of the last block. Returns false, with unusable sums,
  /// if it is not applicable.
  bool complete(std::span<const double> values, double sigma_s, std::span<double> numerators,
                std::span<double> denominators);
  /// The estimated largest error of the values so far, in their unit, if after each complete() every value
  /// grew by Σ w d / Σ w: 8 times the largest standard error of a value. An estimate, no bound: to first
  /// order, with the error measured in each step at 512 points and propagated through the following steps, by
  /// each value's own growth and by a mean of its neighbours'.
  double error() const;

 private:
  struct Grid {
    double first;  // value of the first place
    int panels;
    double low, high;  // the values within it
    double outside;    // the number of values outside
  };
  struct Point;
  class Pass;
  std::optional<Grid> grid_for(std::span<const double> values, double sigma_s) const;
  using Moments = std::vector<AlignedVector<float>>;  // per layer: those of its cells
  Moments gather_moments(const Pass& pass) const;
  void add(const Grid& grid, std::span<const double> values, double sigma_s, std::span<double> numerators,
           std::span<double> denominators);
  void account(std::span<const double> values, double sigma_s, std::span<const double> numerators,
               std::span<const double> denominators, std::span<const double> growth,
               std::span<const std::uint8_t> done);
  Point exact(std::size_t point, std::span<const double> values, double sigma_s) const;

  const BlockTree& tree_;
  const CellKernels& kernels_;
  const core::Progress& progress_;
  CellPairs pairs_;
  double square_;                  // of the radius, in the tree's coordinates
  double per_sigma_;               // 1 / σ in them
  std::vector<double> shared_;     // Σ w of pairs of cells
  std::vector<double> squares_;    // Σ w (d / σ_s)² of these
  std::vector<double> variances_;  // of the values' errors by now
  double drift_ = 0;               // of the error of a mean of neighbours
};

}  // namespace morsel::morse
