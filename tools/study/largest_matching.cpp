#include "morsel/tools/study/largest_matching.h"

#include <numeric>
#include <utility>

#include "morsel/core/parallel/stop.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::kNone;

class Enlargement {
 public:
  Enlargement(ColumnPools& pools, std::size_t columns, std::span<Index> column_of)
      : pools_(pools), column_of_(column_of), row_of_(columns, kNone) {
    for (Index row = 0; row < column_of.size(); ++row)
      if (column_of[row] != kNone) row_of_[column_of[row]] = row;
  }

  void run() {
    while (find_layers()) {
      pools_.fill(layers_);
      for (const Index row : free_rows_) {
        core::throw_if_stopped();
        augment(row);
      }
    }
  }

 private:
  /// Finds the columns by the length of the shortest alternating path to each from a row without a column, up
  /// to the first length at which there are columns without a row, and there these alone. Whether there are.
  bool find_layers() {
    std::vector<Index> all(row_of_.size());
    std::iota(all.begin(), all.end(), Index{0});
    pools_.fill({std::move(all)});
    free_rows_.clear();
    for (Index row = 0; row < column_of_.size(); ++row)
      if (column_of_[row] == kNone) free_rows_.push_back(row);
    layers_.clear();
    for (std::vector<Index> rows = free_rows_; !rows.empty();) {
      std::vector<Index> reached;
      std::vector<Index> free;
      for (const Index row : rows) {
        core::throw_if_stopped();
        for (Index column = pools_.take(row, 0); column != kNone; column = pools_.take(row, 0))
          (row_of_[column] == kNone ? free : reached).push_back(column);
      }
      if (!free.empty()) {
        layers_.push_back(std::move(free));
        return true;
      }
      rows.clear();
      for (const Index column : reached) rows.push_back(row_of_[column]);
      layers_.push_back(std::move(reached));
    }
    return false;
  }

  /// Matches the row, if a path through columns that are left, a layer after the other, allows it.
  void augment(Index start) {
    path_.assign(1, {start, kNone});
    while (!path_.empty()) {
      const std::size_t layer = path_.size() - 1;
      Step& step = path_.back();
      step.column = pools_.take(step.row, layer);
      if (step.column == kNone) {
        path_.pop_back();
      } else if (layer + 1 == layers_.size()) {
        for (const auto& [row, column] : path_) {
          column_of_[row] = column;
          row_of_[column] = row;
        }
        return;
      } else {
        path_.push_back({row_of_[step.column], kNone});
      }
    }
  }

  struct Step {
    Index row, column;
  };

  ColumnPools& pools_;
  std::span<Index> column_of_;
  std::vector<Index> row_of_;
  std::vector<Index> free_rows_;            // rows without a column at the start of a round
  std::vector<std::vector<Index>> layers_;  // columns
  std::vector<Step> path_;
};

}  // namespace

void enlarge_matching(ColumnPools& pools, std::size_t columns, std::span<Index> column_of) {
  Enlargement(pools, columns, column_of).run();
}

}  // namespace morsel::tools
