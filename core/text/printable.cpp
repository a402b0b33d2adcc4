#include "morsel/core/text/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace morsel::core {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t size = 0;  ///< in bytes; 0: not UTF-8
};

/// The character that `text`, which is not empty, begins with.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || size > text.size()) return {};
  std::uint32_t code = byte(0) & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < kLeast[size] || code > 0x10ffff || is_surrogate ? Character{} : Character{code, size};
}

bool is_shown(std::uint32_t code) {
  const auto within = [code](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  return !(code < 0x20 || within(0x7f, 0x9f) || code == 0x61c || within(0x200e, 0x200f) ||
           within(0x2028, 0x202e) || within(0x2066, 0x2069) || within(0xfffe, 0xffff));
}

std::string escaped(const char* format, std::uint32_t number) {
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, static_cast<unsigned>(number));
  return buffer.data();
}

std::string escaped(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  if (code == '\r') return "\\r";
  return escaped(code < 0x80 ? "\\x%02x" : "\\u%04x", code);
}

/// The text with what is not shown as escape(code) and bytes that are not UTF-8 as escape_byte(byte); control
/// characters in `but` stay.
template <class Escape, class EscapeByte>
std::string with_escapes(std::string_view text, std::string_view but, const Escape& escape,
                         const EscapeByte& escape_byte) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Character first = first_character(text);
    const std::size_t size = first.size == 0 ? 1 : first.size;
    if (first.size == 0)
      shown += escape_byte(text.front());
    else if (is_shown(first.code) || but.find(text.front()) != std::string_view::npos)
      shown += text.substr(0, size);
    else
      shown += escape(first.code);
    text.remove_prefix(size);
  }
  return shown;
}

}  // namespace

std::string printable(std::string_view text, std::string_view but) {
  return with_escapes(
      text, but, [](std::uint32_t code) { return escaped(code); },
      [](char byte) { return escaped("\\x%02x", static_cast<unsigned char>(byte)); });
}

std::string json_printable(std::string text, std::string_view but) {
  const auto stays = [but](char c) {
    return (c >= ' ' && c <= '~') || but.find(c) != std::string_view::npos;
  };
  if (std::all_of(text.begin(), text.end(), stays)) return text;
  return with_escapes(
      text, but, [](std::uint32_t code) { return escaped("\\u%04x", code); },
      [](char byte) { return std::string(1, byte); });
}

}  // namespace morsel::core
