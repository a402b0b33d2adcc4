#include "morsel/core/field/scalar_field.h"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/field/vertex_order.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

/// Non-finite values: how many, and the first vertex with one.
struct BadValues {
  std::size_t count = 0;
  std::size_t first = 0;
};

void check_values(const TriangleMesh& mesh, const std::vector<double>& values) {
  if (values.size() != mesh.vertex_count())
    throw InvalidArgument("a field on this mesh needs " + std::to_string(mesh.vertex_count()) +
                          " values, not " + std::to_string(values.size()));
  const BadValues bad = parallel_reduce(
      0, values.size(), 8 * kGrain, BadValues{},
      [&](std::size_t first, std::size_t last) {
        BadValues found;
        for (std::size_t v = first; v < last; ++v)
          if (!std::isfinite(values[v]) && found.count++ == 0) found.first = v;
        return found;
      },
      [](const BadValues& a, const BadValues& b) {
        return BadValues{a.count + b.count, a.count > 0 ? a.first : b.first};
      });
  if (bad.count > 0)
    throw BadInput("the field has " + std::to_string(bad.count) + " non-finite value" +
                   (bad.count == 1 ? "" : "s") + ", the first (" + shortest(values[bad.first]) +
                   ") at vertex " + std::to_string(bad.first));
}

/// Whether all of 0 … n − 1 satisfy a predicate.
template <class Predicate>
bool all_of(std::size_t n, const Predicate& predicate) {
  return parallel_reduce(
      0, n, kGrain, true,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          if (!predicate(i)) return false;
        return true;
      },
      [](bool a, bool b) { return a && b; });
}

/// For ranks that are known not to be a permutation: the error that names the first vertex that breaks it.
[[noreturn]] void refuse_ranks(std::span<const Index> rank) {
  std::vector<bool> taken(rank.size(), false);
  std::size_t v = 0;
  while (rank[v] < rank.size() && !taken[rank[v]]) taken[rank[v++]] = true;
  throw InvalidArgument("the ranks are not a permutation: rank " + std::to_string(rank[v]) + " of vertex " +
                        std::to_string(v) + " is out of range or taken");
}

}  // namespace

ScalarField::ScalarField(TriangleMesh mesh, std::vector<double> values)
    : mesh_(std::move(mesh)), values_(std::move(values)) {
  check_values(mesh_, values_);
  order_ = vertex_order(values_);
  rank_ = inverse(order_);
}

ScalarField::ScalarField(TriangleMesh mesh, std::vector<double> values, FlatArray<Index> rank)
    : mesh_(std::move(mesh)), values_(std::move(values)), rank_(std::move(rank)) {
  check_values(mesh_, values_);
  const std::size_t n = values_.size();
  if (rank_.size() != n)
    throw InvalidArgument("an order of " + std::to_string(n) + " vertices cannot have " +
                          std::to_string(rank_.size()) + " ranks");
  if (!all_of(n, [&](std::size_t v) { return rank_[v] < n; })) refuse_ranks(rank_);
  order_.resize(n);
  parallel_for_each(n, [&](std::size_t v) {  // two vertices may claim one rank
    std::atomic_ref(order_[rank_[v]]).store(static_cast<Index>(v), std::memory_order_relaxed);
  });
  if (!all_of(n, [&](std::size_t v) { return order_[rank_[v]] == v; })) refuse_ranks(rank_);
  if (all_of(n, [&](std::size_t i) { return i == 0 || values_[order_[i - 1]] <= values_[order_[i]]; }))
    return;
  std::size_t i = 1;
  while (values_[order_[i - 1]] <= values_[order_[i]]) ++i;
  throw InvalidArgument("the ranks contradict the values: vertex " + std::to_string(order_[i]) +
                        " is ranked above vertex " + std::to_string(order_[i - 1]) +
                        " but has a lower value");
}

ScalarField ScalarField::negated() const {
  std::vector<double> values(values_.size());
  FlatArray<Index> rank(rank_.size());
  const auto last = static_cast<Index>(rank_.size() - 1);
  parallel_for_each(values.size(), [&](std::size_t v) {
    values[v] = -values_[v];
    rank[v] = last - rank_[v];
  });
  return {mesh_, std::move(values), std::move(rank)};
}

}  // namespace morsel::core
