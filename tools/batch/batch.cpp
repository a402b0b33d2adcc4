#include "morsel/tools/batch/batch.h"

#include <optional>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/tools/batch/out_folder.h"
#include "morsel/tools/batch/scheduler.h"
#include "morsel/tools/export/folder.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

class Run {
 public:
  Run(const BatchRequest& request, const RunOptions& options, const OutFolder& out, const TellOutcome& tell)
      : request_(request), options_(options), out_(out), tell_(tell) {}
  std::vector<MeshOutcome> run(const std::vector<CollectionMesh>& meshes, const core::Progress& progress) {
    look(meshes, progress);
    if (!options_.run) return std::move(outcomes_);
    remove_left_work(out_);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < outcomes_.size(); ++i)
      if (outcomes_[i].status == Status::not_run) open.push_back(i);
    if (open.empty()) return std::move(outcomes_);
    const WorkFolder work(out_);
    const auto place = [&](std::size_t i) { return work.path() / std::to_string(i); };
    run_children({open.size(), [&](std::size_t i) { return begin(outcomes_[open[i]], place(i)); },
                  [&](std::size_t i, const ChildEnd& end) { finish(outcomes_[open[i]], place(i), end); }},
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
      std::optional<MeshState> state = known_state(outcome);
      if (state && !(state->error && options_.retry && options_.run) &&
          is_settled(*state, key, options_.limits, products_of(meshes[i].name, request_, out_))) {
        outcome.state = std::move(*state);
        outcome.status = outcome.state.error ? Status::failed : Status::done;
        outcome.was_settled = true;
      }
      outcome.state.key = std::move(key);
    });
  }

  /// A damaged one counts as none.
  std::optional<MeshState> known_state(MeshOutcome& outcome) const {
    try {
      return read_state(out_.state(outcome.mesh.name));
    } catch (const core::BadInput& error) {
      outcome.state_damage = error.what();
      return std::nullopt;
    }
  }

  std::vector<std::string> begin(const MeshOutcome& outcome, const fs::path& work) const {
    make_folder(work);
    std::vector<std::string> words = {"/proc/self/exe"};
    for (std::string& word : compare_words(request_, outcome.mesh, work, out_, options_.threads))
      words.push_back(std::move(word));
    return words;
  }

  void finish(MeshOutcome& outcome, const fs::path& work, const ChildEnd& end) const {
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
    publish(outcome.mesh.name, work, state);
    std::error_code error;
    fs::remove_all(work, error);
    outcome.status = state.error ? Status::failed : Status::done;
    if (tell_) tell_(outcome);
  }

  /// Puts what was made in the place of what was there. Whenever this is broken off, the state's absence says so; and runs that
  /// make the same mesh's things, perhaps with other options, do not mix them.
  void publish(const std::string& name, const fs::path& work, MeshState& state) const {
    const std::vector<Product> products = products_of(name, request_, out_);
    if (!state.error) state.files = made_files(products, work);
    write_state(work / "state.json", state);
    const std::optional<FileLock> alone = FileLock::take(out_.lock(), FileLock::Wait::yes);
    put_aside(out_.state(name), work / "old" / "state.json");  // it says nothing of the files that come
    for (const Product& product : products) {
      put_aside(product.place, work / "old" / product.made);
      if (product.wanted && !state.error) put(work / product.made, product.place);
    }
    put(work / "state.json", out_.state(name));
  }

  const BatchRequest& request_;
  const RunOptions& options_;
  const OutFolder& out_;
  const TellOutcome& tell_;
  std::vector<MeshOutcome> outcomes_;
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
