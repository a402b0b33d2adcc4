#pragma once
/// The page that holds a reproduction.

#include <string>
#include <string_view>

#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools::reproduce {

/// An HTML document that works from a double click and asks nothing of anywhere: every panel's picture is in
/// it, the paper's words and numbers beside ours, and the command lines. No script.
std::string make_page(const Prepared& prepared, const Reproduction& reproduction);

/// The page's style sheet, as the build embeds it (html/embed.cmake).
extern const std::string_view kStyle;

}  // namespace morsel::tools::reproduce
