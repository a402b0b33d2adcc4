#pragma once
/// Where a command's document goes: a file, standard output or nowhere.

#include <optional>
#include <ostream>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/output_target.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// To be made before the work, so that one that cannot be written is reported then; the file is there after
/// commit().
class DocumentTarget {
 public:
  /// Nothing if its path is empty. Throws WriteFailed.
  explicit DocumentTarget(core::FileTarget target);

  bool is_wanted() const { return file_.has_value(); }
  /// The document, of which there is one. Only where it is wanted.
  JsonStream& json();
  void commit();

  /// Prints where the document is, if it is a file: "report: PATH".
  void tell(const std::string& what, const Run& run) const;

 protected:
  const core::FileTarget& target() const { return target_; }
  /// Only where it is wanted.
  std::ostream& stream() { return file_->stream(); }

 private:
  core::FileTarget target_;
  std::optional<core::FileWriter> file_;
  std::optional<JsonStream> json_;
};

}  // namespace morsel::tools
