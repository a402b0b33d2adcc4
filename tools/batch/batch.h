#pragma once
/// A comparison of every mesh of a collection: each in a process of its own, each done once.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/batch/collection.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/batch/state.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::tools::batch {

struct RunOptions {
  ChildLimits limits;    ///< of each mesh
  std::size_t jobs = 1;  ///< meshes at the same time
  int threads = 1;       ///< of each
  std::stop_token stop;  ///< wakes the run at once; what works in this process listens to its Progress
  bool retry = false;    ///< whether what failed before is run again
};

enum class Status { done, failed, not_run };

/// Where a mesh stands after a run.
struct MeshOutcome {  // NOLINT(bugprone-exception-escape): of the JSON library
  CollectionMesh mesh;
  Status status = Status::not_run;
  bool was_settled = false;  ///< by an earlier run
  std::string state_damage;  ///< what is wrong with the state that was there; empty if nothing is
  Json sha256;               ///< of its file; null if it cannot be read
  MeshState state;           ///< unless it was not run
};

/// Told of each mesh that ends, in the order in which they do.
using TellOutcome = std::function<void(const MeshOutcome&)>;

/// Where the meshes stand after what earlier runs have left in `out`; nothing is run and nothing written. In
/// the meshes' order. Throws InvalidArgument on a request with unknown names.
std::vector<MeshOutcome> look_at(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                 const RunOptions& options, const OutFolder& out,
                                 const core::Progress& progress = {});

/// Runs `compare` (the program's own file, again) on the meshes that are not settled (state.h), and writes
/// what comes of them into `out` (out_folder.h). A mesh's things are made in a folder of this run's own and
/// put in place when they are whole, the state last: a run that is ended in any way loses the meshes in work
/// and nothing else. One mesh's failure, crash or excess is that mesh's outcome.
///
/// In the meshes' order. Runs may share a folder: a mesh that is in several at the same time is made by each,
/// and has the things of one of them, the last (where file systems have no locks: if they ran with the same
/// options). Throws InvalidArgument on a request with unknown names, WriteFailed where `out` cannot be
/// written, before the work if it has something of somebody else in the place of a result, Cancelled when
/// told to stop (the children have ended and their half-made files are gone).
std::vector<MeshOutcome> run_batch(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                   const RunOptions& options, ResultFolder& out,
                                   const core::Progress& progress = {}, const TellOutcome& tell = {});

}  // namespace morsel::tools::batch
