#include "morsel/morse/smoothing/neighborhoods.h"

#include <algorithm>

#include "morsel/core/parallel.h"

namespace morsel::morse {

using core::Index;

Neighborhoods::Neighborhoods(std::span<const core::Point> points, double radius, std::size_t memory,
                             const core::Progress& progress)
    : points_(points), radius_(radius), search_(points), chunks_((points.size() + kChunk - 1) / kChunk) {
  std::atomic<std::size_t> entries_left = memory / sizeof(Index);
  if (entries_left == 0) return;
  core::parallel_for(0, chunks_.size(), 1, [&](std::size_t chunk, std::size_t) {
    progress.throw_if_cancelled();
    store(chunk, entries_left);
  });
}

void Neighborhoods::store(std::size_t chunk, std::atomic<std::size_t>& entries_left) {
  const std::size_t first = chunk * kChunk;
  const std::size_t last = std::min(points_.size(), first + kChunk);
  Lists lists;
  std::vector<Index> found;
  for (std::size_t v = first; v < last; ++v) {
    search_.within(points_[v], radius_, found);
    // Takes from what is left; when it does not suffice, this chunk and all later ones go without.
    std::size_t left = entries_left;
    do {
      if (left < found.size()) {
        entries_left = 0;
        return;
      }
    } while (!entries_left.compare_exchange_weak(left, left - found.size()));
    lists.ids.insert(lists.ids.end(), found.begin(), found.end());
    lists.ends.push_back(lists.ids.size());
  }
  lists.ids.shrink_to_fit();
  chunks_[chunk] = std::move(lists);
}

std::span<const Index> Neighborhoods::of(std::size_t v, std::vector<Index>& scratch) const {
  const Lists& lists = chunks_[v / kChunk];
  if (lists.ends.empty()) {
    search_.within(points_[v], radius_, scratch);
    return scratch;
  }
  const std::size_t i = v % kChunk;
  const std::size_t begin = i == 0 ? 0 : lists.ends[i - 1];
  return std::span<const Index>(lists.ids).subspan(begin, lists.ends[i] - begin);
}

}  // namespace morsel::morse
