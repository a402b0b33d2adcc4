#pragma once
/// The page that holds a reproduction.

#include <string>

#include "morsel/tools/formats/embedded_text.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools::reproduce {

/// A self-contained HTML document: every panel's picture, the paper's statements and numbers beside the
/// results, and the command lines. No script, no other file, no network.
std::string make_page(const Prepared& prepared, const Reproduction& reproduction);

/// The page's style sheet, as the build embeds it (html/embed.cmake).
extern const EmbeddedText kStyle;

}  // namespace morsel::tools::reproduce
