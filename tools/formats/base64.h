#pragma once
/// Encodes bytes as text.

#include <string>
#include <string_view>

namespace morsel::tools {

/// Base64 (RFC 4648), padded, on one line.
std::string base64(std::string_view bytes);

}  // namespace morsel::tools
