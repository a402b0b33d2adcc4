#pragma once
/// The extension of a file's name.

#include <filesystem>
#include <string>

namespace morsel::core {

/// The extension with its dot and in small letters (ASCII, whatever the locale): ".off"; empty if there is
/// none.
std::string file_extension(const std::filesystem::path& path);

}  // namespace morsel::core
