#pragma once
/// Standard input as a file.

#include <string_view>

#include "morsel/core/parallel/progress.h"

namespace morsel::tools {

/// What stands for it in a file's place.
inline constexpr std::string_view kStandardInput = "-";

/// All bytes of standard input, which are read at the first call and kept. Throws BadInput if it cannot be
/// read or has more than 8 GiB, Cancelled if a stop is requested while it is waited for.
std::string_view standard_input(const core::Progress& progress);

}  // namespace morsel::tools
