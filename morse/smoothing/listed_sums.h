#pragma once
/// The bilateral filter's sums, vertex by vertex over lists of neighbours.

#include <atomic>
#include <cstddef>
#include <vector>

#include "morsel/morse/operators/connected_ball.h"
#include "morsel/morse/smoothing/bilateral_engine.h"

namespace morsel::morse {

/// S over connected balls, with weights if there are such, in float64: each vertex has its list of
/// neighbours, and each pair, in each direction, takes one exponential. The lists are kept as long as there
/// is memory for them (4 bytes a pair) and found again where there is none. The same bits for any number of
/// threads and any memory.
class ListedSums final : public BilateralEngine {
 public:
  /// `options` with a surface that connects. Refers to `progress`.
  ListedSums(std::span<const core::Point> points, const BilateralFilter::Options& options,
             const core::Progress& progress);

  void apply(std::span<const double> values, std::optional<double> sigma_s, std::span<double> result,
             const BilateralFilter::Report& report) override;
  std::optional<double> gain(std::span<const double>, double) const override { return std::nullopt; }
  double error() const override { return 0; }
  std::uint64_t pairs() const override;

 private:
  /// The neighbours of consecutive vertices, list after list.
  struct Lists {
    std::vector<core::Index> neighbors;
    std::vector<std::size_t> ends;
  };
  struct Chunk {
    bool stored = false;
    Lists lists;
    std::uint64_t pair_count = 0;
  };
  struct Call {
    std::span<const double> values;
    std::optional<double> sigma_s;
    std::span<double> result;
  };

  void visit(std::size_t chunk, const Call& call);
  Lists find(std::size_t first, std::size_t last) const;
  double mean_difference(core::Index v, std::span<const core::Index> ball, const Call& call) const;
  bool take_memory(std::size_t bytes);

  const core::Progress& progress_;
  std::vector<core::Point> points_;
  std::vector<double> weights_;
  double radius_;
  double per_sigma_;
  ConnectedBalls balls_;
  std::size_t grain_;
  std::vector<Chunk> chunks_;
  std::atomic<std::size_t> memory_left_;
};

}  // namespace morsel::morse
