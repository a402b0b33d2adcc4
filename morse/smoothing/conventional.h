#pragma once
/// The method that changes nothing: the conventional extraction of critical points.

#include <memory>

#include "morsel/core/field/method.h"

namespace morsel::morse {

/// Returns its input, order included (Banchoff 1970; Ni, Garland, Hart 2004). Takes no keys.
std::unique_ptr<core::Method> make_conventional(core::ParameterReader& reader);

}  // namespace morsel::morse
