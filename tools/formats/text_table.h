#pragma once
/// Plain-text tables.

#include <cstddef>
#include <string>
#include <vector>

#include "morsel/core/text/numbers.h"

namespace morsel::tools {

using core::grouped;

/// Rows of cells, the first row a header, aligned: the first column to the left, the others to the right.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// Number of characters a terminal shows for UTF-8 text.
std::size_t display_width(const std::string& text);

}  // namespace morsel::tools
