#pragma once
/// Arrays of numbers in a page's data, and how its metadata refer to them.

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/html/packed_stream.h"

namespace morsel::tools::html {

/// Appends arrays to a stream. Each call returns the page's reference to the array:
/// {"type", "offset", "bytes", "count"}, where `type` is
///   u8, u16, f64  numbers, little-endian
///   delta         unsigned 32-bit numbers of which most are near the one before: the differences d,
///                 beginning with that to 0, as 2d or −2d − 1, seven bits a byte from the lowest on; the
///                 eighth bit is set if more follow
class Buffers {
 public:
  explicit Buffers(PackedStream& stream) : stream_(stream) {}

  template <class Number>
  Json add(const std::vector<Number>& values) {
    static_assert(std::is_arithmetic_v<Number> && sizeof(Number) != 4);
    return add_raw(sizeof(Number) == 1   ? "u8"
                   : sizeof(Number) == 2 ? "u16"
                                         : "f64",
                   values.data(), values.size(), sizeof(Number));
  }
  Json add_deltas(std::span<const std::uint32_t> values);

 private:
  Json add_raw(const char* type, const void* data, std::size_t count, std::size_t bytes_each);

  PackedStream& stream_;
};

}  // namespace morsel::tools::html
