#pragma once
/// The sources of the page, as the build embeds them (embed.cmake).

#include <string_view>

namespace morsel::tools::html {

/// The document up to where its data belong, and what follows them: markup with style and scripts in it.
extern const std::string_view kPageBegin;
extern const std::string_view kPageEnd;

/// three.js, a classic script.
extern const std::string_view kThree;

}  // namespace morsel::tools::html
