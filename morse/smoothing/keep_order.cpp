#include "morsel/morse/smoothing/keep_order.h"

#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/core/parallel_sort.h"

namespace morsel::morse {

using core::Index;

core::ScalarField keep_order(const core::ScalarField& before, std::vector<double> values) {
  const std::size_t n = before.values().size();
  if (values.size() != n)
    throw core::InvalidArgument("a field on this mesh needs " + std::to_string(n) + " values, not " +
                                std::to_string(values.size()));
  struct Entry {
    double value;
    Index rank;
    Index vertex;
  };
  std::vector<Entry> entries(n);
  core::parallel_for_each(n, [&](std::size_t v) {
    // A NaN would break the sort; the field's constructor refuses it afterwards.
    const double value = std::isnan(values[v]) ? 0.0 : values[v];
    entries[v] = {value, before.ranks()[v], static_cast<Index>(v)};
  });
  core::parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.value < b.value || (a.value == b.value && a.rank < b.rank);
  });
  std::vector<Index> rank(n);
  core::parallel_for_each(n, [&](std::size_t i) { rank[entries[i].vertex] = static_cast<Index>(i); });
  return {before.mesh(), std::move(values), std::move(rank)};
}

}  // namespace morsel::morse
