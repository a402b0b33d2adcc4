#include "morsel/morse/smoothing/ball_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "morsel/morse/operators/largest_square.h"

namespace morsel::morse {
namespace {

using Run = std::pair<std::uint32_t, std::uint32_t>;

/// Set bits of `lanes` masks, 8 bytes at a time: not every processor counts bits by itself.
template <class Mask>
unsigned count_bits(const Mask* masks, std::size_t lanes) {
  unsigned count = 0;
  for (std::size_t i = 0; i < lanes; i += 8 / sizeof(Mask)) {
    std::uint64_t word = 0;
    std::memcpy(&word, masks + i, sizeof(word));
    word -= (word >> 1) & 0x5555555555555555U;
    word = (word & 0x3333333333333333U) + ((word >> 2) & 0x3333333333333333U);
    word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fU;
    count += static_cast<unsigned>((word * 0x0101010101010101U) >> 56);
  }
  return count;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

template <class Mask>
std::size_t BallPairs<Mask>::bytes() const {
  return bytes_of(reached) + bytes_of(runs) + bytes_of(run_ends) + bytes_of(blocks) + bytes_of(masks) +
         bytes_of(block_ends) + sizeof(*this);
}

template <class Mask>
TilePairs<Mask> BallPairs<Mask>::view() const {
  return {run_ends.size(), reached.size(), runs.data(),      run_ends.data(),
          blocks.data(),   masks.data(),   block_ends.data()};
}

/// What is found for one tile; kept from tile to tile for its memory.
template <class Mask>
struct BallSearch<Mask>::Tile {
  std::vector<Run> ranges;  // of the tree, still to be visited
  std::vector<Run> runs;
  std::vector<std::uint32_t> blocks;
  std::vector<Mask> masks;
  std::uint64_t pairs;  // each once
};

template <class Mask>
BallSearch<Mask>::BallSearch(const BlockTree& tree, double radius, const PairKernels& kernels,
                             const CellPairs* shared)
    : tree_(tree), shared_(shared), square_(largest_square(std::ldexp(radius, -tree.exponent()))) {
  if constexpr (std::is_same_v<Mask, std::uint8_t>)
    cut_ = kernels.cut8;
  else
    cut_ = kernels.cut16;
}

template <class Mask>
void BallSearch<Mask>::collect(std::size_t tile, Tile& found) const {
  // Boxes decide only what a few roundings cannot change.
  const double outside = square_ * (1 + 1e-12);
  const double inside = square_ * (1 - 1e-12);
  const auto self = static_cast<std::uint32_t>(tile);
  const std::size_t full_blocks = tree_.size() / tree_.lanes();  // a short block always needs its masks
  const BlockBox& own = tree_.box(tile, tile + 1);
  found.runs.clear();
  found.blocks.clear();
  if (shared_ != nullptr) {
    shared_->rest(tile, found.ranges);
    std::reverse(found.ranges.begin(), found.ranges.end());
  } else {
    found.ranges.assign(1, {0, static_cast<std::uint32_t>(tree_.block_count())});
  }
  while (!found.ranges.empty()) {
    const auto [first, last] = found.ranges.back();
    found.ranges.pop_back();
    if (last <= self) continue;
    const SquareSpan span = squares_between(own, tree_.box(first, last));
    if (span.least > outside) continue;
    if (first > self && last <= full_blocks && span.most < inside) {
      if (!found.runs.empty() && found.runs.back().second == first)
        found.runs.back().second = last;
      else
        found.runs.emplace_back(first, last);
      continue;
    }
    if (last - first == 1) {
      found.blocks.push_back(first);
      continue;
    }
    const std::uint32_t middle = (first + last) / 2;
    found.ranges.emplace_back(middle, last);
    found.ranges.emplace_back(first, middle);
  }
}

template <class Mask>
void BallSearch<Mask>::decide(std::size_t tile, Tile& found) const {
  const std::size_t lanes = tree_.lanes();
  const auto all = static_cast<Mask>(~Mask{0});
  const auto valid = [&](std::size_t block) {
    return static_cast<Mask>(all >> (lanes - tree_.points_in(block)));
  };
  found.masks.resize(found.blocks.size() * lanes);
  cut_(tree_.coordinates(tile), tree_.coordinates(0), found.blocks.data(), found.blocks.size(), square_,
       found.masks.data());
  found.pairs = 0;
  for (const auto& [first, last] : found.runs) found.pairs += std::uint64_t{last - first} * lanes * lanes;
  std::size_t kept = 0;
  bool new_runs = false;
  for (std::size_t k = 0; k < found.blocks.size(); ++k) {
    const std::uint32_t block = found.blocks[k];
    Mask* const masks = &found.masks[k * lanes];
    if (block == tile || tree_.points_in(block) < lanes)
      for (std::size_t i = 0; i < lanes; ++i) {
        masks[i] &= valid(block);
        if (i >= tree_.points_in(tile)) masks[i] = 0;
        if (block == tile) masks[i] &= static_cast<Mask>(~((Mask{2} << i) - 1U));  // behind itself
      }
    const unsigned bits = count_bits(masks, lanes);
    found.pairs += bits;
    if (bits == lanes * lanes) {
      found.runs.emplace_back(block, block + 1);
      new_runs = true;
    } else if (bits != 0 || block == tile) {
      found.blocks[kept] = block;
      std::copy_n(masks, lanes, &found.masks[kept * lanes]);
      ++kept;
    }
  }
  found.blocks.resize(kept);
  found.masks.resize(kept * lanes);
  if (!new_runs) return;
  std::sort(found.runs.begin(), found.runs.end());
  std::size_t runs = 0;
  for (std::size_t k = 1; k < found.runs.size(); ++k) {
    if (found.runs[k].first == found.runs[runs].second)
      found.runs[runs].second = found.runs[k].second;
    else
      found.runs[++runs] = found.runs[k];
  }
  found.runs.resize(runs + 1);
}

template <class Mask>
BallPairs<Mask> BallSearch<Mask>::find(std::size_t first, std::size_t last) const {
  BallPairs<Mask> result;
  Tile found;
  std::vector<std::uint32_t> local(tree_.block_count() - first, 0);
  for (std::size_t tile = first; tile < last; ++tile) {
    collect(tile, found);
    decide(tile, found);
    for (const auto& [begin, end] : found.runs) {
      result.runs.insert(result.runs.end(), {begin, end});
      std::fill(&local[begin - first], &local[begin - first] + (end - begin), 1);
    }
    for (const std::uint32_t block : found.blocks) local[block - first] = 1;
    result.run_ends.push_back(static_cast<std::uint32_t>(result.runs.size() / 2));
    result.blocks.insert(result.blocks.end(), found.blocks.begin(), found.blocks.end());
    result.masks.insert(result.masks.end(), found.masks.begin(), found.masks.end());
    result.block_ends.push_back(static_cast<std::uint32_t>(result.blocks.size()));
    result.most_blocks = std::max(result.most_blocks, found.blocks.size());
    result.pairs += 2 * found.pairs;
  }
  for (std::size_t b = 0; b < local.size(); ++b)
    if (local[b] != 0) {
      local[b] = static_cast<std::uint32_t>(result.reached.size());
      result.reached.push_back(static_cast<std::uint32_t>(first + b));
    }
  // A run's blocks are all reached, so they stay neighbours.
  for (std::size_t k = 0; k < result.runs.size(); k += 2) {
    const std::uint32_t length = result.runs[k + 1] - result.runs[k];
    result.runs[k] = local[result.runs[k] - first];
    result.runs[k + 1] = result.runs[k] + length;
  }
  for (std::uint32_t& block : result.blocks) block = local[block - first];
  return result;
}

template class BallSearch<std::uint8_t>;
template class BallSearch<std::uint16_t>;
template struct BallPairs<std::uint8_t>;
template struct BallPairs<std::uint16_t>;

}  // namespace morsel::morse
