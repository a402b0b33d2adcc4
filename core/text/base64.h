#pragma once
/// Bytes that are written as text. Internal.

#include <optional>
#include <string>
#include <string_view>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// The bytes of a text in base64 (RFC 4648). White space counts for nothing, padding may be missing. Empty if
/// the text has another character, digits behind its padding, or a number of digits that encodes no bytes.
/// Checks for cancellation every 65,536 characters.
std::optional<std::string> decode_base64(std::string_view text, const Progress& progress = {});

}  // namespace morsel::core
