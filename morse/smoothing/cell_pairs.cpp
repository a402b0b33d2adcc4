#include "morsel/morse/smoothing/cell_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

/// Nanoseconds of one pair of points, of one product of a translation, of a pair of cells besides, and of one
/// coefficient of a point.
constexpr double kPairCost = 0.3;
constexpr double kTermCost = 0.4;
constexpr double kCellPairCost = 25;
constexpr double kPointCost = 0.8;

/// max |He_n(y)| e^{−y²/2} / n!, n = order + 1: the bound of the next derivative.
constexpr double kRemainder[] = {0.125, 0.0483, 0.0209, 0.00727};  // orders 3 … 6

double coefficients(int order) { return (order + 1) * (order + 2) * (order + 3) / 6.0; }

/// Products that a translation takes: pairs of coefficients whose degrees add up to the order at most.
double terms(int order) {
  double result = 1;
  for (int i = 1; i <= 6; ++i) result *= (order + i) / static_cast<double>(i);
  return result;
}

/// The largest distance of a point of some blocks from the middle of their box.
double radius_of(const BlockTree& tree, std::size_t first, std::size_t last) {
  const BlockBox& box = tree.box(first, last);
  const std::size_t lanes = tree.lanes();
  double square = 0;
  for (std::size_t block = first; block < last; ++block)
    for (std::size_t i = 0; i < lanes; ++i) {
      double sum = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = tree.coordinates(block)[axis * lanes + i] - (box.low[axis] + box.high[axis]) / 2;
        sum += d * d;
      }
      square = std::max(square, sum);
    }
  return std::sqrt(square);
}

/// The error of the Taylor polynomials.
class Remainder {
 public:
  explicit Remainder(const CellPairs::Options& options) : tolerance_(options.tolerance) {
    const double support = std::min(options.radius / options.sigma, 2.0);
    least_weight_ = std::exp(-support * support / 2);
  }
  /// Whether the largest error where the radii of two cells add up to `reach` σ is tolerated, relative to the
  /// least weight within the radius, or to that at 2 σ if it is beyond.
  bool is_tolerated(int order, double reach) const {
    return kRemainder[order - CellPairs::kLeastOrder] * std::pow(reach, order + 1) / least_weight_ <=
           tolerance_;
  }
  /// The least order that is tolerated; kMostOrder + 1 if none is.
  int order_for(double reach) const {
    int order = CellPairs::kLeastOrder;
    while (order <= CellPairs::kMostOrder && !is_tolerated(order, reach)) ++order;
    return order;
  }

 private:
  double tolerance_;
  double least_weight_;
};

/// What one cell finds.
struct Found {
  std::vector<std::uint32_t> partners;
  std::vector<std::uint32_t> rest;
};

/// Puts the lists of cells one after the other.
void flatten(const std::vector<Found>& found, std::vector<std::uint32_t> Found::*list,
             std::vector<std::uint32_t>& ends, std::vector<std::uint32_t>& all) {
  ends.resize(found.size());
  std::uint32_t end = 0;
  for (std::size_t c = 0; c < found.size(); ++c)
    ends[c] = end += static_cast<std::uint32_t>((found[c].*list).size());
  all.resize(end);
  core::parallel_for(0, found.size(), 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c)
      std::copy((found[c].*list).begin(), (found[c].*list).end(),
                all.data() + (ends[c] - (found[c].*list).size()));
  });
}

/// The first blocks of the halves of cells.
std::vector<std::uint32_t> halved(const std::vector<std::uint32_t>& firsts) {
  const std::size_t cells = 2 * (firsts.size() - 1);
  std::vector<std::uint32_t> result(cells + 1);
  result[cells] = firsts.back();
  for (std::size_t c = 0; c + 1 < firsts.size(); ++c) {
    result[2 * c] = firsts[c];
    result[2 * c + 1] = (firsts[c] + firsts[c + 1]) / 2;
  }
  return result;
}

/// The lower median.
double usual(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

/// The cells of one depth, while they are paired.
struct CellPairs::Depth {
  std::vector<std::uint32_t> firsts;
  std::vector<double> radii;  // in σ
  int order;
  double points;       // of a cell, on average
  double translation;  // what one costs
  bool used;           // whether the depth saves time

  std::size_t size() const { return radii.size(); }
};

CellPairs::CellPairs(const BlockTree& tree, const Options& options, const core::Progress& progress)
    : tree_(tree) {
  const double per_sigma = 1 / (options.sigma * std::ldexp(1.0, -tree.exponent()));
  const Remainder remainder(options);
  const auto blocks = static_cast<std::uint32_t>(tree.block_count());
  firsts_ = {0, blocks};
  rest_ends_ = {1};
  rest_ = {0};
  for (;;) {
    progress.throw_if_cancelled();
    const std::size_t cells = 2 * (firsts_.size() - 1);
    if (blocks / cells < 2) break;
    Depth depth;
    depth.firsts = halved(firsts_);
    depth.radii.resize(cells);
    core::parallel_for_each(cells, [&](std::size_t c) {
      depth.radii[c] = radius_of(tree, depth.firsts[c], depth.firsts[c + 1]) * per_sigma;
    });
    // The order that suits half of the cells, if it saves time; smaller cells take the rest.
    depth.order = remainder.order_for(2 * usual(depth.radii));
    depth.points = static_cast<double>(tree.size()) / static_cast<double>(cells);
    depth.translation = terms(depth.order) * options.panels * kTermCost + kCellPairCost;
    depth.used =
        depth.order <= kMostOrder && depth.translation < 0.7 * depth.points * depth.points * kPairCost;
    const bool too_small = depth.order == kLeastOrder && !depth.used;
    if (too_small) break;
    add(std::move(depth), options);
  }
  // Of the rest, half is within reach.
  const double points = static_cast<double>(tree.size()) / static_cast<double>(firsts_.size() - 1);
  const double rest = static_cast<double>(rest_.size()) * points * points / 2 * kPairCost;
  rest_cost_ = rest;
  cost_ += rest;
  cost_without_ += rest;
}

void CellPairs::add(Depth depth, const Options& options) {
  const double scale = std::ldexp(1.0, -tree_.exponent());
  const double square = options.radius * scale * options.radius * scale;
  const double inside = square * (1 - 1e-12);
  const double outside = square * (1 + 1e-12);
  const std::size_t full_blocks = tree_.size() / tree_.lanes();
  const Remainder remainder(options);
  const auto& firsts = depth.firsts;
  const auto box = [&](std::size_t c) -> const BlockBox& { return tree_.box(firsts[c], firsts[c + 1]); };
  std::vector<Found> found(depth.size());
  core::parallel_for(0, depth.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t parent = c / 2;
      const std::size_t begin = parent == 0 ? 0 : rest_ends_[parent - 1];
      for (std::size_t k = begin; k < rest_ends_[parent]; ++k)
        for (std::uint32_t other = 2 * rest_[k]; other < 2 * rest_[k] + 2; ++other) {
          const SquareSpan span = squares_between(box(c), box(other));
          if (span.least > outside) continue;
          if (depth.used && c != other && span.most < inside && firsts[c + 1] <= full_blocks &&
              firsts[other + 1] <= full_blocks &&
              remainder.is_tolerated(depth.order, depth.radii[c] + depth.radii[other]))
            found[c].partners.push_back(other);
          else
            found[c].rest.push_back(other);
        }
    }
  });
  flatten(found, &Found::rest, rest_ends_, rest_);
  firsts_ = std::move(depth.firsts);
  if (!depth.used) return;
  CellLayer layer;
  layer.order = depth.order;
  layer.points = static_cast<std::size_t>(depth.points);
  flatten(found, &Found::partners, layer.pair_ends, layer.partners);
  if (layer.partners.empty()) return;
  layer.firsts = firsts_;
  const auto pairs = static_cast<double>(layer.partners.size());
  cost_ += pairs * depth.translation +
           2 * static_cast<double>(tree_.size()) * coefficients(depth.order) * options.panels * kPointCost;
  cost_without_ += pairs * depth.points * depth.points * kPairCost;
  layers_.push_back(std::move(layer));
}

void CellPairs::rest(std::size_t block, std::vector<std::pair<std::uint32_t, std::uint32_t>>& ranges) const {
  const auto cell =
      static_cast<std::size_t>(std::upper_bound(firsts_.begin(), firsts_.end(), block) - firsts_.begin() - 1);
  ranges.clear();
  for (std::size_t k = cell == 0 ? 0 : rest_ends_[cell - 1]; k < rest_ends_[cell]; ++k)
    ranges.emplace_back(firsts_[rest_[k]], firsts_[rest_[k] + 1]);
}

std::uint64_t CellPairs::point_pairs() const {
  std::uint64_t sum = 0;
  for (const CellLayer& layer : layers_)
    for (std::size_t c = 0; c < layer.size(); ++c)
      for (const std::uint32_t other : layer.partners_of(c))
        sum += std::uint64_t{layer.firsts[c + 1] - layer.firsts[c]} *
               (layer.firsts[other + 1] - layer.firsts[other]) * tree_.lanes() * tree_.lanes();
  return sum;
}

}  // namespace morsel::morse
