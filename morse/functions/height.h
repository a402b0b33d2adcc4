#pragma once
/// Height along a direction.

#include <memory>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"

namespace morsel::morse {

struct HeightOptions {
  /// Any finite vector but zero; only where it points matters.
  core::Point direction = {0, 0, 1};
};

/// p · u at each position p, u being the unit vector of the direction: in the mesh's unit, and exactly the
/// coordinate where the direction is an axis. Throws InvalidArgument if the direction is zero or not finite.
/// O(n), parallel.
core::ScalarField height(const core::TriangleMesh& mesh, const HeightOptions& options = {});

/// Keys: axis=x|y|z (default z), or direction=a/b/c instead.
std::unique_ptr<core::MorseFunction> make_height(core::ParameterReader& reader);

}  // namespace morsel::morse
