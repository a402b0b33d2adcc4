#include "morsel/morse/smoothing/block_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;

/// The power of two that the largest coordinate has, or nearly so where its inverse would not be a number.
int exponent_of(std::span<const Point> points) {
  const double largest = core::parallel_reduce(
      0, points.size(), core::kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) part = std::max(part, points[i].cwiseAbs().maxCoeff());
        return part;
      },
      [](double a, double b) { return std::max(a, b); });
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::clamp(exponent, -1000, 1000);
}

template <class Items>
BlockBox box_of(const Items& items, std::size_t first, std::size_t last) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BlockBox box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::size_t i = first; i < last; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], items[i].at[axis]);
      box.high[axis] = std::max(box.high[axis], items[i].at[axis]);
    }
  return box;
}

std::size_t longest_axis(const BlockBox& box) {
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest]) longest = axis;
  return longest;
}

}  // namespace

SquareSpan squares_between(const BlockBox& a, const BlockBox& b) {
  SquareSpan span{0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double up = b.high[axis] - a.low[axis];
    const double down = a.high[axis] - b.low[axis];
    const double gap = std::max(0.0, -std::min(up, down));
    const double reach = std::max(up, down);
    span.least += gap * gap;
    span.most += reach * reach;
  }
  return span;
}

BlockTree::BlockTree(std::span<const Point> points, std::size_t lanes, const core::Progress& progress)
    : lanes_(lanes), exponent_(exponent_of(points)), order_(points.size()) {
  const std::size_t blocks = (points.size() + lanes - 1) / lanes;
  leaf_boxes_.resize(blocks);
  inner_boxes_.resize(blocks);
  coordinates_.resize(3 * lanes * blocks);
  std::vector<Item> items(points.size());
  const double factor = std::ldexp(1.0, -exponent_);
  core::parallel_for_each(points.size(), [&](std::size_t i) {
    const Point p = points[i] * factor;
    items[i] = {{p.x(), p.y(), p.z()}, static_cast<Index>(i)};
  });
  if (blocks > 1) split(items, progress);
  core::parallel_for(0, blocks, core::kGrain / lanes, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t begin = b * lanes_;
      const std::size_t count = points_in(b);
      // Which points a block has is determined, but their order depends on the standard library: it is fixed
      // here.
      std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
                items.begin() + static_cast<std::ptrdiff_t>(begin + count),
                [](const Item& x, const Item& y) { return x.point < y.point; });
      leaf_boxes_[b] = box_of(items, begin, begin + count);
      for (std::size_t i = 0; i < lanes_; ++i) {
        const Item& item = items[begin + std::min(i, count - 1)];
        for (std::size_t axis = 0; axis < 3; ++axis)
          coordinates_[(3 * b + axis) * lanes_ + i] = item.at[axis];
        if (i < count) order_[begin + i] = item.point;
      }
    }
  });
}

void BlockTree::split(std::vector<Item>& items, const core::Progress& progress) {
  // Depth by depth, the ranges of a depth in parallel.
  using Range = std::pair<std::size_t, std::size_t>;
  std::vector<Range> level = {{0, block_count()}};
  while (!level.empty()) {
    progress.throw_if_cancelled();
    const std::size_t points_in_range = items.size() / level.size();
    const std::size_t grain = std::max<std::size_t>(1, core::kGrain / (points_in_range + 1));
    core::parallel_for(0, level.size(), grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const auto [begin, end] = level[k];
        const std::size_t middle = (begin + end) / 2;
        const std::size_t from = begin * lanes_;
        const std::size_t to = std::min(end * lanes_, items.size());
        inner_boxes_[middle] = box_of(items, from, to);
        const std::size_t axis = longest_axis(inner_boxes_[middle]);
        std::nth_element(items.begin() + static_cast<std::ptrdiff_t>(from),
                         items.begin() + static_cast<std::ptrdiff_t>(middle * lanes_),
                         items.begin() + static_cast<std::ptrdiff_t>(to),
                         [axis](const Item& x, const Item& y) {
                           return x.at[axis] < y.at[axis] || (x.at[axis] == y.at[axis] && x.point < y.point);
                         });
      }
    });
    std::vector<Range> next;
    next.reserve(2 * level.size());
    for (const auto& [begin, end] : level) {
      const std::size_t middle = (begin + end) / 2;
      if (middle - begin > 1) next.emplace_back(begin, middle);
      if (end - middle > 1) next.emplace_back(middle, end);
    }
    level = std::move(next);
  }
}

}  // namespace morsel::morse
