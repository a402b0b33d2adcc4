#pragma once
/// Letters of ASCII in either case, whatever the locale. Internal.

#include <algorithm>
#include <string>
#include <string_view>

namespace morsel::core {

constexpr char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string lowered(std::string text) {
  for (char& c : text) c = lowered(c);
  return text;
}

/// Whether the word is this keyword, which is in small letters, in any case.
constexpr bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, [](char a, char b) { return lowered(a) == b; });
}

/// Whether the text begins with this one, which is in small letters, in any case.
constexpr bool begins_with_keyword(std::string_view text, std::string_view keyword) {
  return text.size() >= keyword.size() && is_keyword(text.substr(0, keyword.size()), keyword);
}

}  // namespace morsel::core
