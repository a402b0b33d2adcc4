#pragma once
/// Matchings of as many pairs as possible. Internal.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::tools {

/// What columns each row can be matched with, as sets (pools) of columns that are taken one by one.
class ColumnPools {
 public:
  virtual ~ColumnPools() = default;
  /// Makes new pools, of the columns given; a column is in one pool at most.
  virtual void fill(const std::vector<std::vector<core::Index>>& pools) = 0;
  /// Takes a column that the row can be matched with out of a pool; kNone if there is none left. Of the pools
  /// of one fill() a row uses one only.
  virtual core::Index take(core::Index row, std::size_t pool) = 0;
};

/// Extends a matching, given as the column of each row (kNone: none), to one of as many pairs as possible;
/// rows and columns that are matched stay so, with other partners perhaps. By shortest augmenting paths of
/// one length at a time (Hopcroft, Karp 1973): O(√n) rounds, in each of which a column is taken twice at
/// most; so, with points and a radius, near-linear rounds (Efrat, Itai, Katz 2001). Stops as
/// core::throw_if_stopped().
void enlarge_matching(ColumnPools& pools, std::size_t columns, std::span<core::Index> column_of);

}  // namespace morsel::tools
