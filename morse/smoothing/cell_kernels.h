#pragma once
/// The inner loops of sums over cells, one set of functions for each instruction set. What pair_kernels.h
/// says of shared code holds here too.

#include <cstddef>
#include <cstdint>

namespace morsel::morse {

/// Monomials x^i y^j z^k / (i! j! k!), ordered by degree, so that those up to an order come first.
struct MonomialTables {
  static constexpr int kOrder = 6;
  static constexpr int kCount = 84;  // (6 + 3)! / 6! 3!
  /// Monomial m is monomial parent[m] times coordinate axis[m] times factor[m].
  std::uint8_t parent[kCount];
  std::uint8_t axis[kCount];
  float factor[kCount];
  std::uint8_t powers[kCount][3];
  std::uint8_t sums[kCount]
                   [kCount];  // the monomial whose powers are the sums of two's, where the degree allows
};

/// Vectors of values on a grid: panels of 16 floats.
inline constexpr int kPanel = 16;
inline constexpr int kMostPanels = 4;

/// The 16 points of a block as seen from a cell's centre: 16 x, 16 y, 16 z in units of σ.
struct CellPoints {
  alignas(64) float at[3][16];
};

/// Where a cell's centre lies, in units of σ.
struct CellOffset {
  float at[3];
};

/// e^{−y²} on the grid is 2^{−(step t)²} with t counted in steps.
struct CellKernelOptions {
  const MonomialTables* tables;
  int order;   ///< of the expansion
  int panels;  ///< at most kMostPanels
  float step;  ///< of the grid, in units of σ_s · √(ln 2)
};

/// One point and blocks that may be within its reach.
struct PointBlocks {
  const double* coordinates;  ///< 16 x, 16 y, 16 z per block
  const double* values;       ///< 16 per block
  const std::uint32_t* blocks;
  std::size_t count;
  const double* at;  ///< the point's coordinates
  double value;
  double square;     ///< of the radius
  double per_sigma;  ///< squares of distances times its square are in units of σ² · 2 ln 2
  double unit;       ///< the same for differences, not squared
};

struct CellKernels {
  /// weights[i] = e^{−y²} on the grid, for 16 values in steps of the grid from its middle place (number 8 ·
  /// panels).
  void (*weigh)(const CellKernelOptions& options, const float* values, float* weights);
  /// moments[m] += Σ over the points of monomial m of −at, times their weights.
  void (*gather)(const CellKernelOptions& options, const CellPoints& points, const float* weights,
                 float* moments);
  /// local[m] += Σ over `count` cells, Σ over m2 of moments[m2] times the derivative m + m2 of the Gaussian
  /// at the cell's offset (x, y, z each). The m are those of the order, and so are m + m2.
  void (*translate)(const CellKernelOptions& options, const float* const* moments, const CellOffset* offsets,
                    std::size_t count, float* local);
  /// sums[i] += Σ over m of monomial m of at, times local[m].
  void (*spread)(const CellKernelOptions& options, const CellPoints& points, const float* local, float* sums);
  /// For each of 16 points: Σ u, Σ u y, Σ u y² over the grid, y from the point up to the place in units of
  /// σ_s, and u its weights times its sums: results[0 … 2][16].
  void (*finish)(const CellKernelOptions& options, const float* values, const float* weights,
                 const float* sums, float (*results)[16]);
  /// Adds Σ w, Σ w d, Σ w d² over the points of the blocks that lie within the radius, in double precision.
  void (*point)(const PointBlocks& work, double* sums);
};

}  // namespace morsel::morse
