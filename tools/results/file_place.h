#pragma once
/// The identity of a file, so that two paths of one file are equal.

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace morsel::tools {

/// A file or folder by its device and inode, through links; one that is not there by those of the nearest
/// folder around it that is, and the path from there.
struct FilePlace {
  dev_t device = 0;
  ino_t inode = 0;
  std::string rest;        ///< empty for what exists
  bool is_device = false;  ///< or a pipe or socket: no file that could lose anything
  bool is_system =
      false;  ///< by a path of the system's (/dev/stdout, /proc/self/fd/3): written as the data come

  friend bool operator==(const FilePlace& a, const FilePlace& b) {
    return a.device == b.device && a.inode == b.inode && a.rest == b.rest;
  }
  friend bool operator<(const FilePlace& a, const FilePlace& b);
};

FilePlace file_place(const std::filesystem::path& path);
/// That of an open file; of one that is not open nothing's.
FilePlace file_place(int descriptor);

/// Whether the path is the folder or lies in it, through links; neither has to exist.
bool is_in(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace morsel::tools
