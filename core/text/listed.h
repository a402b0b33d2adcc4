#pragma once
/// Lists within sentences.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace morsel::core {

/// "a, b and c" where `last` is " and "; "" of none.
inline std::string listed(std::span<const std::string> items, std::string_view last = ", ") {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? last : ", ";
    text += items[i];
  }
  return text;
}

}  // namespace morsel::core
