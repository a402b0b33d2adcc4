#pragma once
/// The balls around all points that an iterative filter visits again and again.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/neighbors.h"
#include "morsel/core/progress.h"

namespace morsel::morse {

/// For each point, the numbers of the points within `radius` of it, itself included, ascending. As many lists
/// as fit into `memory` bytes are found once and stored (4 bytes an entry); the others are searched for
/// whenever they are asked for, so any radius works in bounded memory. Which are stored changes nothing but
/// time. Reading is safe from any number of threads.
class Neighborhoods {
 public:
  /// Points are stored and best visited in chunks of this many.
  static constexpr std::size_t kChunk = 128;

  Neighborhoods(std::span<const core::Point> points, double radius, std::size_t memory,
                const core::Progress& progress);

  /// The neighbours of point v, in `scratch` or in the store: valid until scratch changes.
  std::span<const core::Index> of(std::size_t v, std::vector<core::Index>& scratch) const;

 private:
  /// Lists of consecutive points, one after the other; no ends if they are not stored.
  struct Lists {
    std::vector<core::Index> ids;
    std::vector<std::size_t> ends;
  };
  void store(std::size_t chunk, std::atomic<std::size_t>& entries_left);

  std::span<const core::Point> points_;
  double radius_;
  core::PointSearch search_;
  std::vector<Lists> chunks_;
};

}  // namespace morsel::morse
