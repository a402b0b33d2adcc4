#pragma once
/// Content hashes of input files.

#include <filesystem>
#include <string>
#include <string_view>

namespace morsel::tools {

/// SHA-256 of a file's bytes as 64 hexadecimal digits. Throws BadInput if it cannot be read or is not a
/// regular file.
std::string sha256_of_file(const std::filesystem::path& path);

/// The same of bytes in memory.
std::string sha256_of(std::string_view bytes);

/// An input file as documents name it.
struct HashedFile {
  std::string path;  ///< as the user gave it
  std::string sha256;
};

}  // namespace morsel::tools
