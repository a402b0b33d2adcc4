#pragma once
/// Comments in PNG files.

#include <string>
#include <string_view>

namespace morsel::tools::drawing {

/// The bytes of a PNG file with the text chunks Software (the program and its version) and Comment inserted
/// before its pixels; unchanged if the comment is empty. `comment` is Latin-1.
std::string with_png_comment(std::string png, std::string_view comment);

}  // namespace morsel::tools::drawing
