#include "morsel/morse/smoothing/listed_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

using core::Index;
using core::Point;

ListedSums::ListedSums(std::span<const Point> points, const BilateralFilter::Options& options,
                       const core::Progress& progress)
    : progress_(progress),
      points_(points.begin(), points.end()),
      weights_(options.weights),
      radius_(options.radius),
      per_sigma_(1 / options.sigma),
      balls_(*options.connected_by),
      grain_(balls_.grain()),
      chunks_((points.size() + grain_ - 1) / grain_),
      memory_left_(options.memory) {}

void ListedSums::apply(std::span<const double> values, std::optional<double> sigma_s,
                       std::span<double> result, const BilateralFilter::Report& report) {
  const Call call{values, sigma_s, result};
  // Slab by slab, so that progress and stops are checked between them.
  const std::size_t slab = std::max<std::size_t>(16, 4 * static_cast<std::size_t>(core::thread_count()));
  for (std::size_t begin = 0; begin < chunks_.size(); begin += slab) {
    report(static_cast<double>(begin) / static_cast<double>(chunks_.size()));
    const std::size_t end = std::min(chunks_.size(), begin + slab);
    core::parallel_for(begin, end, 1, [&](std::size_t k, std::size_t) {
      progress_.throw_if_cancelled();
      visit(k, call);
    });
  }
}

std::uint64_t ListedSums::pairs() const {
  std::uint64_t sum = 0;
  for (const Chunk& chunk : chunks_) sum += chunk.pair_count;
  return sum;
}

void ListedSums::visit(std::size_t number, const Call& call) {
  Chunk& chunk = chunks_[number];
  const std::size_t first = number * grain_;
  const std::size_t last = std::min(points_.size(), first + grain_);
  Lists found;
  if (!chunk.stored) {
    found = find(first, last);
    chunk.pair_count = found.neighbors.size();
  }
  const Lists& lists = chunk.stored ? chunk.lists : found;
  std::size_t begin = 0;
  for (std::size_t v = first; v < last; ++v) {
    const std::size_t end = lists.ends[v - first];
    call.result[v] =
        mean_difference(static_cast<Index>(v), {lists.neighbors.data() + begin, end - begin}, call);
    begin = end;
  }
  if (chunk.stored) return;
  const std::size_t bytes = found.neighbors.size() * sizeof(Index) + found.ends.size() * sizeof(std::size_t);
  if (!take_memory(bytes)) return;
  chunk.lists = found;  // a copy has no spare capacity
  chunk.stored = true;
}

ListedSums::Lists ListedSums::find(std::size_t first, std::size_t last) const {
  ConnectedBalls::Walk walk(balls_);
  Lists lists;
  lists.ends.reserve(last - first);
  std::vector<Index> ball;
  for (std::size_t v = first; v < last; ++v) {
    walk.within(static_cast<Index>(v), radius_, ball);
    lists.neighbors.insert(lists.neighbors.end(), ball.begin(), ball.end());
    lists.ends.push_back(lists.neighbors.size());
  }
  return lists;
}

double ListedSums::mean_difference(Index v, std::span<const Index> ball, const Call& call) const {
  const double value = call.values[v];
  double sigma_s = call.sigma_s.value_or(0);
  if (!call.sigma_s)
    for (const Index x : ball) sigma_s = std::max(sigma_s, std::abs(call.values[x] - value));
  if (sigma_s == 0) return 0;
  const Point& center = points_[v];
  double numerator = 0;
  double denominator = 0;
  for (const Index x : ball) {
    const double difference = call.values[x] - value;
    const double t = difference / sigma_s;
    double weight = std::exp(-(((points_[x] - center) * per_sigma_).squaredNorm() + t * t) / 2);
    if (!weights_.empty()) weight *= weights_[x];
    numerator += difference * weight;
    denominator += weight;
  }
  return denominator > 0 ? numerator / denominator : 0;
}

/// Takes from the remaining memory; which thread is first changes time only.
bool ListedSums::take_memory(std::size_t bytes) {
  std::size_t left = memory_left_;
  while (left >= bytes && !memory_left_.compare_exchange_weak(left, left - bytes)) {
  }
  return left >= bytes;
}

}  // namespace morsel::morse
