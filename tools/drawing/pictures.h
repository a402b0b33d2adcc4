#pragma once
/// Whether this morsel has pictures and plots: MORSEL_WITH_PICTURES.

#include <string_view>

namespace morsel::tools::drawing {

/// Whether it was built with them. Without, everything that draws throws what require_pictures() throws.
bool has_pictures();

/// Throws InvalidArgument, saying how to have them, if there are none; `what` needs them ("--figures").
void require_pictures(std::string_view what);

}  // namespace morsel::tools::drawing
