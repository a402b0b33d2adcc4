#include "morsel/morse/smoothing/fair.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/field/vertex_order.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/operators/cholesky.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/pairing.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::kNone;
using core::ScalarField;
using core::TriangleMesh;

/// Joins a cap to the vertices of its loop; of the size of an equilateral triangle's cotangents.
constexpr double kCapWeight = 1;

/// Values of minima and maxima while all others, in [0, 1], have persistences of at most 1.
constexpr double kFarBelow = -2;
constexpr double kFarAbove = 3;

enum class Role : std::uint8_t { free, minimum, maximum };

class Fair {
 public:
  Fair(const ScalarField& input, std::span<const Index> extrema, const FairOptions& options,
       const Cancel& cancel, const core::Progress& progress)
      : input_(input), mesh_(input.mesh()), options_(options), cancel_(cancel), progress_(progress) {
    if (options.weights == EdgeWeights::cotangent)
      throw core::InvalidArgument(
          "fair needs weights that are not negative: clamped or uniform, not cotangent");
    role_.assign(mesh_.vertex_count(), Role::free);
    for (const Index v : extrema) add(v);
    check_components();
  }

  FairResult run() {
    std::vector<double> share = solve();
    return options_.values == FairValues::ends || input_.extent() == 0 ? at_ends(std::move(share))
                                                                       : at_input(share);
  }

 private:
  void add(Index v) {
    const CriticalType type =
        v < mesh_.vertex_count() ? classify_vertex(input_, v).type : CriticalType::regular;
    if (type != CriticalType::minimum && type != CriticalType::maximum)
      throw core::InvalidArgument("vertex " + std::to_string(v) + " is no extremum of the field");
    if (role_[v] != Role::free) return;
    role_[v] = type == CriticalType::minimum ? Role::minimum : Role::maximum;
    ++(type == CriticalType::minimum ? minima_ : maxima_);
  }

  void check_components() {
    const Index count = mesh_.component_count();
    std::vector<bool> has_minimum(count);
    std::vector<bool> has_maximum(count);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (role_[v] == Role::minimum) has_minimum[mesh_.component_of_vertex(v)] = true;
      if (role_[v] == Role::maximum) has_maximum[mesh_.component_of_vertex(v)] = true;
    }
    Index least = 0;
    Index lacking = 0;
    for (Index c = 0; c < count; ++c) {
      const bool closed = mesh_.boundary_loop_count(c) == 0;
      least += closed ? 2 : 1;
      if (!has_minimum[c] || (closed && !has_maximum[c])) ++lacking;
    }
    if (lacking > 0)
      throw core::BadInput("fair: " + std::to_string(minima_ + maxima_) +
                           " extrema are too few for this mesh, which needs at least " +
                           std::to_string(least) + ": a minimum for each of its " + std::to_string(count) +
                           " components, and a maximum for each closed one");
    for (Index loop = 0; loop < mesh_.boundary_loop_count(); ++loop)
      held_.push_back(!has_maximum[mesh_.component_of_loop(loop)]);
  }

  /// A value of the input as a share of its extent.
  double share_of(Index v) const {
    if (options_.values == FairValues::ends || input_.extent() == 0) return role_[v] == Role::maximum ? 1 : 0;
    const double low = input_.min() / 2;
    return (input_.value(v) / 2 - low) / (input_.max() / 2 - low);
  }

  /// The values of all vertices as shares of the extent.
  std::vector<double> solve() const {
    const std::vector<double> weight = edge_weights(mesh_, options_.weights);
    std::vector<Index> unknown(mesh_.vertex_count(), kNone);
    std::vector<double> share(mesh_.vertex_count(), 0.0);
    Index count = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (role_[v] == Role::free) {
        unknown[v] = count++;
        continue;
      }
      share[v] = share_of(v);
    }
    if (count == 0) return share;

    std::vector<Eigen::Triplet<double, int>> entries;
    std::vector<double> right(count, 0.0);
    const auto join = [&](Index v, Index other, double w) {
      if (unknown[v] == kNone) return;
      const auto row = static_cast<int>(unknown[v]);
      entries.emplace_back(row, row, w);
      if (unknown[other] == kNone)
        right[unknown[v]] += w * share[other];
      else
        entries.emplace_back(row, static_cast<int>(unknown[other]), -w);
    };
    for (Index e = 0; e < mesh_.edge_count(); ++e) {
      const auto [a, b] = mesh_.edge_vertices(e);
      join(a, b, weight[e]);
      join(b, a, weight[e]);
    }
    for (Index loop = 0; loop < mesh_.boundary_loop_count(); ++loop) {
      if (!held_[loop]) continue;
      for (const Index h : mesh_.boundary_loop(loop)) {
        const Index v = unknown[mesh_.origin(h)];
        if (v == kNone) continue;
        entries.emplace_back(static_cast<int>(v), static_cast<int>(v), kCapWeight);
        right[v] += kCapWeight;
      }
    }
    SparseMatrix matrix(static_cast<int>(count), static_cast<int>(count));
    matrix.setFromTriplets(entries.begin(), entries.end());
    const std::vector<double> solution = Cholesky(matrix, "fair Morse function", progress_).solve(right);
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (unknown[v] != kNone) share[v] = std::clamp(solution[unknown[v]], 0.0, 1.0);
    return share;
  }

  /// From a share of the input's extent; monotonic in the share.
  double value_of(double share) const {
    const double low = input_.min() / 2;
    return std::clamp(2 * (low + share * (input_.max() / 2 - low)), input_.min(), input_.max());
  }

  FairResult at_ends(std::vector<double> share) const {
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (role_[v] != Role::free) share[v] = role_[v] == Role::minimum ? kFarBelow : kFarAbove;
    ScalarField apart(mesh_, std::move(share));
    const std::size_t rounding = count(apart).others;
    if (rounding > 0) apart = cancel_(apart, 1);
    require_only_chosen(apart);
    std::vector<double> values(mesh_.vertex_count());
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      values[v] = role_[v] == Role::free      ? value_of(apart.value(v))
                  : role_[v] == Role::minimum ? input_.min()
                                              : input_.max();
    core::FlatArray<Index> rank(apart.ranks().begin(), apart.ranks().end());
    return result({mesh_, std::move(values), std::move(rank)}, rounding);
  }

  FairResult at_input(const std::vector<double>& share) const {
    std::vector<double> values(mesh_.vertex_count());
    // Rounding must not move values beyond the fixed ones of their component.
    std::vector<std::pair<double, double>> bounds(mesh_.component_count(), {input_.max(), input_.min()});
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (role_[v] == Role::free) continue;
      auto& [low, high] = bounds[mesh_.component_of_vertex(v)];
      low = std::min(low, input_.value(v));
      high = std::max(high, input_.value(v));
    }
    for (Index loop = 0; loop < mesh_.boundary_loop_count(); ++loop)
      if (held_[loop]) bounds[mesh_.component_of_loop(loop)].second = input_.max();
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const auto& [low, high] = bounds[mesh_.component_of_vertex(v)];
      values[v] = role_[v] == Role::free ? std::clamp(value_of(share[v]), low, high) : input_.value(v);
    }
    ScalarField plain(mesh_, values, core::inverse(core::vertex_order(values, order_of_ties())));
    const std::size_t rounding = count(plain).others;
    ScalarField field = plain;
    for (double threshold = 0; threshold <= 1 && count(field).others > 0;
         threshold = std::max(threshold * 10, 1e-15))
      field = cancel_(plain, threshold * input_.extent());
    require_only_chosen(field);
    return result(std::move(field), rounding);
  }

  /// Chosen minima first, chosen maxima last, each in the input's order.
  std::vector<Index> order_of_ties() const {
    std::vector<Index> order(input_.order().begin(), input_.order().end());
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return place(a) < place(b); });
    return order;
  }
  int place(Index v) const { return role_[v] == Role::minimum ? 0 : role_[v] == Role::maximum ? 2 : 1; }

  /// The extrema of a field: chosen ones of their type, chosen ones of the other type, and others.
  struct Count {
    std::size_t left = 0;
    std::size_t turned = 0;
    std::size_t others = 0;
  };
  Count count(const ScalarField& field) const {
    Count result;
    for (const CriticalPoint& point : classify(field, progress_).points) {
      if (point.type == CriticalType::saddle) continue;
      const bool is_minimum = point.type == CriticalType::minimum;
      if (role_[point.vertex] == Role::free)
        ++result.others;
      else
        ++(role_[point.vertex] == (is_minimum ? Role::minimum : Role::maximum) ? result.left : result.turned);
    }
    return result;
  }

  void require_only_chosen(const ScalarField& field) const {
    if (count(field).others > 0)
      throw std::logic_error("fair: cancellation left extrema that were not chosen");
  }

  FairResult result(ScalarField field, std::size_t rounding) const {
    const Count extrema = count(field);
    const auto held = static_cast<Index>(std::count(held_.begin(), held_.end(), true));
    return {std::move(field), minima_, maxima_, extrema.left, extrema.turned, rounding, held};
  }

  const ScalarField& input_;
  const TriangleMesh& mesh_;
  const FairOptions& options_;
  const Cancel& cancel_;
  const core::Progress& progress_;
  std::vector<Role> role_;
  std::vector<bool> held_;  // per boundary loop
  std::size_t minima_ = 0;
  std::size_t maxima_ = 0;
};

class FairMethod final : public core::Method {
 public:
  FairMethod(std::int64_t extrema, const FairOptions& options) : extrema_(extrema), options_(options) {}

  core::MethodResult apply(const ScalarField& input, const core::MethodContext& context) const override {
    const core::Progress& progress = context.progress;
    const std::vector<Index> chosen = persistence::persistent_extrema(
        persistence::pair_extrema(input, progress), static_cast<std::size_t>(extrema_));
    const auto cancel = [&](const ScalarField& field, double threshold) {
      return persistence::cancel(field, {persistence::Threshold::absolute(threshold), {}}, progress).field;
    };
    FairResult result = fair(input, chosen, options_, cancel, progress);
    core::Parameters details = {{"minima", static_cast<std::int64_t>(result.minima)},
                                {"maxima", static_cast<std::int64_t>(result.maxima)},
                                {"extrema_left", static_cast<std::int64_t>(result.left)},
                                {"extrema_turned", static_cast<std::int64_t>(result.turned)},
                                {"rounding_extrema", static_cast<std::int64_t>(result.rounding)},
                                {"held_loops", static_cast<std::int64_t>(result.held_loops)}};
    if (chosen.size() < static_cast<std::size_t>(extrema_))
      details.emplace_back("note", "the field has " + std::to_string(chosen.size()) + " extrema only");
    return {std::move(result.field),
            {{"extrema", extrema_},
             {"values", options_.values == FairValues::ends ? "ends" : "input"},
             {"weights", std::string(to_string(options_.weights))}},
            std::move(details)};
  }

 private:
  std::int64_t extrema_;
  FairOptions options_;
};

}  // namespace

FairResult fair(const ScalarField& input, std::span<const Index> extrema, const FairOptions& options,
                const Cancel& cancel, const core::Progress& progress) {
  return Fair(input, extrema, options, cancel, progress).run();
}

std::unique_ptr<core::Method> make_fair(core::ParameterReader& reader) {
  const std::int64_t extrema =
      reader.count("extrema", 8, 1, std::numeric_limits<std::int32_t>::max(),
                   "how many are kept: the most persistent, minima and maxima together");
  FairOptions options;
  if (reader.choice("values", "ends", {"ends", "input"},
                    "of the extrema that are kept: the field's least and greatest, or their own") == "input")
    options.values = FairValues::input;
  if (reader.choice("weights", "clamped", {"clamped", "uniform"},
                    "of edges: cotangents, but positive, or all 1") == "uniform")
    options.weights = EdgeWeights::uniform;
  return std::make_unique<FairMethod>(extrema, options);
}

}  // namespace morsel::morse
