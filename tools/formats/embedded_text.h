#pragma once
/// Texts that the program holds, as the build embeds them (html/embed.cmake).

#include <span>
#include <string>
#include <string_view>

namespace morsel::tools {

/// The text's pieces, in order: compilers need not take string literals of more than 65,536 bytes.
using EmbeddedText = std::span<const std::string_view>;

std::string joined(EmbeddedText text);

}  // namespace morsel::tools
