#pragma once
/// Where a command's document goes: a file, standard output or nowhere.

#include <optional>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// To be made before the work, so that a file that cannot be written is told then; the file is there after
/// commit().
class DocumentTarget {
 public:
  /// `path`: a file, "-" for standard output, nothing if it is empty. Throws WriteFailed.
  explicit DocumentTarget(const std::string& path);

  bool is_wanted() const { return file_ || to_stdout_; }
  /// Then nothing else may be printed there.
  bool is_stdout() const { return to_stdout_; }
  bool is_file() const { return file_.has_value(); }
  /// The document, of which there is one. Only where it is wanted.
  JsonStream& json();
  void commit();

 private:
  bool to_stdout_;
  std::optional<core::FileWriter> file_;
  std::optional<JsonStream> json_;
};

}  // namespace morsel::tools
