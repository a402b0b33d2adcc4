#pragma once
/// Numbers of the types that files name, as bytes and as text. Internal.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t size_of(NumberType type);
inline bool is_whole(NumberType type) { return type != NumberType::float32 && type != NumberType::float64; }

/// The numbers in `bytes`, of which there is a whole number of elements; `swap`: in the other byte order than
/// this machine's.
std::vector<double> decoded(std::string_view bytes, NumberType type, bool swap, const Progress& progress);
/// The same for whole numbers, exactly; an unsigned one beyond 2^63 becomes −1.
std::vector<std::int64_t> decoded_whole(std::string_view bytes, NumberType type, bool swap,
                                        const Progress& progress);

/// A number of a text with the precision of its type, so that text and binary forms give the same number;
/// false if it is none, or is out of the type's range. A whole number may be written as a fraction ("3.0").
bool parse_number(std::string_view word, NumberType type, double& value);
/// The same for whole numbers, exactly, and written as such.
bool parse_whole(std::string_view word, NumberType type, std::int64_t& value);

}  // namespace morsel::core
