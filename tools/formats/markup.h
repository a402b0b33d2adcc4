#pragma once
/// Escapes text for markup: HTML, SVG.

#include <string>
#include <string_view>

namespace morsel::tools {

/// The text escaped for use between tags and in double quotes: & < > " as entities.
std::string markup_text(std::string_view text);

}  // namespace morsel::tools
