#include "morsel/core/text/base64.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace morsel::core {
namespace {

constexpr std::int8_t kBlankDigit = -1;
constexpr std::int8_t kPadding = -2;
constexpr std::int8_t kNoDigit = -3;

/// What each byte is: a digit's value, or one of the above.
constexpr std::array<std::int8_t, 256> digit_table() {
  std::array<std::int8_t, 256> table{};
  table.fill(kNoDigit);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    table[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  for (const char blank : {' ', '\t', '\n', '\r', '\v', '\f'})
    table[static_cast<unsigned char>(blank)] = kBlankDigit;
  table['='] = kPadding;
  return table;
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text, const Progress& progress) {
  constexpr std::array<std::int8_t, 256> kTable = digit_table();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  std::size_t digits = 0;
  bool padded = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((i & 0xFFFF) == 0) progress.throw_if_cancelled();
    const std::int8_t digit = kTable[static_cast<unsigned char>(text[i])];
    if (digit == kBlankDigit) continue;
    if (digit == kPadding) {
      padded = true;
      continue;
    }
    if (digit == kNoDigit || padded) return std::nullopt;
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if (++digits % 4 != 0) continue;
    for (const int shift : {16, 8, 0}) bytes += static_cast<char>(group >> shift & 0xFF);
    group = 0;
  }
  switch (digits % 4) {
    case 0:
      return bytes;
    case 2:
      bytes += static_cast<char>(group >> 4 & 0xFF);
      return bytes;
    case 3:
      bytes += static_cast<char>(group >> 10 & 0xFF);
      bytes += static_cast<char>(group >> 2 & 0xFF);
      return bytes;
    default:
      return std::nullopt;
  }
}

}  // namespace morsel::core
