#pragma once
/// The steps that commands on a mesh share, in their order: names are looked up, files checked and targets
/// opened, so that what is wrong with them is reported before the work; the mesh is read and its field made;
/// results are written with their provenance, and their paths printed.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_target.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/output_check.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// Throws WriteFailed unless a file could be written there. An empty path stands for none; a pipe is not
/// opened, since closing it again would end its reader.
void check_writable(const core::FileTarget& target);

/// The folder of results at `path`, which knows the run's other outputs; null if the path is empty. Throws as
/// ResultFolder.
std::unique_ptr<ResultFolder> open_folder(const std::string& path, const RunFiles& files, const Run& run);

/// MESH, and what documents say of it.
struct MeshInput {
  core::LoadedMesh loaded;
  ReportInput about;

  HashedFile file() const { return {about.mesh_path, about.mesh_sha256}; }
};
/// Throws InvalidArgument: standard input has no name that says which of the formats it has.
[[noreturn]] void fail_without_format(const std::vector<std::string>& formats);
/// MESH as the command line names it: a file, or - for standard input, of which all is read at its first use.
/// Throws InvalidArgument where - has no --format, BadInput as standard_input().
MeshOrigin mesh_file(const std::string& path, const Run& run);
/// Made for `functions` (build_for()). `items`: whether documents list what grows with the mesh.
MeshInput read_input(const std::string& path, std::span<const NamedFunction> functions, const Run& run,
                     bool items = true);

/// Warnings of reading a mesh, of a Morse function, and of methods.
void tell_warnings(const core::LoadedMesh& loaded, Console& console);
void tell_warnings(const FieldOutcome& field, Console& console);
void tell_warnings(const std::vector<StepOutcome>& steps, Console& console);
/// Warnings, why a wanted number of critical points was not reached, and whether it ended a method early.
void tell_made(const MadeField& made, Console& console);

/// How many points were chosen, how far apart, and why there are fewer than asked for.
void tell_points(const MadePoints& made, const PointsRequest& request, Console& console);

/// What commands on one field begin with: MESH, and what --field, --method and --target make on it.
class FieldRun {
 public:
  /// Looks the names up. Throws as prepare(). Refers to all three, which must outlive it.
  FieldRun(const std::string& mesh, const FieldRequest& request, const Run& run);
  FieldRun(const FieldRun&) = delete;
  FieldRun& operator=(const FieldRun&) = delete;

  /// Throws InvalidArgument if a file's name has an extension that is not written.
  using CheckPath = void (*)(const core::FileTarget& target);
  /// Adds an output that is written when all is computed; an empty path stands for none. Throws as
  /// `check_path`.
  FieldRun& writes(const std::string& option, const core::FileTarget& target, CheckPath check_path = nullptr);
  /// Adds a document, which a DocumentTarget opens. Throws InvalidArgument if it is named as a mesh.
  FieldRun& writes_document(const std::string& option, const core::FileTarget& target);
  /// Adds a file that is read besides MESH.
  FieldRun& reads(const std::string& option, const std::filesystem::path& path);
  /// Adds the files that keys of another field name.
  FieldRun& reads_of_field(const std::string& specification, const std::string& option);
  /// To be called when all of them are added. Throws as RunFiles::check(), then as check_writable() for those
  /// of writes().
  void check_files() const;

  /// Reads MESH. Throws as core::read_mesh().
  void read();
  /// The same, for commands that write in the input's vertex numbers.
  void read_whole();
  const core::LoadedMesh& loaded() const { return mesh_->loaded; }
  /// Of all vertices of the file, after read_whole().
  const std::vector<core::Point>& input_positions() const { return mesh_->input_positions; }

  /// Makes the field on the mesh; prints why a wanted number of critical points was not reached.
  void make();
  const core::ScalarField& field() const { return made_->field(); }
  const MadeField& made() const { return *made_; }
  /// Chooses points of it and tells what is to be told of them.
  MadePoints choose_points(const PointsPlan& plan);
  const FieldPlan& plan() const { return plan_; }

  /// What documents and other files say of all that. `request`: all options that shape the result.
  FieldSource source() const { return {file_, loaded(), plan_, *made_}; }
  Provenance provenance(const Json& request) const;
  /// "load", "field", "method" and, where points were chosen, "points"; then `more`.
  Timings timings(const Timings& more = {}) const;

 private:
  const Run& run_;
  FieldPlan plan_;
  HashedFile file_;
  RunFiles files_;  // MESH, what keys of the field name, and what was added
  std::vector<core::FileTarget> written_;
  std::optional<core::WholeMesh> mesh_;
  double load_seconds_ = 0;
  std::optional<MadeField> made_;
  std::optional<double> points_seconds_;
};

}  // namespace morsel::tools
