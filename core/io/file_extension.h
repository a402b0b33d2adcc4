#pragma once
/// The extension of a file's name.

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "morsel/core/io/file_writer.h"

namespace morsel::core {

/// The extension with its dot and in small letters (ASCII, whatever the locale): ".off"; empty if there is
/// none.
std::string file_extension(const std::filesystem::path& path);

/// The extension of an output, or the format of an open file, which must be one of `allowed`, each with its
/// dot and in small letters; one of them may be longer than an extension (".label.gii"). Throws
/// InvalidArgument otherwise: "a field is written to .txt, .ply or .vtp, not to "out.png"", where `what` is
/// "a field is written".
std::string checked_extension(const FileTarget& target, std::string_view what,
                              std::initializer_list<std::string_view> allowed);

}  // namespace morsel::core
