#pragma once
/// The part FORMATS of the library: what reads files with libraries that not every build has. Internal.

#include <string_view>

namespace morsel::core {

/// Throws InvalidArgument, saying how to have them, if this library was built without these kinds of files
/// (MORSEL_WITH_FORMATS=OFF); `what` needs them ("a VTP file").
void require_formats(std::string_view what);

}  // namespace morsel::core
