#pragma once
/// Bytes that are written as text. Internal.

#include <optional>
#include <string>
#include <string_view>

namespace morsel::core {

/// The bytes of a text in base64 (RFC 4648). White space counts for nothing, padding may be missing. Empty if
/// the text has another character, digits behind its padding, or a number of digits that encodes no bytes.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace morsel::core
