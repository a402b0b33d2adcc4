#include "morsel/core/scalar_field.h"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/core/parallel_sort.h"

namespace morsel::core {
namespace {

void check_values(const TriangleMesh& mesh, const std::vector<double>& values) {
  if (values.size() != mesh.vertex_count())
    throw InvalidArgument("a field on this mesh needs " + std::to_string(mesh.vertex_count()) +
                          " values, not " + std::to_string(values.size()));
  std::size_t bad = 0;
  std::size_t first = 0;
  for (std::size_t v = values.size(); v-- > 0;)
    if (!std::isfinite(values[v])) {
      ++bad;
      first = v;
    }
  if (bad > 0)
    throw BadInput("the field has " + std::to_string(bad) + " non-finite value" + (bad == 1 ? "" : "s") +
                   ", the first (" + std::to_string(values[first]) + ") at vertex " + std::to_string(first));
}

std::vector<Index> inverse(const std::vector<Index>& permutation) {
  std::vector<Index> result(permutation.size());
  parallel_for_each(permutation.size(),
                    [&](std::size_t i) { result[permutation[i]] = static_cast<Index>(i); });
  return result;
}

}  // namespace

ScalarField::ScalarField(TriangleMesh mesh, std::vector<double> values)
    : mesh_(std::move(mesh)), values_(std::move(values)) {
  check_values(mesh_, values_);
  struct Entry {
    double value;
    Index vertex;
  };
  std::vector<Entry> entries(values_.size());
  parallel_for_each(entries.size(), [&](std::size_t v) { entries[v] = {values_[v], static_cast<Index>(v)}; });
  parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.value < b.value || (a.value == b.value && a.vertex < b.vertex);
  });
  order_.resize(entries.size());
  parallel_for_each(entries.size(), [&](std::size_t i) { order_[i] = entries[i].vertex; });
  rank_ = inverse(order_);
}

ScalarField::ScalarField(TriangleMesh mesh, std::vector<double> values, std::vector<Index> rank)
    : mesh_(std::move(mesh)), values_(std::move(values)), rank_(std::move(rank)) {
  check_values(mesh_, values_);
  if (rank_.size() != values_.size())
    throw InvalidArgument("an order of " + std::to_string(values_.size()) + " vertices cannot have " +
                          std::to_string(rank_.size()) + " ranks");
  order_.assign(rank_.size(), kNone);
  for (std::size_t v = 0; v < rank_.size(); ++v) {
    if (rank_[v] >= rank_.size() || order_[rank_[v]] != kNone)
      throw InvalidArgument("the ranks are not a permutation: rank " + std::to_string(rank_[v]) +
                            " of vertex " + std::to_string(v) + " is out of range or taken");
    order_[rank_[v]] = static_cast<Index>(v);
  }
  for (std::size_t i = 1; i < order_.size(); ++i)
    if (values_[order_[i]] < values_[order_[i - 1]])
      throw InvalidArgument("the ranks contradict the values: vertex " + std::to_string(order_[i]) +
                            " is ranked above vertex " + std::to_string(order_[i - 1]) +
                            " but has a lower value");
}

ScalarField ScalarField::negated() const {
  std::vector<double> values(values_.size());
  std::vector<Index> rank(rank_.size());
  const auto last = static_cast<Index>(rank_.size() - 1);
  for (std::size_t v = 0; v < values_.size(); ++v) {
    values[v] = -values_[v];
    rank[v] = last - rank_[v];
  }
  return {mesh_, std::move(values), std::move(rank)};
}

}  // namespace morsel::core
