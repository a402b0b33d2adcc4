#pragma once
/// The mesh and field that a document is of, and the program's command that makes the same.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/python/binding/data.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/report_writer.h"

namespace morsel::python {

/// Where a document is written, and its mesh.
struct DocumentPlace {
  std::string path;
  /// The file that the mesh is written to first, with the values that a field was given of; none: the file
  /// that it was read from or, where there is none, memory.
  std::optional<std::string> mesh_file = {};
  bool mesh_must_be_file = false;
  /// Its format is no mesh's: it is not written to a name like mesh.off either.
  bool is_no_mesh = false;
};

/// Throws InvalidArgument where a file that is written is `mesh`'s, one of `read`, or another one that is
/// written (output_check.h).
void check_outputs(const DocumentPlace& place, const std::string& mesh, const std::vector<std::string>& read);
/// The paths of the files that a Morse function read.
std::vector<std::string> files_of(const tools::FieldOutcome& field);
std::vector<std::string> paths_of(const std::vector<tools::HashedFile>& files);

/// A mesh as a document names it.
struct DocumentMesh {
  core::LoadedMesh loaded;  ///< in the vertex numbers of the file
  tools::HashedFile file;
  core::BuildOptions build = {};
  std::string read_from;  ///< where `file` is, whatever the working directory has become; empty: in memory

  /// `items`: whether lists that grow with the mesh are written.
  tools::ReportInput about(bool items = true) const { return {file.path, file.sha256, build, items}; }
  /// The positions of the file's vertices, those that repair dropped included.
  std::vector<core::Point> input_positions(const core::Progress& progress) const;
};

/// `read`: the paths of the other files that the input was made of. Throws as check_outputs(),
/// InvalidArgument where the mesh must be in a file and is not, BadInput where its file has changed since it
/// was read, and what writing throws.
DocumentMesh document_mesh(const StudyInput& input, const DocumentPlace& place,
                           const std::vector<std::string>& read, const core::Progress& progress);

/// A field on its mesh. A JSON document is made again from its request, so that the field must have one;
/// other files hold any field.
class DocumentField {
 public:
  DocumentField(const FieldHandle& field, const DocumentPlace& place, const tools::Registry& registry,
                const core::Progress& progress);

  const DocumentMesh& mesh() const { return mesh_; }
  const tools::FieldRequest& request() const { return made_.request; }
  const tools::MadeField& made() const { return made_.made; }
  tools::FieldSource source() const { return {mesh_.file, mesh_.loaded, made_.plan, made_.made}; }
  /// `words`: the command's own, after its field and method. Of a field that no request makes, the command
  /// and the request are empty.
  tools::Provenance provenance(const std::string& command, const std::vector<std::string>& words,
                               const tools::Json& request) const;

 private:
  DocumentMesh mesh_;
  Documented made_;
  bool is_request_;
};

/// "morsel COMMAND MESH --field F --method M …"; `words`: all that shapes the result.
std::string command_of(const std::string& command, const DocumentMesh& mesh,
                       const std::vector<std::string>& words);

/// Writes a JSON document whole or not at all.
void write_document(const std::string& path, const std::function<void(tools::JsonSink&)>& write);

}  // namespace morsel::python
