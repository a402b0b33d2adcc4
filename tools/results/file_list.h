#pragma once
/// The mark of a folder of results: the list of what was made in it.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/results/descriptor.h"
#include "morsel/tools/results/file_identity.h"

namespace morsel::tools {

/// A file .morsel-results: a line {"schema":"morsel.results/1"}, then a line for each change: "+PATH
/// IDENTITY" before a file appears, perhaps in place of an earlier one (file_identity.h), "+PATH/" before a
/// work folder does, "-PATH" after one was removed. Paths are relative to the folder and written as URLs have
/// them (%0A for a line break). Lines are appended only, so that each file has the same cost; an incomplete
/// last line, left by a process that ended, is ignored. Older lists have no identities: any file of a listed
/// name counts.
///
/// The content is not trusted (see lock()). All functions but lock() and unlock() only while it is locked.
class FileList {
 public:
  static constexpr const char* kName = ".morsel-results";

  /// Opens the file in the open folder, which messages call `shown`; one that is missing is made after
  /// `before_making` was called, which may throw. Throws BadInput if something else has its name, WriteFailed
  /// where it cannot be written.
  FileList(int folder, const std::filesystem::path& shown, const std::stop_token& stop,
           const std::function<void()>& before_making);

  /// Waits, up to half a minute, while another run has it, then reads what is new. Locks nothing on a file
  /// system without locks. Throws WriteFailed after that time, Cancelled on a stop, BadInput on a
  /// file with another first line, with a path that is absolute, not normal or has "..", or of more than 256
  /// MiB.
  void lock(const std::stop_token& stop);
  void unlock() noexcept;

  /// Whether the constructor made the file.
  bool is_new() const { return is_new_; }
  /// Those that are listed now, in order, each with all its files since it was last removed: a process may
  /// end before one appears.
  using Entries = std::map<std::string, std::vector<FileIdentity>, std::less<>>;
  const Entries& entries() const { return entries_; }
  bool has(std::string_view entry) const { return entries_.find(entry) != entries_.end(); }
  /// Whether the file of that name is one that was listed.
  bool has(std::string_view entry, const FileIdentity& file) const;
  /// Throws WriteFailed.
  void add_folder(const std::string& entry);
  void add_file(const std::string& entry, const FileIdentity& file);
  void remove(const std::string& entry);

 private:
  void begin(int folder, const std::function<void()>& before_making);
  void read();
  void take_line(std::string_view line);
  void append(const std::string& line);
  [[noreturn]] void refuse(const std::string& reason) const;

  std::filesystem::path path_;
  Descriptor file_;
  std::size_t read_ = 0;  // bytes, of whole lines
  std::size_t lines_ = 0;
  bool is_new_ = false;
  bool has_rest_ = false;  // of a line that was cut off
  Entries entries_;
};

/// A path in URL encoding: bytes that are not allowed in a URL become %XX.
std::string path_text(std::string_view path);
/// Whether the path can be that of a file in the folder: relative, normal, without ".." and not the list
/// itself.
bool is_path_inside(std::string_view path);

}  // namespace morsel::tools
