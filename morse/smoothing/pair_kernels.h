#pragma once
/// The inner loops of the bilateral filter, one set of functions for each instruction set.
///
/// The files that implement them are compiled with different flags, so they must share nothing that a linker
/// could merge: here and in pair_kernels.inc are plain structs only, no function is defined outside an
/// unnamed namespace, and nothing of the standard library but its integers is used.

#include <cstddef>
#include <cstdint>

#include "morsel/morse/smoothing/cell_kernels.h"
#include "morsel/morse/smoothing/instruction_set.h"

namespace morsel::morse {

/// Pairs (v, x) that lie within the radius, each pair of points once, for a run of consecutive blocks
/// ("tiles") v and the blocks x that they reach. Blocks are numbered within the chunk; the tiles come first.
template <class Mask>
struct TilePairs {
  std::size_t tiles;
  std::size_t reached;  ///< blocks in the chunk
  const std::uint32_t*
      runs;  ///< first and last (past the end) of runs of blocks wholly within reach of a tile
  const std::uint32_t* run_ends;    ///< per tile, how many runs there are up to and with it
  const std::uint32_t* blocks;      ///< blocks partly within reach
  const Mask* masks;                ///< of each of these, for each point of the tile: which of its points are
  const std::uint32_t* block_ends;  ///< per tile, how many blocks there are up to and with it
};

/// One point of a tile and one block that is partly within its reach.
struct PairStep {
  std::uint32_t block;
  std::uint16_t point;
  std::uint16_t mask;
};

/// Working memory.
template <class Real>
struct PairScratch {
  std::uint32_t* whole;  ///< as many as there are blocks in the chunk
  PairStep* steps;       ///< one more than lanes times as many as a tile has blocks partly within reach
  Real* sums;            ///< as many as the function's sums; only for Real = float
};

/// A kernel over pairs: see PairFunctions.
template <class Real, class Mask>
using PairFunction = void (*)(const TilePairs<Mask>& pairs, const Real* points, double* sums, Real unit,
                              const PairScratch<Real>& scratch);

/// Functions for one layout. `points` holds per block lanes x, lanes y, lanes z, in units of σ · √(2 ln 2),
/// and lanes values: doubles, or for Real = float 32-bit integers in place of floats, whose differences must
/// not overflow (a float would round a large value by more than a small difference may bear). `unit` times a
/// difference is in units of σ_s · √(2 ln 2). `sums` has the sums per block. 64-byte aligned.
template <class Real, class Mask>
struct PairFunctions {
  /// Adds w (f(x) − f(v)) to the first lanes of sums, w to the second.
  PairFunction<Real, Mask> fixed;
  /// `points` has each point's own unit besides, per block lanes more. Adds the same.
  PairFunction<Real, Mask> local;
  /// Raises sums (lanes a block) to the largest |f(x) − f(v)|.
  PairFunction<Real, Mask> spread;
};

/// The same where w is multiplied by a weight of x. `points` has the weights last, per block lanes more.
template <class Real, class Mask>
struct WeightedFunctions {
  PairFunction<Real, Mask> fixed;
  PairFunction<Real, Mask> local;
};

/// For each of `count` blocks, and each point of the tile: which of the block's points have a square of the
/// distance to it of at most `square`. Coordinates are lanes x, lanes y, lanes z a block. Rounded exactly as
/// x² + (y² + z²) is without fused operations, so every instruction set decides the same.
template <class Mask>
using CutFunction = void (*)(const double* tile, const double* coordinates, const std::uint32_t* blocks,
                             std::size_t count, double square, Mask* masks);

/// Sums agree between instruction sets bit by bit where these have fused multiply-adds (AVX2 and AVX-512 do,
/// x86-64's baseline has none), else up to rounding.
struct PairKernels {
  CutFunction<std::uint8_t> cut8;
  CutFunction<std::uint16_t> cut16;
  PairFunctions<double, std::uint8_t> double8;    ///< blocks of 8
  PairFunctions<double, std::uint16_t> double16;  ///< blocks of 16
  PairFunctions<float, std::uint16_t> float16;
  WeightedFunctions<double, std::uint8_t> weighted8;
  CellKernels cells;
};

/// The kernels for an instruction set that the processor has.
const PairKernels& pair_kernels(InstructionSet set);

extern const PairKernels kBaselineKernels;
#ifdef MORSEL_X86_KERNELS
extern const PairKernels kAvx2Kernels;
extern const PairKernels kAvx512Kernels;
#endif

}  // namespace morsel::morse
