#pragma once
/// Where a command's document goes: a file, standard output or nowhere.

#include <optional>
#include <ostream>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/console.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// To be made before the work, so that one that cannot be written is reported then; the file is there after
/// commit().
class DocumentTarget {
 public:
  /// `path`: a file, "-" for standard output, nothing if it is empty. Throws WriteFailed.
  explicit DocumentTarget(const std::string& path);

  bool is_wanted() const { return file_ || is_stdout(); }
  /// The document, of which there is one. Only where it is wanted.
  JsonStream& json();
  void commit();

  /// Prints what is for a person to read, unless standard output is for the document.
  void show(const std::string& text) const;
  /// Prints where the document is, if it is a file: "report: PATH".
  void tell(const std::string& what, Console& console) const;

 protected:
  bool is_stdout() const { return path_ == "-"; }
  bool is_file() const { return file_.has_value(); }
  const std::string& path() const { return path_; }
  std::ostream& stream();

 private:
  std::string path_;
  std::optional<core::FileWriter> file_;
  std::optional<JsonStream> json_;
};

}  // namespace morsel::tools
