#pragma once
/// Files that appear under their name only once they are whole. Internal to FileWriter, but for the functions
/// at the end.

#include <filesystem>

namespace morsel::core {

/// A file that is being written and becomes the target by publish(). It has no name until then where the file
/// system can do that (O_TMPFILE), so that nothing is left however the process ends. Elsewhere, and for the
/// moment of replacing a file, it is named `.morsel-PID-N.tmp` in the target's folder and locked (flock).
/// Unlocked files of such names, left by killed processes, are removed when a process first opens a file in
/// that folder: regular files of the same user only, never through a link.
///
/// Functions return 0 or the system's error number.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  ~TemporaryFile() { discard(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// With the permissions of a new file.
  int open(const std::filesystem::path& target);
  /// −1 if nothing is open.
  int descriptor() const { return file_; }
  /// Makes the file the target, in place of one that is there, and closes it. `sync`: the data and the
  /// folder's entry are on disk when this returns, the former before anything is replaced.
  int publish(bool sync);
  void discard() noexcept;

 private:
  int open_named();
  int link_under_temporary_name();
  int rename_to_target(bool sync);
  void next_name();
  void forget_name() noexcept;

  std::filesystem::path target_;
  std::filesystem::path folder_;
  std::filesystem::path name_;  // empty: none
  int slot_ = -1;               // of the registry of names
  int file_ = -1;
};

/// Whether the path names an open file by its descriptor (/dev/stdout, /dev/fd/3, /proc/self/fd/3): it is
/// written directly, never replaced.
bool is_descriptor_path(const std::filesystem::path& path);

/// fsync(), but for files that cannot be synced (pipes, some file systems). 0 or the error number.
int sync_to_disk(int file);

/// Removes the named temporary files of this process. Async-signal-safe, for exits in which no destructor
/// runs; nothing may be written afterwards.
void unlink_temporary_files() noexcept;

}  // namespace morsel::core
