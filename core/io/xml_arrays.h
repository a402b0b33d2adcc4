#pragma once
/// Arrays of numbers as XML files hold them: as decimal text, or as compressed bytes.
/// Internal, of the part FORMATS.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/number_type.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// `count` numbers of a text, between white space, with the precision of their type. Throws BadInput, which
/// begins with `what`, if they are more or fewer, or one is no number of the type.
std::vector<double> text_numbers(std::string_view text, NumberType type, std::uint64_t count,
                                 const std::string& what, const Progress& progress);

/// The `size` bytes that are compressed in `bytes` (zlib's format or gzip's). Memory grows with what comes
/// out, and no further than `size`. Throws BadInput, which begins with `what`, if they are damaged, or more
/// or fewer than that.
std::string inflated(std::string_view bytes, std::uint64_t size, const std::string& what,
                     const Progress& progress);

}  // namespace morsel::core
