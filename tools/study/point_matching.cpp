#include "morsel/tools/study/point_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/study/largest_matching.h"
#include "morsel/tools/study/point_pool.h"

namespace morsel::tools {
namespace {

using core::Index;
using Cost = std::int64_t;

constexpr int kRadiusBits = 30;  // a distance of the radius costs 2³⁰
constexpr Cost kUnreached = std::numeric_limits<Cost>::max();

/// A reference point in reach of an `other` one.
struct Reach {
  Index reference;
  Cost cost;
};

Cost cost_of(double distance, double radius) {
  return radius > 0 ? std::llround(std::ldexp(distance / radius, kRadiusBits)) : 0;
}

/// The assignment problem: each row (an `other` point) takes a column (a reference point) in its reach, or
/// none at a cost above all distances together. Rows come one after the other, each along the cheapest path
/// that takes columns from rows before it. The potentials keep all reduced costs ≥ 0, so that Dijkstra's
/// algorithm finds it. A row that has lost its column never gets one again, since costs of columns only
/// increase.
class Assignment {
 public:
  /// Rows are left without a column once more than `most_steps` pairs have been looked at.
  Assignment(const std::vector<std::vector<Reach>>& rows, std::size_t columns, std::size_t most_steps)
      : rows_(rows),
        alone_(static_cast<Cost>(rows.size() + 1) << kRadiusBits),
        row_price_(rows.size(), 0),
        column_price_(columns, 0),
        row_of_(columns, core::kNone),
        column_of_(rows.size(), core::kNone),
        distance_(columns, kUnreached),
        from_(columns, core::kNone) {
    for (Index row = 0; row < rows.size(); ++row) {
      is_whole_ = steps_ <= most_steps;
      if (!is_whole_) break;
      place(row);
    }
  }

  /// The column of each row; kNone if it has none.
  const std::vector<Index>& columns() const { return column_of_; }
  /// Whether all rows had their turn.
  bool is_whole() const { return is_whole_; }

 private:
  void place(Index start) {
    Cost best = kUnreached;
    Index last_row = core::kNone;     // the path ends there if a row is best left without a column
    Index last_column = core::kNone;  // or here
    const auto leave = [&](Index row, Cost so_far) {
      const Cost cost = so_far + alone_ - row_price_[row];
      if (cost < best) {
        best = cost;
        last_row = row;
        last_column = core::kNone;
      }
      steps_ += rows_[row].size();
      for (const Reach& reach : rows_[row]) {
        const Cost through = so_far + reach.cost - row_price_[row] - column_price_[reach.reference];
        if (through >= distance_[reach.reference] || through >= best) continue;
        if (distance_[reach.reference] == kUnreached) touched_.push_back(reach.reference);
        distance_[reach.reference] = through;
        from_[reach.reference] = row;
        queue_.emplace(through, reach.reference);
      }
    };
    leave(start, 0);
    while (!queue_.empty() && queue_.top().first < best) {
      core::throw_if_stopped();
      const auto [cost, column] = queue_.top();
      queue_.pop();
      if (cost > distance_[column]) continue;  // was reached at a lower cost
      if (row_of_[column] == core::kNone) {
        best = cost;
        last_column = column;
        break;
      }
      leave(row_of_[column], cost);
    }
    adjust_prices(start, best);
    follow_back(start, last_row, last_column);
    for (const Index column : touched_) distance_[column] = kUnreached;
    touched_.clear();
    queue_ = {};
  }

  void adjust_prices(Index start, Cost best) {
    row_price_[start] += best;
    for (const Index column : touched_) {
      if (distance_[column] >= best) continue;
      row_price_[row_of_[column]] += best - distance_[column];
      column_price_[column] -= best - distance_[column];
    }
  }

  /// Reassigns the columns along the path.
  void follow_back(Index start, Index last_row, Index last_column) {
    Index column = last_column;
    if (column == core::kNone) {
      if (last_row == start) return;
      column = std::exchange(column_of_[last_row], core::kNone);
    }
    for (;;) {
      const Index row = from_[column];
      row_of_[column] = row;
      const Index before = std::exchange(column_of_[row], column);
      if (row == start) return;
      column = before;
    }
  }

  const std::vector<std::vector<Reach>>& rows_;
  Cost alone_;
  std::vector<Cost> row_price_;
  std::vector<Cost> column_price_;
  std::vector<Index> row_of_;
  std::vector<Index> column_of_;
  std::size_t steps_ = 0;
  bool is_whole_ = true;
  // Of the current row:
  std::vector<Cost> distance_;
  std::vector<Index> from_;
  std::vector<Index> touched_;
  using Entry = std::pair<Cost, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// The reference points in reach of each other point; nothing if they are more than `most`.
std::optional<std::vector<std::vector<Reach>>> all_in_reach(std::span<const core::Point> reference,
                                                            const core::PointSearch& search, double radius,
                                                            std::span<const core::Point> other,
                                                            std::size_t most) {
  std::vector<std::vector<Reach>> rows(other.size());
  std::vector<Index> near;
  std::size_t pairs = 0;
  for (std::size_t j = 0; j < other.size(); ++j) {
    core::throw_if_stopped();
    search.within(other[j], radius, near);
    pairs += near.size();
    if (pairs > most) return {};
    rows[j].reserve(near.size());
    for (const Index i : near) rows[j].push_back({i, cost_of((reference[i] - other[j]).norm(), radius)});
  }
  return rows;
}

/// The power of two that brings the largest coordinate to about 1.
double scale_of(std::span<const core::Point> points) {
  double largest = 0;
  for (const core::Point& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
}

/// Columns as rows list them.
class ListedPools final : public ColumnPools {
 public:
  ListedPools(const std::vector<std::vector<Reach>>& rows, std::size_t columns)
      : rows_(rows), next_(rows.size()), pool_of_(columns) {}

  void fill(const std::vector<std::vector<Index>>& pools) override {
    std::ranges::fill(next_, 0);
    std::ranges::fill(pool_of_, core::kNone);
    for (std::size_t pool = 0; pool < pools.size(); ++pool)
      for (const Index column : pools[pool]) pool_of_[column] = static_cast<Index>(pool);
  }

  Index take(Index row, std::size_t pool) override {
    while (next_[row] < rows_[row].size()) {
      const Index column = rows_[row][next_[row]++].reference;
      if (pool_of_[column] != pool) continue;
      pool_of_[column] = core::kNone;
      return column;
    }
    return core::kNone;
  }

 private:
  const std::vector<std::vector<Reach>>& rows_;
  std::vector<std::size_t> next_;  // places in the rows' lists; what is before them is taken
  std::vector<Index> pool_of_;     // kNone once a column is taken
};

}  // namespace

PointMatches match_in_reach(std::span<const std::vector<InReach>> reach, std::size_t reference_count,
                            double radius, const MatchingBounds& bounds) {
  std::vector<std::vector<Reach>> rows(reach.size());
  for (std::size_t j = 0; j < reach.size(); ++j)
    for (const auto& [i, distance] : reach[j]) rows[j].push_back({i, cost_of(distance, radius)});
  const Assignment assignment(rows, reference_count, bounds.steps);
  std::vector<Index> columns = assignment.columns();
  if (!assignment.is_whole()) {
    ListedPools pools(rows, reference_count);
    enlarge_matching(pools, reference_count, columns);
  }
  PointMatches matches{{}, assignment.is_whole()};
  for (std::size_t j = 0; j < reach.size(); ++j) {
    if (columns[j] == core::kNone) continue;
    const auto pair = std::ranges::find(reach[j], columns[j], &InReach::reference);
    matches.pairs.push_back({columns[j], j, pair->distance});
  }
  return matches;
}

/// The reference points within the radius of `other` ones; of those that are left the nearest is taken.
class PointMatcher::Pools final : public ColumnPools {
 public:
  Pools(const PointMatcher& matcher, std::span<const core::Point> other) : matcher_(matcher), other_(other) {}

  void fill(const std::vector<std::vector<Index>>& pools) override {
    columns_ = pools;
    pools_.clear();
    for (const std::vector<Index>& columns : pools) {
      std::vector<core::Point> points;
      points.reserve(columns.size());
      for (const Index column : columns) points.push_back(matcher_.reference_[column] * matcher_.scale_);
      pools_.emplace_back(std::move(points));
    }
  }

  Index take(Index row, std::size_t pool) override {
    look_up(row, pool, 1);
    if (found_.empty()) return core::kNone;
    pools_[pool].remove(found_.front().point);
    return columns_[pool][found_.front().point];
  }

  /// The columns that are nearest to each row, and their costs.
  std::vector<std::vector<Reach>> nearest(std::size_t count) {
    std::vector<Index> all(matcher_.size());
    std::iota(all.begin(), all.end(), Index{0});
    fill({std::move(all)});
    std::vector<std::vector<Reach>> rows(other_.size());
    for (Index row = 0; row < other_.size(); ++row) {
      core::throw_if_stopped();
      look_up(row, 0, count);
      for (const PointPool::Found& found : found_)
        rows[row].push_back({found.point, cost_of(found.distance, matcher_.radius_ * matcher_.scale_)});
    }
    return rows;
  }

 private:
  void look_up(Index row, std::size_t pool, std::size_t count) {
    pools_[pool].nearest(other_[row] * matcher_.scale_, matcher_.radius_ * matcher_.scale_, count, found_);
  }

  const PointMatcher& matcher_;
  std::span<const core::Point> other_;
  std::vector<std::vector<Index>> columns_;  // of each pool, by the points' numbers there
  std::vector<PointPool> pools_;
  std::vector<PointPool::Found> found_;
};

PointMatcher::PointMatcher(std::span<const core::Point> reference, double radius,
                           const MatchingBounds& bounds)
    : reference_(reference.begin(), reference.end()),
      search_(reference),
      radius_(radius),
      bounds_(bounds),
      scale_(scale_of(reference)) {
  if (!(radius >= 0))
    throw core::InvalidArgument("points cannot be matched within a radius of " + core::shortest(radius));
}

PointMatches PointMatcher::match(std::span<const core::Point> other) const {
  auto all = all_in_reach(reference_, search_, radius_, other, bounds_.pairs);
  const bool is_listed = all.has_value();
  Pools pools(*this, other);
  const auto rows = is_listed ? std::move(*all) : pools.nearest(bounds_.nearest);
  const Assignment assignment(rows, reference_.size(), bounds_.steps);
  PointMatches matches{{}, is_listed && assignment.is_whole()};
  std::vector<Index> columns = assignment.columns();
  if (!matches.is_least) enlarge_matching(pools, reference_.size(), columns);
  for (std::size_t j = 0; j < other.size(); ++j)
    if (columns[j] != core::kNone)
      matches.pairs.push_back({columns[j], j, (reference_[columns[j]] - other[j]).norm()});
  return matches;
}

std::size_t PointMatcher::count(std::span<const core::Point> other) const {
  Pools pools(*this, other);
  std::vector<Index> columns(other.size(), core::kNone);
  enlarge_matching(pools, reference_.size(), columns);
  return columns.size() - static_cast<std::size_t>(std::ranges::count(columns, core::kNone));
}

}  // namespace morsel::tools
