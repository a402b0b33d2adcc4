#pragma once
/// Where a command's table goes: a JSON or CSV file, standard output as JSON, or nowhere.

#include <cstddef>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/formats/journal.h"
#include "morsel/tools/report/output_check.h"

namespace morsel::tools {

/// Adds what a TableTarget at this path writes. Throws InvalidArgument on another extension.
RunFiles& write_table(RunFiles& files, const std::string& path);

/// A document that can be a table (.csv), too, and what an interrupted run leaves of it.
class TableTarget : public DocumentTarget {
 public:
  /// `path`: a file that write_table() takes, "-" for JSON on standard output, nothing if it is empty. Throws
  /// WriteFailed.
  explicit TableTarget(const std::string& path);

  /// OUT.journal, beside a file that is wanted: what the run has done so far, should it be interrupted. Takes
  /// what follows from the same `key` over. Throws as Journal.
  Journal* open_journal(const Json& key);
  /// Warns of what is wrong with the journal, and prints how much of the work it holds, if any: `count`, and
  /// of what (" trials done").
  void tell_journal(std::size_t count, const std::string& of_what, Console& console) const;

  /// Writes the one that is wanted. The file is whole then, and the journal gone.
  void write(const std::function<void(JsonSink&)>& as_json, const std::function<void(std::ostream&)>& as_csv);

 private:
  std::optional<Journal> journal_;
};

}  // namespace morsel::tools
