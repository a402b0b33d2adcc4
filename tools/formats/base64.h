#pragma once
/// Encodes bytes as text.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace morsel::tools {

/// Base64 (RFC 4648), padded, on one line.
std::string base64(std::string_view bytes);

/// The same of bytes that come in parts.
class Base64Encoder {
 public:
  /// Appends to `text` the digits of all whole groups of three bytes; up to two bytes wait for the next call.
  void encode(std::span<const std::byte> bytes, std::string& text);
  /// Appends the last group, padded, if there is one.
  void finish(std::string& text);

 private:
  std::array<std::uint8_t, 3> group_ = {};
  std::size_t waiting_ = 0;
};

/// The bytes of the Base64 that `text` begins with, up to the first character that is no digit or padding;
/// none if the digits before it are no whole groups.
std::optional<std::string> decoded_base64(std::string_view text);

}  // namespace morsel::tools
