#pragma once
/// The state of each mesh of a collection, in a file beside its report, by which a later run decides whether
/// to skip it.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/batch/child.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools::batch {

/// Why a mesh has no report.
struct MeshError {
  /// "exit-code", "signal", "time-limit" or "memory-limit"
  std::string kind;
  int exit_code = -1;  ///< −1: none
  int signal = 0;      ///< 0: none
  std::string message;

  /// Whether the cause may be the machine, not the mesh: a full disk, no memory, a signal from outside.
  bool may_pass() const;
};

struct MeshState {                 // NOLINT(bugprone-exception-escape): of the JSON library
  Json key;                        ///< of the request (request.h)
  std::optional<MeshError> error;  ///< none: done
  ChildLimits limits;              ///< under which it failed
  Json result;                     ///< of the report: "mesh", "field", "methods" with their counts
  Json timings;                    ///< of the report
  std::vector<std::string> files;  ///< that were made of it (request.h)
  double seconds = 0;              ///< from the child's start to its end
};

/// The warnings of reading the mesh, as its report has them; none unless it is done.
std::vector<std::string> mesh_warnings(const MeshState& state);

/// The error of a child's end; none if it succeeded.
std::optional<MeshError> error_of(const ChildEnd& end, const ChildLimits& limits);

/// Takes from a report what the summary needs, without its items, which are the larger part. Throws BadInput
/// if it is damaged.
void take_result(const std::filesystem::path& report, MeshState& state);

/// Whether the mesh may be skipped: its key is unchanged, and all its files exist, or it failed within the
/// same limits and would fail again.
bool is_settled(const MeshState& state, const Json& key, const ChildLimits& limits,
                const std::vector<Product>& products);

/// Throws WriteFailed.
void write_state(const std::filesystem::path& path, const MeshState& state);
/// None if there is none, or another version's. Throws BadInput if it is damaged: not JSON, too large, or any
/// member lacks the type and range that write_state() gives it, so that users of a state need not check.
std::optional<MeshState> read_state(const std::filesystem::path& path);
/// The same of a state's text; errors call it `name`.
std::optional<MeshState> parse_state(std::string_view text, const std::string& name);

/// {"kind", "exit_code", "signal", "message"}
Json to_json(const MeshError& error);
/// {"seconds", "memory_mib"}, null where there is none
Json to_json(const ChildLimits& limits);

}  // namespace morsel::tools::batch
