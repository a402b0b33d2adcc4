#include "morsel/tools/html/buffers.h"

#include <bit>

namespace morsel::tools::html {

Json Buffers::add_raw(const char* type, const void* data, std::size_t count, std::size_t bytes_each) {
  static_assert(std::endian::native == std::endian::little);
  const std::uint64_t offset = stream_.size();
  stream_.write(data, count * bytes_each);
  return {{"type", type}, {"offset", offset}, {"bytes", count * bytes_each}, {"count", count}};
}

Json Buffers::add_deltas(std::span<const std::uint32_t> values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  std::int64_t before = 0;
  for (const std::uint32_t value : values) {
    const std::int64_t difference = std::int64_t{value} - before;
    before = value;
    auto rest = static_cast<std::uint64_t>(difference >= 0 ? 2 * difference : -2 * difference - 1);
    for (; rest >= 128; rest >>= 7) bytes.push_back(static_cast<std::uint8_t>(128 | (rest & 127)));
    bytes.push_back(static_cast<std::uint8_t>(rest));
  }
  Json reference = add_raw("delta", bytes.data(), bytes.size(), 1);
  reference["count"] = values.size();
  return reference;
}

}  // namespace morsel::tools::html
