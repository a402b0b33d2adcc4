#pragma once
/// Folders that are made for output, and removed again if they stay empty.

#include <filesystem>
#include <system_error>
#include <vector>

namespace morsel::core {

/// Knows the folders that it made. Not thread-safe.
class MadeFolders {
 public:
  /// The folder, and those around it, as far as they are missing. Forgets what was made before.
  std::error_code make(const std::filesystem::path& folder);
  /// Keeps what was made.
  void keep() noexcept { made_.clear(); }
  /// Removes what was made, from the inside out, as far as it is empty.
  void remove() noexcept;

 private:
  std::vector<std::filesystem::path> made_;  // from the inside out
};

}  // namespace morsel::core
