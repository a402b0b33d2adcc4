#pragma once
/// Text in markup: HTML, SVG.

#include <string>
#include <string_view>

namespace morsel::tools {

/// The text as it stands between tags and in double quotes: & < > " as entities.
std::string markup_text(std::string_view text);

}  // namespace morsel::tools
