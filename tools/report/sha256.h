#pragma once
/// Content hashes of input files.

#include <filesystem>
#include <string>

namespace morsel::tools {

/// SHA-256 of a file's bytes as 64 hexadecimal digits. Throws BadInput if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace morsel::tools
