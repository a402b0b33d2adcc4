#pragma once
/// What a PNG file says of itself.

#include <string>
#include <string_view>

namespace morsel::tools::drawing {

/// The bytes of a PNG file with the text chunks Software (the program and its version) and Comment put in
/// front of its pixels; as they are if the comment is empty. `comment` is Latin-1.
std::string with_png_comment(std::string png, std::string_view comment);

}  // namespace morsel::tools::drawing
