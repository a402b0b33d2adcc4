#pragma once
/// Plain-text tables and numbers for people.

#include <string>
#include <vector>

#include "morsel/core/text/grouped.h"

namespace morsel::tools {

using core::grouped;

/// As std::printf() writes it ("%.2f").
std::string formatted(double value, const char* format);

/// Rows of cells, the first row a header, aligned: the first column to the left, the others to the right.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// Number of characters a terminal shows for UTF-8 text.
std::size_t display_width(const std::string& text);

}  // namespace morsel::tools
