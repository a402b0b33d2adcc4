#include "morsel/morse/smoothing/keep_order.h"

#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/field/vertex_order.h"

namespace morsel::morse {

core::ScalarField keep_order(const core::ScalarField& before, std::vector<double> values) {
  const std::size_t n = before.values().size();
  if (values.size() != n)
    throw core::InvalidArgument("a field on this mesh needs " + std::to_string(n) + " values, not " +
                                std::to_string(values.size()));
  core::FlatArray<core::Index> rank = core::inverse(core::vertex_order(values, before.order()));
  return {before.mesh(), std::move(values), std::move(rank)};
}

}  // namespace morsel::morse
