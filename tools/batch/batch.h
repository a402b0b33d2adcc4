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
  std::stop_token stop;  ///< ends the run at once; computations in this process are stopped by their Progress
  bool retry = false;    ///< whether failed meshes are run again
};

enum class Status { done, failed, not_run };

/// The outcome of a mesh after a run.
struct MeshOutcome {  // NOLINT(bugprone-exception-escape): of the JSON library
  CollectionMesh mesh;
  Status status = Status::not_run;
  bool was_settled = false;  ///< by an earlier run
  std::string state_damage;  ///< the damage of the earlier state; empty if there is none
  Json sha256;               ///< of its file; null if it cannot be read
  MeshState state;           ///< unless it was not run
};

/// Called with each mesh that ends, in the order in which they end.
using TellOutcome = std::function<void(const MeshOutcome&)>;

/// The outcomes of the meshes by the states of earlier runs in `out`; nothing is run and nothing written. In
/// the meshes' order. Throws InvalidArgument on a request with unknown names.
std::vector<MeshOutcome> look_at(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                 const RunOptions& options, const OutFolder& out,
                                 const core::Progress& progress = {});

/// Runs `compare` (the program's own file, again) on the meshes that are not settled (state.h), and writes
/// their results into `out` (out_folder.h). A mesh's files are made in a work folder of this run and moved
/// when they are complete, the state last: a run that ends in any way loses only the meshes in work. A
/// failure, a crash or an exceeded limit is the outcome of that mesh alone.
///
/// In the meshes' order. Runs may share a folder: a mesh that is in several at the same time is made by each,
/// and has the files of the last of them (where file systems have no locks: if they ran with the same
/// options). Throws InvalidArgument on a request with unknown names, WriteFailed where `out` cannot be
/// written, before the work if a file that is not the program's is in the place of a result, Cancelled on a
/// stop (the children have ended and their incomplete files are removed).
std::vector<MeshOutcome> run_batch(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                   const RunOptions& options, ResultFolder& out,
                                   const core::Progress& progress = {}, const TellOutcome& tell = {});

}  // namespace morsel::tools::batch
