#pragma once
/// Where a command's table goes: a JSON or CSV file, standard output, or nowhere.

#include <cstddef>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/formats/journal.h"
#include "morsel/tools/report/output_check.h"

namespace morsel::tools {

/// The option of a table: -o, --output, and --as.
Option& add_table_option(Command& command, std::string& output, std::string help);

/// Adds what a TableTarget writes there. Throws InvalidArgument on another extension.
RunFiles& write_table(RunFiles& files, const core::FileTarget& target);

/// A document that can be a table (.csv), too, and what an interrupted run leaves of it.
class TableTarget : public DocumentTarget {
 public:
  /// One that write_table() takes; nothing if its path is empty. Throws WriteFailed.
  using DocumentTarget::DocumentTarget;

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
