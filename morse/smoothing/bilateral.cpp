#include "morsel/morse/smoothing/bilateral.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/smoothing/aligned.h"
#include "morsel/morse/smoothing/ball_pairs.h"
#include "morsel/morse/smoothing/bilateral_engine.h"
#include "morsel/morse/smoothing/block_tree.h"
#include "morsel/morse/smoothing/listed_sums.h"
#include "morsel/morse/smoothing/pair_kernels.h"
#include "morsel/morse/smoothing/shared_sums.h"

namespace morsel::morse {
namespace {

/// √(log2(e) / 2): in units of σ over this, a Gaussian is 2 to the negative square.
constexpr double kUnit = 0.84932180028801904272;
/// A chunk in float32 extends at most this many σ from its middle, so its coordinates are right to 1e-6 σ.
constexpr double kWide = 16;

/// Larger distances, in units of σ or σ_s, have no weight; squares up to this are finite.
template <class Real>
constexpr double kFar = std::is_same_v<Real, float> ? 1e15 : 1e150;
/// Values in float32 kernels are integers, up to ± kMost, so that differences have at most kBits bits and a
/// sign.
constexpr int kBits = 31;
constexpr double kMost = (1 << (kBits - 1)) - 1;

enum class Pass : std::uint8_t { spread, fixed, local };

std::size_t sums_of(Pass pass) { return pass == Pass::spread ? 1 : 2; }

/// Points in a chunk: enough to reuse the cache, few enough for the chunks to balance the load.
std::size_t chunk_size(std::size_t points) { return std::clamp<std::size_t>(points / 64, 256, 4096); }

}  // namespace

template <class Mask, class Real>
class BilateralFilter::EngineOf final : public BilateralEngine {
  static constexpr std::size_t kLanes = 8 * sizeof(Mask);

 public:
  EngineOf(std::span<const core::Point> points, const Options& options, const core::Progress& progress)
      : progress_(progress),
        kernels_(pair_kernels(options.instructions)),
        tree_(points, kLanes, progress),
        shared_(options.tolerance > 0
                    ? std::make_unique<SharedSums>(
                          tree_, SharedSums::Options{options.radius, options.sigma, options.tolerance},
                          kernels_, progress)
                    : nullptr),
        search_(tree_, options.radius, kernels_, shared_ ? &shared_->pairs() : nullptr),
        memory_left_(options.memory),
        per_sigma_(std::min(kUnit / std::ldexp(options.sigma, -tree_.exponent()), 1e300)),
        values_(tree_.block_count() * kLanes) {
    if (!options.weights.empty()) {
      weights_.resize(values_.size());
      sort(options.weights, weights_);
    }
    if (tree_.block_count() > 0) divide(0, tree_.block_count(), chunk_size(points.size()) / kLanes);
  }

  void apply(std::span<const double> values, std::optional<double> sigma_s, std::span<double> result,
             const Report& report) override {
    const std::span<const core::Index> order = tree_.order();
    sort(values, values_);
    numerators_.assign(order.size(), 0);
    choose_step(sigma_s);
    if (!sigma_s) {
      run(Pass::spread, 1, [&](double done) { report(done / 4); });
      units_.resize(order.size());
      core::parallel_for_each(order.size(), [&](std::size_t i) {
        units_[i] = numerators_[i] > 0 ? kUnit / numerators_[i] : 0;
        numerators_[i] = 0;
      });
    }
    denominators_.assign(order.size(), 1);  // the point itself
    if (!weights_.empty()) std::copy_n(weights_.begin(), order.size(), denominators_.begin());
    if (!sigma_s || *sigma_s > 0)
      run(sigma_s ? Pass::fixed : Pass::local, sigma_s ? kUnit / *sigma_s : 1,
          [&](double done) { report(sigma_s ? done : 0.25 + 0.75 * done); });
    else if (!counted_)
      run(Pass::spread, 1, report);
    if (shared_ && !(sigma_s && shared_->complete(values_, *sigma_s, numerators_, denominators_)))
      failed_ = true;
    core::parallel_for_each(order.size(), [&](std::size_t i) {
      const bool none = (sigma_s ? *sigma_s == 0 : units_[i] == 0) || denominators_[i] == 0;
      result[order[i]] = none ? 0 : numerators_[i] / denominators_[i];
    });
  }

  std::uint64_t pairs() const override {
    std::uint64_t sum = tree_.size();
    for (const Chunk& chunk : chunks_) sum += chunk.pair_count;
    return shared_ ? sum + shared_->pairs().point_pairs() : sum;
  }

  std::optional<double> gain(std::span<const double> values, double sigma_s) const override {
    if (!shared_) return std::nullopt;
    AlignedVector<double> sorted(values_.size());
    sort(values, sorted);
    return shared_->gain(sorted, sigma_s);
  }

  double error() const override {
    if (failed_) return std::numeric_limits<double>::infinity();
    return shared_ ? shared_->error() : 0;
  }

 private:
  struct Chunk {
    std::size_t first, last;  // blocks
    bool wide;
    bool stored = false;
    BallPairs<Mask> pairs;
    std::uint64_t pair_count = 0;
  };
  /// What a chunk adds to the blocks that it reaches.
  struct Sums {
    std::vector<std::uint32_t> reached;  // where the chunk's pairs are not stored
    AlignedVector<double> values;
    double step = 1;  // their unit
  };

  /// Brings values in the tree's order, with room for all lanes of the last block.
  void sort(std::span<const double> values, AlignedVector<double>& sorted) const {
    const std::span<const core::Index> order = tree_.order();
    core::parallel_for_each(sorted.size(),
                            [&](std::size_t i) { sorted[i] = values[order[std::min(i, order.size() - 1)]]; });
  }

  /// Steps of values for the float32 kernels, relative to the middle of the values. Where σ_s is fixed, its
  /// unit is a power of two in steps, which a float holds exactly.
  void choose_step(std::optional<double> sigma_s) {
    if (!std::is_same_v<Real, float> || values_.empty()) return;
    const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
    middle_ = (*least + *most) / 2;
    const double extent = *most - *least;
    const double unit =
        sigma_s && *sigma_s > extent * 1e-20 && *sigma_s < extent * 1e20 ? *sigma_s / kUnit : 1;
    int exponent = 0;
    std::frexp(extent / unit, &exponent);
    step_ = std::ldexp(unit, std::max(exponent, -900) - kBits);
  }

  /// Ranges of the tree, so that they are compact.
  void divide(std::size_t first, std::size_t last, std::size_t most) {
    bool wide = false;
    if (std::is_same_v<Real, float>) {
      const BlockBox& box = tree_.box(first, last);
      for (std::size_t axis = 0; axis < 3; ++axis)
        wide |= !((box.high[axis] - box.low[axis]) / 2 * per_sigma_ <= kWide * kUnit);
    }
    if (last - first == 1 || (last - first <= most && !wide)) {
      chunks_.push_back({first, last, wide, false, {}, 0});
      return;
    }
    const std::size_t middle = (first + last) / 2;
    divide(first, middle, most);
    divide(middle, last, most);
  }

  /// Adds up a pass's sums (or largest values) in numerators_ and denominators_.
  void run(Pass pass, double unit, const Report& report) {
    // Slab by slab, so that the sums of a few chunks exist at a time, and progress and stops are checked
    // between them.
    const std::size_t slab = std::max<std::size_t>(128, 16 * static_cast<std::size_t>(core::thread_count()));
    for (std::size_t begin = 0; begin < chunks_.size(); begin += slab) {
      report(static_cast<double>(begin) / static_cast<double>(chunks_.size()));
      const std::size_t end = std::min(chunks_.size(), begin + slab);
      std::vector<Sums> sums(end - begin);
      core::parallel_for(begin, end, 1, [&](std::size_t k, std::size_t) {
        progress_.throw_if_cancelled();
        visit(chunks_[k], pass, unit, sums[k - begin]);
      });
      add(pass, begin, sums);
    }
    counted_ = true;
  }

  void visit(Chunk& chunk, Pass pass, double unit, Sums& sums) {
    BallPairs<Mask> found;
    if (!chunk.stored) {
      found = search_.find(chunk.first, chunk.last);
      chunk.pair_count = found.pairs;
    }
    const BallPairs<Mask>& pairs = chunk.stored ? chunk.pairs : found;
    if constexpr (std::is_same_v<Real, double>) {
      if constexpr (kLanes == 8)
        visit(chunk, pairs, kernels_.double8, pass, unit, sums);
      else
        visit(chunk, pairs, kernels_.double16, pass, unit, sums);
    } else if (chunk.wide) {
      visit(chunk, pairs, kernels_.double16, pass, unit, sums);
    } else {
      visit(chunk, pairs, kernels_.float16, pass, unit, sums);
    }
    if (chunk.stored) return;
    // Takes from the remaining memory; which thread is first changes time only.
    const std::size_t bytes = found.bytes();
    std::size_t left = memory_left_;
    while (left >= bytes && !memory_left_.compare_exchange_weak(left, left - bytes)) {
    }
    if (left >= bytes) {
      chunk.pairs = found;  // a copy has no spare capacity
      chunk.stored = true;
    } else {
      sums.reached = std::move(found.reached);
    }
  }

  template <class Number>
  void visit(const Chunk& chunk, const BallPairs<Mask>& pairs, const PairFunctions<Number, Mask>& functions,
             Pass pass, double unit, Sums& sums) const {
    const std::size_t blocks = pairs.reached.size();
    const bool weighted = !weights_.empty() && pass != Pass::spread;
    const std::size_t arrays = 4 + (pass == Pass::local ? 1 : 0) + (weighted ? 1 : 0);
    AlignedVector<Number> points(blocks * arrays * kLanes);
    const BlockBox& box = tree_.box(chunk.first, chunk.last);
    constexpr bool kIntegers = std::is_same_v<Number, float>;
    const double origin_of_values = kIntegers ? middle_ : values_[chunk.first * kLanes];
    // Of values and differences as the kernels see them; the square of what is in range is finite.
    const double step = kIntegers ? step_ : 1;
    const double least = kIntegers ? 1e-30 : 1 / kFar<double>;
    const double most = kIntegers ? 1e8 : kFar<double>;
    const auto in_range = [&](double u) { return static_cast<Number>(std::clamp(u * step, least, most)); };
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t block = pairs.reached[b];
      const std::size_t count = tree_.points_in(block);
      Number* const to = &points[b * arrays * kLanes];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double origin = (box.low[axis] + box.high[axis]) / 2;
        const double* const from = tree_.coordinates(block) + axis * kLanes;
        for (std::size_t i = 0; i < kLanes; ++i)
          to[axis * kLanes + i] =
              static_cast<Number>(std::clamp((from[i] - origin) * per_sigma_, -kFar<Number>, kFar<Number>));
      }
      const double* const values = &values_[block * kLanes];
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double value = i < count ? (values[i] - origin_of_values) / step : 0;
        if constexpr (kIntegers) {
          const auto integer = static_cast<std::int32_t>(std::lrint(std::clamp(value, -kMost, kMost)));
          std::memcpy(&to[3 * kLanes + i], &integer, sizeof(integer));
        } else {
          to[3 * kLanes + i] = value;
        }
      }
      if (weighted)
        for (std::size_t i = 0; i < kLanes; ++i)
          to[(arrays - 1) * kLanes + i] = static_cast<Number>(weights_[block * kLanes + i]);
      if (pass != Pass::local) continue;
      const double* const units = &units_[block * kLanes];
      for (std::size_t i = 0; i < kLanes; ++i)
        to[4 * kLanes + i] = i < count ? in_range(units[i]) : Number{0};
    }
    std::vector<std::uint32_t> whole(blocks);
    std::vector<PairStep> steps(pairs.most_blocks * kLanes + 1);
    const std::size_t count = blocks * sums_of(pass) * kLanes;
    sums.step = step;
    sums.values.assign(count, 0);
    AlignedVector<Number> parts(kIntegers ? count : 0);
    function_of(functions, pass, weighted)(pairs.view(), points.data(), sums.values.data(), in_range(unit),
                                           {whole.data(), steps.data(), parts.data()});
  }

  template <class Number>
  PairFunction<Number, Mask> function_of(const PairFunctions<Number, Mask>& functions, Pass pass,
                                         bool weighted) const {
    if constexpr (std::is_same_v<PairFunctions<Number, Mask>, decltype(PairKernels::double8)>)
      if (weighted) return pass == Pass::local ? kernels_.weighted8.local : kernels_.weighted8.fixed;
    if (pass == Pass::spread) return functions.spread;
    return pass == Pass::local ? functions.local : functions.fixed;
  }

  /// Adds the sums of chunks in their order, block by block.
  void add(Pass pass, std::size_t first_chunk, const std::vector<Sums>& sums) {
    constexpr std::size_t kBlocks = core::kGrain / kLanes;
    core::parallel_for(0, tree_.block_count(), kBlocks, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = 0; k < sums.size(); ++k) {
        const Chunk& chunk = chunks_[first_chunk + k];
        const std::vector<std::uint32_t>& reached = chunk.stored ? chunk.pairs.reached : sums[k].reached;
        if (reached.back() < first || reached.front() >= last) continue;
        const auto from = std::lower_bound(reached.begin(), reached.end(), first);
        const auto to = std::lower_bound(from, reached.end(), last);
        const auto offset = static_cast<std::size_t>(from - reached.begin());
        const std::span<const std::uint32_t> blocks(from, to);
        if (blocks.empty()) continue;
        add(pass, blocks, &sums[k].values[offset * sums_of(pass) * kLanes], sums[k].step);
      }
    });
  }

  void add(Pass pass, std::span<const std::uint32_t> blocks, const double* sums, double step) {
    for (const std::size_t block : blocks) {
      const std::size_t begin = block * kLanes;
      const std::size_t count = tree_.points_in(block);
      if (pass == Pass::spread) {
        for (std::size_t i = 0; i < count; ++i)
          numerators_[begin + i] = std::max(numerators_[begin + i], step * sums[i]);
      } else {
        for (std::size_t i = 0; i < count; ++i) {
          numerators_[begin + i] += step * sums[i];
          denominators_[begin + i] += sums[kLanes + i];
        }
      }
      sums += sums_of(pass) * kLanes;
    }
  }

  const core::Progress& progress_;
  const PairKernels& kernels_;
  BlockTree tree_;
  std::unique_ptr<SharedSums> shared_;
  BallSearch<Mask> search_;
  std::vector<Chunk> chunks_;
  std::atomic<std::size_t> memory_left_;
  double per_sigma_;  // kUnit / σ in the tree's coordinates
  double middle_ = 0;
  double step_ = 1;
  bool counted_ = false;
  bool failed_ = false;
  // In the tree's order:
  AlignedVector<double> values_;    // with all lanes of the last block
  AlignedVector<double> weights_;   // likewise; empty: all are 1
  std::vector<double> numerators_;  // or the largest differences
  std::vector<double> denominators_;
  std::vector<double> units_;  // kUnit / σ_s(v)
};

BilateralFilter::BilateralFilter(std::span<const core::Point> points, const Options& options,
                                 const core::Progress& progress) {
  if (options.connected_by)
    engine_ = std::make_unique<ListedSums>(points, options, progress);
  else if (!options.weights.empty() || (options.precision == Precision::float64 && !(options.tolerance > 0)))
    engine_ = std::make_unique<EngineOf<std::uint8_t, double>>(points, options, progress);
  else
    engine_ = std::make_unique<EngineOf<std::uint16_t, float>>(points, options, progress);
}

BilateralFilter::~BilateralFilter() = default;

void BilateralFilter::apply(std::span<const double> values, std::optional<double> sigma_s,
                            std::span<double> result, const Report& report) {
  engine_->apply(values, sigma_s, result, report);
}

std::optional<double> BilateralFilter::gain(std::span<const double> values, double sigma_s) const {
  return engine_->gain(values, sigma_s);
}

double BilateralFilter::error() const { return engine_->error(); }

std::uint64_t BilateralFilter::pairs() const { return engine_->pairs(); }

}  // namespace morsel::morse
