#include "morsel/tools/batch/batch.h"

#include <set>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/tools/batch/scheduler.h"
#include "morsel/tools/export/folder.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

void remove_whole(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw core::WriteFailed("cannot remove " + path.string() + ": " + error.message());
}

void put(const fs::path& from, const fs::path& to) {
  make_folder(to.parent_path());
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw core::WriteFailed("cannot write " + to.string() + ": " + error.message());
}

class Run {
 public:
  Run(const BatchRequest& request, const RunOptions& options, const OutFolder& out, const TellOutcome& tell)
      : request_(request), options_(options), out_(out), tell_(tell) {}
  /// What was in work when an error or a stop came up leaves nothing behind.
  ~Run() {
    std::error_code error;
    for (const std::string& name : in_work_) fs::remove_all(out_.work(name), error);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  std::vector<MeshOutcome> run(const std::vector<CollectionMesh>& meshes, const core::Progress& progress) {
    look(meshes, progress);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < outcomes_.size(); ++i)
      if (outcomes_[i].status == Status::not_run) open.push_back(i);
    if (!options_.run) return std::move(outcomes_);
    run_children({open.size(), [&](std::size_t i) { return begin(outcomes_[open[i]]); },
                  [&](std::size_t i, const ChildEnd& end) { finish(outcomes_[open[i]], end); }},
                 options_.jobs, options_.limits, options_.stop, progress);
    return std::move(outcomes_);
  }

 private:
  /// Which meshes are settled. Reads every mesh, for its hash.
  void look(const std::vector<CollectionMesh>& meshes, const core::Progress& progress) {
    const Json common = common_key(request_);
    outcomes_.resize(meshes.size());
    core::parallel_for(0, meshes.size(), 1, [&](std::size_t i, std::size_t) {
      progress.throw_if_cancelled();
      MeshOutcome& outcome = outcomes_[i];
      outcome.mesh = meshes[i];
      Json key = mesh_key(common, meshes[i].path);
      outcome.sha256 = key["sha256"];
      std::optional<MeshState> state = read_state(out_.state(meshes[i].name));
      if (state && !(state->error && options_.retry && options_.run) &&
          is_settled(*state, key, options_.limits, out_, meshes[i].name)) {
        outcome.state = std::move(*state);
        outcome.status = outcome.state.error ? Status::failed : Status::done;
        outcome.was_settled = true;
      }
      outcome.state.key = std::move(key);
    });
  }

  std::vector<std::string> begin(MeshOutcome& outcome) {
    const std::string& name = outcome.mesh.name;
    in_work_.insert(name);
    const fs::path work = out_.work(name);
    remove_whole(work);
    make_folder(work);
    std::vector<std::string> words = {"/proc/self/exe"};
    for (std::string& word : compare_words(request_, outcome.mesh.path, work / "report.json",
                                           work / "thumbnail", options_.threads))
      words.push_back(std::move(word));
    return words;
  }

  void finish(MeshOutcome& outcome, const ChildEnd& end) {
    const std::string& name = outcome.mesh.name;
    const fs::path work = out_.work(name);
    MeshState& state = outcome.state;
    state.seconds = end.seconds;
    state.limits = options_.limits;
    state.error = error_of(end, options_.limits);
    if (!state.error) {
      take_result(work / "report.json", state);
      state.key["sha256"] =
          state.result.at("mesh").at("sha256");  // of what was read, should it have changed since
      outcome.sha256 = state.key["sha256"];
    }
    remove_whole(out_.state(name));  // it says nothing of the files that come
    remove_whole(out_.report(name));
    for (const char* which : {"first", "last"}) remove_whole(out_.thumbnail(name, which));
    if (!state.error) {
      put(work / "report.json", out_.report(name));
      if (request_.thumbnails)
        for (const std::string which : {"first", "last"})
          put(work / ("thumbnail." + which + ".png"), out_.thumbnail(name, which));
    }
    write_state(out_.state(name), state);
    remove_whole(work);
    in_work_.erase(name);
    outcome.status = state.error ? Status::failed : Status::done;
    if (tell_) tell_(outcome);
  }

  const BatchRequest& request_;
  const RunOptions& options_;
  const OutFolder& out_;
  const TellOutcome& tell_;
  std::vector<MeshOutcome> outcomes_;
  std::set<std::string> in_work_;
};

}  // namespace

std::vector<MeshOutcome> run_batch(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                   const RunOptions& options, const OutFolder& out,
                                   const core::Progress& progress, const TellOutcome& tell) {
  static_cast<void>(prepare(request.comparison));
  make_folder(out.root());
  return Run(request, options, out, tell).run(meshes, progress);
}

}  // namespace morsel::tools::batch
