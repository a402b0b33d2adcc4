#pragma once
/// The journal of a long run, a file of its results so far, from which an interrupted run continues.

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/formats/json_view.h"

namespace morsel::tools {

/// A file of lines, each a JSON value: first {"schema": "morsel.journal/1", "key": …}, whose key has all
/// that the entries depend on besides their own data, then entries. Each is handed to the system before add()
/// returns, so that it is kept however the process ends. While it is open no other process can open it.
///
/// The file is untrusted: a line that is not JSON, and an entry that take_entries() rejects, count as absent.
/// They are overwritten with white space, so that each is reported once; a line that was cut off is removed.
class Journal {
 public:
  /// Reads the entries, if the file is there with the same key; else starts an empty one. Throws
  /// InvalidArgument if there is a file that is not a journal (nothing in it is changed), WriteFailed if it
  /// cannot be written or another process has it open.
  Journal(std::filesystem::path path, const Json& key);
  /// Keeps the file, unless it has no entries.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The entries that were in the file.
  const std::vector<Json>& entries() const { return entries_; }
  /// Hands each entry to `take`, which throws BadInput on one of the wrong shape; that one is dropped.
  void take_entries(const std::function<void(const JsonView& entry)>& take);
  /// Warnings about the file that was there, a sentence each.
  std::vector<std::string> warnings() const;

  /// May be called from several threads at once. Throws WriteFailed.
  void add(const Json& entry);
  /// Removes the file: the run is complete.
  void finish();

 private:
  struct Line {
    off_t begin;
    std::size_t size;
  };
  [[noreturn]] void fail(int error) const;
  void open_file();
  void begin(const Json& key);
  void append(const Json& value);
  void blank(const Line& line);
  void drop(const Line& line, const std::string& why);
  void read(const Json& head);
  bool read_line(std::string_view text, const Line& line, const Json& head);

  std::filesystem::path path_;
  int file_ = -1;
  bool is_empty_ = true;
  bool has_head_ = false;
  bool had_other_key_ = false;
  std::size_t dropped_ = 0;
  std::string why_dropped_;  // of the first one
  std::vector<Json> entries_;
  std::vector<Line> lines_;  // of the entries
  std::mutex mutex_;
};

/// The key in a journal's first line. Throws BadInput if it is not that of a journal.
Json journal_key(std::string_view line);

}  // namespace morsel::tools
