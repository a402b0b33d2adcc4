#include "morsel/tools/study/point_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/parameters.h"

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

/// The assignment problem: each row (an `other` point) takes a column (a reference point) in its reach, or
/// none at a cost above all distances together. Rows come one after the other, each along the cheapest path
/// that takes columns from rows before it. The potentials keep all reduced costs ≥ 0, so that Dijkstra's
/// algorithm finds it. A row that has lost its column never gets one again, since costs of columns only
/// increase.
class Assignment {
 public:
  Assignment(const std::vector<std::vector<Reach>>& rows, std::size_t columns)
      : rows_(rows),
        alone_(static_cast<Cost>(rows.size() + 1) << kRadiusBits),
        row_price_(rows.size(), 0),
        column_price_(columns, 0),
        row_of_(columns, core::kNone),
        column_of_(rows.size(), core::kNone),
        distance_(columns, kUnreached),
        from_(columns, core::kNone) {
    for (Index row = 0; row < rows.size(); ++row) place(row);
  }

  /// The column of each row; kNone if it has none.
  const std::vector<Index>& columns() const { return column_of_; }

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
  // Of the current row:
  std::vector<Cost> distance_;
  std::vector<Index> from_;
  std::vector<Index> touched_;
  using Entry = std::pair<Cost, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<PointPair> match_in_reach(std::span<const std::vector<InReach>> reach,
                                      std::size_t reference_count, double radius) {
  std::vector<std::vector<Reach>> rows(reach.size());
  for (std::size_t j = 0; j < reach.size(); ++j)
    for (const auto& [i, distance] : reach[j]) {
      const double share = radius > 0 ? distance / radius : 0;
      rows[j].push_back({i, std::llround(std::ldexp(share, kRadiusBits))});
    }
  const Assignment assignment(rows, reference_count);
  std::vector<PointPair> pairs;
  for (std::size_t j = 0; j < reach.size(); ++j) {
    const Index i = assignment.columns()[j];
    if (i == core::kNone) continue;
    const auto pair = std::ranges::find(reach[j], i, &InReach::reference);
    pairs.push_back({i, j, pair->distance});
  }
  return pairs;
}

PointMatcher::PointMatcher(std::span<const core::Point> reference, double radius)
    : reference_(reference.begin(), reference.end()), search_(reference), radius_(radius) {
  if (!(radius >= 0))
    throw core::InvalidArgument("points cannot be matched within a radius of " + core::shortest(radius));
}

std::vector<PointPair> PointMatcher::match(std::span<const core::Point> other) const {
  std::vector<std::vector<InReach>> reach(other.size());
  std::vector<Index> near;
  for (std::size_t j = 0; j < other.size(); ++j) {
    core::throw_if_stopped();
    search_.within(other[j], radius_, near);
    for (const Index i : near) reach[j].push_back({i, (reference_[i] - other[j]).norm()});
  }
  return match_in_reach(reach, reference_.size(), radius_);
}

}  // namespace morsel::tools
