#pragma once
/// What is known of each mesh of a collection, in a file beside its report: the reason why a later run may pass it over.

#include <filesystem>
#include <optional>
#include <string>

#include "morsel/tools/batch/child.h"
#include "morsel/tools/report/json_stream.h"

namespace morsel::tools::batch {

/// The files of a folder of results; none is made by asking for its path.
class OutFolder {
 public:
  explicit OutFolder(std::filesystem::path root) : root_(std::move(root)) {}

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path report(const std::string& name) const { return file("reports", name, ".json"); }
  std::filesystem::path state(const std::string& name) const { return file("state", name, ".json"); }
  /// `which`: "first" or "last"
  std::filesystem::path thumbnail(const std::string& name, const std::string& which) const {
    return file("thumbnails", name, "." + which + ".png");
  }
  /// A folder for what is not whole yet. Emptied before a mesh begins, so that what a killed run left does no harm.
  std::filesystem::path work(const std::string& name) const { return file("state", name, ".part"); }

 private:
  std::filesystem::path file(const char* folder, const std::string& name, const std::string& ending) const {
    return root_ / folder / (name + ending);
  }
  std::filesystem::path root_;
};

/// Why a mesh has no report.
struct MeshError {
  /// "exit-code", "signal", "time-limit" or "memory-limit"
  std::string kind;
  int exit_code = -1;  ///< −1: none
  int signal = 0;      ///< 0: none
  std::string message;

  /// Whether it may be the machine's doing, not the mesh's: the disk full, its memory used up, killed by somebody.
  bool may_pass() const;
};

struct MeshState {                 // NOLINT(bugprone-exception-escape): of the JSON library
  Json key;                        ///< what it was made from (request.h)
  std::optional<MeshError> error;  ///< none: done
  ChildLimits limits;              ///< under which it failed
  Json result;                     ///< of the report: "mesh", "field", "methods" with their counts
  Json timings;                    ///< of the report
  double seconds = 0;              ///< from the child's start to its end
};

/// What a child's end means; none if it ended well.
std::optional<MeshError> error_of(const ChildEnd& end, const ChildLimits& limits);

/// What the summary needs of a report, of which the report's items are the larger part. Throws BadInput.
void take_result(const std::filesystem::path& report, MeshState& state);

/// Whether the mesh may be passed over: its key is as it was, and its report (and pictures, if they are wanted) is there, or it failed within
/// the same limits and would again.
bool is_settled(const MeshState& state, const Json& key, const ChildLimits& limits, const OutFolder& out,
                const std::string& name);

/// Throws WriteFailed.
void write_state(const std::filesystem::path& path, const MeshState& state);
/// None if there is none, or one that is damaged or another version's.
std::optional<MeshState> read_state(const std::filesystem::path& path);

/// {"kind", "exit_code", "signal", "message"}
Json to_json(const MeshError& error);
/// {"seconds", "memory_mib"}, null where there is none
Json to_json(const ChildLimits& limits);

}  // namespace morsel::tools::batch
