#include "morsel/morse/smoothing/shared_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/largest_square.h"
#include "morsel/morse/smoothing/monomial_tables.h"

namespace morsel::morse {
namespace {

constexpr double kStep = 0.5;  // of the grid, in σ_s
constexpr double kMargin = 3;  // in σ_s: values nearer to the grid's ends are summed exactly
constexpr double kLog2E = 1.4426950408889634;
/// Points whose own error grows by more than this in a step are summed exactly.
constexpr double kUnstable = 1.2;
constexpr double kFewNeighbors = 8;
constexpr std::size_t kSamples = 512;
/// error() is this many standard deviations, and a mean over a ball reduces these at least by the second
/// factor.
constexpr double kSafety = 8;
constexpr double kNeighborhood = 4;
constexpr std::size_t kLanes = 16;

std::size_t coefficients(int order) {
  return static_cast<std::size_t>((order + 1) * (order + 2) * (order + 3) / 6);
}

std::array<double, 3> center_of(const BlockBox& box) {
  std::array<double, 3> center{};
  for (std::size_t axis = 0; axis < 3; ++axis) center[axis] = (box.low[axis] + box.high[axis]) / 2;
  return center;
}

/// Panels that the layers are chosen for.
constexpr int kUsualPanels = 2;
/// An exactly summed point costs that many times its share of visiting all pairs.
constexpr double kExactCost = 6;

}  // namespace

struct SharedSums::Point {
  double saliency;
  double growth;
};

SharedSums::SharedSums(const BlockTree& tree, const Options& options, const PairKernels& kernels,
                       const core::Progress& progress)
    : tree_(tree),
      kernels_(kernels.cells),
      progress_(progress),
      pairs_(tree, {options.radius, options.sigma, options.tolerance, kUsualPanels}, progress),
      square_(largest_square(std::ldexp(options.radius, -tree.exponent()))),
      per_sigma_(1 / std::ldexp(options.sigma, -tree.exponent())),
      shared_(tree.size()),
      squares_(tree.size()),
      variances_(tree.size(), 0) {}

std::optional<SharedSums::Grid> SharedSums::grid_for(std::span<const double> values, double sigma_s) const {
  constexpr double kPerBin = 4;  // bins of the histogram in σ_s
  constexpr std::size_t kMostBins = 4096;
  const auto all = values.first(tree_.size());
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const double bin = sigma_s / kPerBin;
  if (!(bin > 0) || !((*most - *least) / bin < kMostBins) || pairs_.layers().empty()) return std::nullopt;
  std::vector<std::size_t> counts(kMostBins);
  for (const double value : all) ++counts[static_cast<std::size_t>((value - *least) / bin)];
  std::optional<Grid> best;
  double best_cost = std::numeric_limits<double>::infinity();
  const double per_point = pairs_.cost_without() / static_cast<double>(all.size());
  for (int panels = 1; panels <= kMostPanels; ++panels) {
    const double width = (kPanel * panels - 1) * kStep - 2 * kMargin;
    const auto bins = static_cast<std::size_t>(width * kPerBin);
    // The window of bins with most values in it.
    std::size_t inside = 0;
    for (std::size_t b = 0; b < std::min(bins, kMostBins); ++b) inside += counts[b];
    std::size_t most_inside = inside;
    std::size_t first = 0;
    for (std::size_t b = bins; b < kMostBins; ++b) {
      inside += counts[b] - counts[b - bins];
      if (inside <= most_inside) continue;
      most_inside = inside;
      first = b + 1 - bins;
    }
    const double outside = static_cast<double>(all.size() - most_inside);
    const double cost =
        (pairs_.cost() - pairs_.rest_cost()) * panels / kUsualPanels + outside * kExactCost * per_point;
    if (cost >= best_cost) continue;
    best_cost = cost;
    const double low = *least + static_cast<double>(first) * bin;
    best = {low - kMargin * sigma_s, panels, low, low + static_cast<double>(bins) * bin, outside};
  }
  return best;
}

std::optional<double> SharedSums::gain(std::span<const double> values, double sigma_s) const {
  const std::optional<Grid> grid = grid_for(values, sigma_s);
  if (!grid) return std::nullopt;
  const double per_point = pairs_.cost_without() / static_cast<double>(tree_.size());
  const double cost = (pairs_.cost() - pairs_.rest_cost()) * grid->panels / kUsualPanels +
                      pairs_.rest_cost() + grid->outside * kExactCost * per_point;
  return pairs_.cost_without() / cost;
}

/// A pass over the cells of all layers: points and values as the kernels take them.
class SharedSums::Pass {
 public:
  Pass(const SharedSums& sums, const Grid& grid, std::span<const double> values, double sigma_s)
      : tree_(sums.tree_),
        layers_(sums.pairs_.layers()),
        grid_(grid),
        values_(values),
        per_sigma_(sums.per_sigma_),
        per_place_(1 / (kStep * sigma_s)),
        middle_(grid.first + 0.5 * kPanel * grid.panels * kStep * sigma_s),
        width_(static_cast<std::size_t>(grid.panels) * kPanel) {}

  std::size_t width() const { return width_; }
  std::size_t size_of(std::size_t layer) const { return coefficients(layers_[layer].order) * width_; }
  CellKernelOptions options(std::size_t layer) const {
    return {&monomial_tables(), layers_[layer].order, grid_.panels,
            static_cast<float>(kStep * std::sqrt(kLog2E))};
  }
  std::array<double, 3> center(std::size_t layer, std::size_t cell) const {
    return center_of(tree_.box(layers_[layer].firsts[cell], layers_[layer].firsts[cell + 1]));
  }
  /// The cells of a layer that the blocks of a cell of the first layer are in.
  std::size_t cell_of(std::size_t layer, std::size_t first_cell) const {
    return first_cell * (layers_[layer].size() / layers_[0].size());
  }
  void points(std::size_t block, const std::array<double, 3>& from, CellPoints& result) const {
    const double* const coordinates = tree_.coordinates(block);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < kLanes; ++i)
        result.at[axis][i] = static_cast<float>((coordinates[axis * kLanes + i] - from[axis]) * per_sigma_);
  }
  void places(std::size_t block, float* result) const {
    for (std::size_t i = 0; i < kLanes; ++i)
      result[i] =
          static_cast<float>(std::clamp((values_[block * kLanes + i] - middle_) * per_place_, -1e4, 1e4));
  }

 private:
  const BlockTree& tree_;
  std::span<const CellLayer> layers_;
  const Grid& grid_;
  std::span<const double> values_;
  double per_sigma_;
  double per_place_;
  double middle_;  // of the grid's places: most values are near it, where floats are fine
  std::size_t width_;
};

SharedSums::Moments SharedSums::gather_moments(const Pass& pass) const {
  const std::span<const CellLayer> layers = pairs_.layers();
  const std::size_t count = layers.size();
  Moments moments(count);
  for (std::size_t l = 0; l < count; ++l) moments[l].resize(layers[l].size() * pass.size_of(l));
  core::parallel_for(0, layers[0].size(), 4, [&](std::size_t first, std::size_t last) {
    progress_.throw_if_cancelled();
    AlignedVector<float> weights(kLanes * pass.width());
    alignas(64) float places[kLanes];
    CellPoints points;
    std::vector<std::size_t> cells(count);
    std::vector<float*> to(count);
    for (std::size_t l = 0; l < count; ++l) cells[l] = pass.cell_of(l, first) - 1;
    for (std::size_t block = layers[0].firsts[first]; block < layers[0].firsts[last]; ++block) {
      pass.places(block, places);
      kernels_.weigh(pass.options(0), places, weights.data());
      for (std::size_t l = 0; l < count; ++l) {
        if (layers[l].firsts[cells[l] + 1] == block) {
          ++cells[l];
          to[l] = &moments[l][cells[l] * pass.size_of(l)];
          std::fill(to[l], to[l] + pass.size_of(l), 0.0F);
        }
        if (layers[l].partners_of(cells[l]).empty()) continue;
        pass.points(block, pass.center(l, cells[l]), points);
        kernels_.gather(pass.options(l), points, weights.data(), to[l]);
      }
    }
  });
  return moments;
}

void SharedSums::add(const Grid& grid, std::span<const double> values, double sigma_s,
                     std::span<double> numerators, std::span<double> denominators) {
  // A cell of the first layer contains whole cells of all others, which are treated together with it.
  const Pass pass(*this, grid, values, sigma_s);
  const Moments moments = gather_moments(pass);
  const std::span<const CellLayer> layers = pairs_.layers();
  const std::size_t count = layers.size();
  const double factor = kStep * std::sqrt(2 / 3.14159265358979323846);
  core::parallel_for(0, layers[0].size(), 4, [&](std::size_t first, std::size_t last) {
    progress_.throw_if_cancelled();
    AlignedVector<float> weights(kLanes * pass.width());
    AlignedVector<float> sums(kLanes * pass.width());
    std::vector<AlignedVector<float>> local(count);
    for (std::size_t l = 0; l < count; ++l) local[l].resize(pass.size_of(l));
    alignas(64) float places[kLanes];
    alignas(64) float results[3][kLanes];
    CellPoints points;
    std::vector<const float*> from;
    std::vector<CellOffset> offsets;
    std::vector<std::size_t> cells(count);
    for (std::size_t l = 0; l < count; ++l) cells[l] = pass.cell_of(l, first) - 1;
    for (std::size_t block = layers[0].firsts[first]; block < layers[0].firsts[last]; ++block) {
      std::fill(sums.begin(), sums.end(), 0.0F);
      bool any = false;
      for (std::size_t l = 0; l < count; ++l) {
        const bool next = layers[l].firsts[cells[l] + 1] == block;
        cells[l] += next;
        const auto partners = layers[l].partners_of(cells[l]);
        if (partners.empty()) continue;
        any = true;
        const std::array<double, 3> here = pass.center(l, cells[l]);
        if (next) {
          from.clear();
          offsets.clear();
          for (const std::uint32_t partner : partners) {
            from.push_back(&moments[l][partner * pass.size_of(l)]);
            const std::array<double, 3> there = pass.center(l, partner);
            offsets.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis)
              offsets.back().at[axis] = static_cast<float>((here[axis] - there[axis]) * per_sigma_);
          }
          std::fill(local[l].begin(), local[l].end(), 0.0F);
          kernels_.translate(pass.options(l), from.data(), offsets.data(), from.size(), local[l].data());
        }
        pass.points(block, here, points);
        kernels_.spread(pass.options(l), points, local[l].data(), sums.data());
      }
      if (!any) continue;
      pass.places(block, places);
      kernels_.weigh(pass.options(0), places, weights.data());
      kernels_.finish(pass.options(0), places, weights.data(), sums.data(), results);
      for (std::size_t i = 0; i < kLanes && block * kLanes + i < tree_.size(); ++i) {
        const std::size_t v = block * kLanes + i;
        const double weight = factor * static_cast<double>(results[0][i]);
        numerators[v] += 2 * factor * sigma_s * static_cast<double>(results[1][i]);
        denominators[v] += weight;
        shared_[v] = weight;
        squares_[v] = 4 * factor * static_cast<double>(results[2][i]) - weight;
      }
    }
  });
}

SharedSums::Point SharedSums::exact(std::size_t point, std::span<const double> values, double sigma_s) const {
  const std::size_t own_block = point / kLanes;
  const std::size_t lane = point % kLanes;
  std::array<double, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = tree_.coordinates(own_block)[axis * kLanes + lane];
  const BlockBox box{at, at};
  const std::size_t full_blocks = tree_.size() / kLanes;
  const double outside = square_ * (1 + 1e-12);
  std::vector<std::uint32_t> blocks;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges = {
      {0, static_cast<std::uint32_t>(tree_.block_count())}};
  double sums[3] = {0, 0, 0};
  const double value = values[point];
  const double per_two = std::sqrt(kLog2E / 2);
  while (!ranges.empty()) {
    const auto [first, last] = ranges.back();
    ranges.pop_back();
    const SquareSpan span = squares_between(box, tree_.box(first, last));
    if (span.least > outside) continue;
    if (span.most <= square_ && last <= full_blocks) {
      for (std::uint32_t block = first; block < last; ++block) blocks.push_back(block);
    } else if (last - first > 1) {
      const std::uint32_t middle = (first + last) / 2;
      ranges.emplace_back(middle, last);
      ranges.emplace_back(first, middle);
    } else if (first < full_blocks) {
      blocks.push_back(first);
    } else {
      const double* const coordinates = tree_.coordinates(first);
      for (std::size_t i = 0; i < tree_.points_in(first); ++i) {
        std::array<double, 3> d{};
        for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = coordinates[axis * kLanes + i] - at[axis];
        const double s = d[0] * d[0] + (d[1] * d[1] + d[2] * d[2]);
        if (s > square_) continue;
        const double f = values[first * kLanes + i] - value;
        const double t = f / sigma_s;
        const double w = std::exp(-(s * per_sigma_ * per_sigma_ + t * t) / 2);
        sums[0] += w;
        sums[1] += w * f;
        sums[2] += w * f * f;
      }
    }
  }
  kernels_.point({tree_.coordinates(0), values.data(), blocks.data(), blocks.size(), at.data(), value,
                  square_, per_two * per_sigma_, per_two / sigma_s},
                 sums);
  const double saliency = sums[1] / sums[0];
  return {saliency, (sums[2] / sums[0] - saliency * saliency) / (sigma_s * sigma_s)};
}

bool SharedSums::complete(std::span<const double> values, double sigma_s, std::span<double> numerators,
                          std::span<double> denominators) {
  const std::optional<Grid> grid = grid_for(values, sigma_s);
  if (!grid) return false;
  const std::size_t n = tree_.size();
  std::fill(shared_.begin(), shared_.end(), 0.0);
  std::fill(squares_.begin(), squares_.end(), 0.0);
  add(*grid, values, sigma_s, numerators, denominators);

  // The share of a value's error that is left after the step: the variance of the weighted values over σ_s².
  // The pairs that are not shared are assumed to have the same.
  std::vector<double> growth(n);
  std::vector<std::uint8_t> done(n);
  core::parallel_for_each(n, [&](std::size_t v) {
    const double mean = numerators[v] / denominators[v] / sigma_s;
    const double square = shared_[v] > 0 ? squares_[v] / shared_[v] * (1 - 1 / denominators[v]) : 1;
    growth[v] = std::max(0.0, square - mean * mean);
    done[v] = values[v] < grid->low || values[v] > grid->high || growth[v] > kUnstable ||
              denominators[v] < kFewNeighbors;
  });
  core::parallel_for(0, n, 256, [&](std::size_t first, std::size_t last) {
    progress_.throw_if_cancelled();
    for (std::size_t v = first; v < last; ++v) {
      if (done[v] == 0) continue;
      const Point point = exact(v, values, sigma_s);
      denominators[v] = 1;
      numerators[v] = point.saliency;
      growth[v] = point.growth;
    }
  });
  account(values, sigma_s, numerators, denominators, growth, done);
  return true;
}

void SharedSums::account(std::span<const double> values, double sigma_s, std::span<const double> numerators,
                         std::span<const double> denominators, std::span<const double> growth,
                         std::span<const std::uint8_t> done) {
  const std::size_t n = tree_.size();
  const std::size_t stride = std::max<std::size_t>(1, n / kSamples);
  struct Errors {
    double count, sum, squares;
  };
  const Errors errors = core::parallel_reduce(
      0, n / stride, 8, Errors{0, 0, 0},
      [&](std::size_t first, std::size_t last) {
        Errors part{0, 0, 0};
        for (std::size_t k = first; k < last; ++k) {
          const std::size_t v = k * stride + k % stride;
          if (done[v] != 0) continue;
          const double error = numerators[v] / denominators[v] - exact(v, values, sigma_s).saliency;
          part = {part.count + 1, part.sum + error, part.squares + error * error};
        }
        return part;
      },
      [](const Errors& a, const Errors& b) {
        return Errors{a.count + b.count, a.sum + b.sum, a.squares + b.squares};
      });
  const double count = std::max(1.0, errors.count);
  const double square = errors.squares / count;
  core::parallel_for_each(n, [&](std::size_t v) {
    const double own = growth[v];
    const double others = (1 - own) * drift_;
    variances_[v] = own * own * variances_[v] + others * others + (done[v] != 0 ? 0 : square);
  });
  drift_ += std::max(std::abs(errors.sum) / count, std::sqrt(square) / kNeighborhood);
}

double SharedSums::error() const {
  return variances_.empty() ? 0
                            : kSafety * std::sqrt(*std::max_element(variances_.begin(), variances_.end()));
}

}  // namespace morsel::morse
