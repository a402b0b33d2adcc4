#include "morsel/core/field/classification.h"

#include <algorithm>
#include <vector>

namespace morsel::core {

std::size_t critical_count(const ScalarField& field) {
  const std::vector<LinkChanges> changes = link_changes(field.mesh(), field.ranks());
  return static_cast<std::size_t>(
      std::count_if(changes.begin(), changes.end(), [](LinkChanges c) { return !c.is_regular(); }));
}

}  // namespace morsel::core
