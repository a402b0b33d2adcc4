#pragma once
/// What a file of the program's is recognised by.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace morsel::tools {

/// A number of an inode is used again when its file is gone, so that the time at which the file was made
/// belongs to it. A copy with the times of its original has another inode, but size and time of the last
/// change.
struct FileIdentity {
  std::uint64_t inode = 0;
  std::int64_t made = 0;  ///< ns since 1970; 0: the file system does not tell, the inode has to do
  std::uint64_t bytes = 0;
  std::int64_t changed = 0;  ///< the content; ns since 1970
  bool is_regular = true;    ///< a file, and no link, folder, pipe or device

  /// Whether it is the same file, perhaps with another content, or a copy of the file as it was.
  bool is_that_of(const FileIdentity& other) const;
  std::string text() const;  ///< the numbers, with commas between them
  static std::optional<FileIdentity> from_text(std::string_view text);
};

/// Of an open file, or of an entry of an open folder, whose links are not followed. None, with errno, if the
/// system fails.
std::optional<FileIdentity> identity_of(int file);
std::optional<FileIdentity> identity_of(int folder, const std::string& name);

}  // namespace morsel::tools
