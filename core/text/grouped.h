#pragma once
/// Large numbers for people.

#include <cstdint>
#include <string>

namespace morsel::core {

/// 1234567 → "1,234,567".
std::string grouped(std::uint64_t number);

}  // namespace morsel::core
