#pragma once
/// Symbolic links.

#include <filesystem>

namespace morsel::core {

/// The file that a chain of symbolic links ends at, which need not exist: the one that FileWriter replaces.
/// Throws std::filesystem::filesystem_error if a link cannot be read.
std::filesystem::path followed(std::filesystem::path path);

}  // namespace morsel::core
