#pragma once
/// Tables of comma-separated values.

#include <string>
#include <string_view>

namespace morsel::tools {

/// A field of a CSV file: in quotes where it has a comma, a quote or a line's end (RFC 4180).
std::string csv_field(std::string_view text);

}  // namespace morsel::tools
