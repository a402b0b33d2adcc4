#pragma once
/// The provenance of a result file, held by every file that the program writes.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// A JSON object, "morsel.provenance/1":
/// - schema, tool {name, version}
/// - command: the command line without what does not change the contents of files: outputs, threads, messages
/// - inputs[] {path, sha256}: all files that were read, the mesh first
/// - request {…}: all options that determine the result, with the defaults of those not given
/// - field {name, parameters{}}: with every value as resolved on the mesh
/// - methods[] {name, parameters{}}: likewise; those that the file shows
///
/// and members that distinguish a command's files ("level"). No date, no machine: the same command gives the
/// same bytes.
///
/// JSON documents have the same in members of their own; the other formats hold this object: as a PNG's
/// comment, in an SVG's <metadata>, as a .vtp file's field array "provenance", as a .graphml file's property
/// of the graph, in a .glb file's asset.extras, in a page's last comment, in comment lines of meshes, texts
/// and tables (joined without their marks, they are the object). find_provenance() reads it back from any of
/// them, and from the column "provenance" of earlier tables.
class Provenance {
 public:
  Provenance(std::string_view command, Json request, const std::vector<HashedFile>& inputs);
  /// The provenance of a result of one field.
  Provenance(std::string_view command, Json request, const FieldSource& source);

  /// Also adds the files that the field was read from to the inputs.
  void set_field(const FieldOutcome& field);
  /// The field that fills up where a first one has too few points: as "fill", and its files.
  void set_fill(const FieldOutcome& field);
  void add_method(const std::vector<StepOutcome>& steps);
  void set(std::string_view key, Json value) { document_[std::string(key)] = std::move(value); }
  /// A copy with one more method.
  Provenance with_method(const std::vector<StepOutcome>& steps) const;

  /// On one line, in ASCII, without < > and &: it needs no escaping in any markup.
  std::string json() const;
  /// The same split into lines of some 150 bytes, for the comments of formats whose readers take no long
  /// lines.
  std::vector<std::string> lines() const;
  /// These lines, each after "# ".
  std::string text_comment() const;
  /// A comment of HTML, with a line's end.
  std::string html_comment() const;

 private:
  void set_function(const char* member, const FieldOutcome& field);

  Json document_;
};

/// The provenance that the bytes of a file hold, in whatever format; null if there is none. It is untrusted:
/// throws BadInput if it is cut off, longer than 1 MiB, nested deeper than any that the program writes, or
/// lacks members above.
Json find_provenance(std::string_view bytes);
/// The same of a file. Throws BadInput also if it cannot be read.
Json read_provenance(const std::filesystem::path& path);

}  // namespace morsel::tools
