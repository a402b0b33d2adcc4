#pragma once
/// Sentences about what a reader tolerates: the warnings of LoadedSoup. Internal.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/text/numbers.h"

namespace morsel::core {

/// "1 face", "1,200 faces"; "2 vertices" with `plural`.
inline std::string counted(std::uint64_t number, std::string_view one, std::string_view plural = {}) {
  std::string text = grouped(number) + " ";
  if (number == 1) return text.append(one);
  return plural.empty() ? text.append(one).append("s") : text.append(plural);
}

/// Adds "3 lines follow the 4 vertices that its header announces; they are left out", unless there are none.
inline void add_left_out(std::vector<std::string>& warnings, std::uint64_t number, std::string_view one,
                         const std::string& after) {
  if (number == 0) return;
  warnings.push_back(counted(number, one) + (number == 1 ? " follows " : " follow ") + after +
                     (number == 1 ? "; it is left out" : "; they are left out"));
}

}  // namespace morsel::core
