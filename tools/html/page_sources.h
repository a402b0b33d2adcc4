#pragma once
/// The sources of the page, as the build embeds them (embed.cmake).

#include <string_view>

#include "morsel/tools/formats/embedded_text.h"

namespace morsel::tools::html {

/// The document: markup with style and scripts in it. Its data belong where kPagePlace is.
extern const EmbeddedText kPage;
inline constexpr std::string_view kPagePlace = "<!--DATA-->";

/// three.js, a classic script.
extern const EmbeddedText kThree;

}  // namespace morsel::tools::html
