#include "morsel/tools/export/finite_persistence.h"

#include <cmath>

namespace morsel::tools {

void FinitePersistence::add(double persistence, double extent) {
  const bool is_finite = std::isfinite(persistence);
  values.push_back(is_finite ? persistence : extent);
  essential.push_back(is_finite ? 0 : 1);
}

FinitePersistence finite_persistence(std::span<const double> persistence, double extent) {
  FinitePersistence result;
  result.values.reserve(persistence.size());
  result.essential.reserve(persistence.size());
  for (const double value : persistence) result.add(value, extent);
  return result;
}

}  // namespace morsel::tools
