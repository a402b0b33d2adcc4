#pragma once
/// Where a command's rows go: a .json or .csv file, JSON on standard output, or nowhere.

#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/formats/journal.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// Adds what a TableTarget at this path writes.
RunFiles& write_table(RunFiles& files, const std::string& path);

/// To be made before the work, so that a file that cannot be written is told then.
class TableTarget {
 public:
  /// `path`: a file, "-" for JSON on standard output, nothing if it is empty. Throws InvalidArgument on
  /// another ending and WriteFailed.
  explicit TableTarget(const std::string& path);

  /// Then nothing else may be printed there.
  bool is_stdout() const { return path_ == "-"; }
  bool is_file() const { return file_.has_value(); }

  /// OUT.journal, beside a file that is wanted: what the run has done so far, should it be interrupted. Takes
  /// what follows from the same `key` over. Throws as Journal.
  Journal* open_journal(const Json& key);

  /// Writes the one that is wanted. The file is whole then, and the journal gone.
  void write(const std::function<void(JsonSink&)>& as_json, const std::function<void(std::ostream&)>& as_csv);

 private:
  std::string path_;
  bool is_csv_ = false;
  std::optional<core::FileWriter> file_;
  std::optional<Journal> journal_;
};

}  // namespace morsel::tools
