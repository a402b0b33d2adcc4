#pragma once
/// What a long run has done so far, in a file: a run that was interrupted goes on from there.

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <vector>

#include "morsel/tools/report/json_stream.h"

namespace morsel::tools {

/// A file of lines, each a JSON value: first the key, which says what entries follow from besides themselves, then entries.
/// Each is handed to the system before add() returns, so that no end of the process takes it away; a line that was cut
/// off is passed over. While it is open no other process can open it.
class Journal {
 public:
  /// Reads the entries, if the file is there with the same key; else begins an empty one. Throws WriteFailed if it cannot be written or another
  /// process has it open.
  Journal(std::filesystem::path path, const Json& key);
  /// Leaves the file, unless it has no entries.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Those that were there.
  const std::vector<Json>& entries() const { return entries_; }
  /// May be called from several threads at once. Throws WriteFailed.
  void add(const Json& entry);
  /// Removes the file: what it was for is done.
  void finish();

 private:
  [[noreturn]] void fail(int error) const;
  void append(const Json& value);
  std::size_t read(const Json& key);

  std::filesystem::path path_;
  int file_ = -1;
  bool is_empty_ = true;
  std::vector<Json> entries_;
  std::mutex mutex_;
};

}  // namespace morsel::tools
