#pragma once
/// Numbers of binary files, the byte of most weight first. Internal.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace morsel::core {

/// Reads numbers one after the other. The caller has compared their number with remaining().
class BigEndianReader {
 public:
  explicit BigEndianReader(std::string_view bytes) : bytes_(bytes) {}

  std::size_t remaining() const { return bytes_.size() - at_; }
  std::uint32_t unsigned24() { return next(3); }
  std::uint32_t unsigned32() { return next(4); }
  std::int32_t signed32() { return static_cast<std::int32_t>(next(4)); }
  std::int16_t signed16() { return static_cast<std::int16_t>(next(2)); }
  float float32() { return std::bit_cast<float>(next(4)); }
  /// The next byte, without consuming it; 0 at the end.
  char peek() const { return at_ < bytes_.size() ? bytes_[at_] : '\0'; }
  /// The next bytes as they are.
  std::string_view bytes(std::size_t count) {
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

 private:
  std::uint32_t next(std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
    return value;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace morsel::core
