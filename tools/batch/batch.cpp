#include "morsel/tools/batch/batch.h"

#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/batch/out_folder.h"
#include "morsel/tools/batch/scheduler.h"
#include "morsel/tools/formats/command_line.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

constexpr int kWriteFailedCode = 4;  // of the program

/// Of a mesh whose results can have no file here: it fails in every run without being started.
MeshError no_place(const std::string& reason) {
  ChildEnd end;
  end.exit_code = kWriteFailedCode;
  end.message = reason;
  return *error_of(end, {});
}

/// A damaged state counts as none.
std::optional<MeshState> known_state(const OutFolder& out, MeshOutcome& outcome) {
  try {
    return read_state(out.state(outcome.mesh.name));
  } catch (const core::BadInput& error) {
    outcome.state_damage = error.what();
    return std::nullopt;
  }
}

class Run {
 public:
  Run(const BatchRequest& request, const RunOptions& options, ResultFolder& results, const TellOutcome& tell)
      : request_(request), options_(options), results_(results), out_(results.path()), tell_(tell) {}
  std::vector<MeshOutcome> run(const std::vector<CollectionMesh>& meshes, const core::Progress& progress) {
    results_.remove_left_work(OutFolder().work());
    outcomes_ = look_at(meshes, request_, options_, out_, progress);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
      MeshOutcome& outcome = outcomes_[i];
      if (outcome.status == Status::failed && outcome.was_settled && options_.retry) start_anew(outcome);
      if (outcome.status == Status::not_run) open.push_back(i);
      if (outcome.status == Status::failed && !outcome.was_settled && tell_) tell_(outcome);
    }
    check_places(open);
    if (open.empty()) return std::move(outcomes_);
    const ResultFolder::Work work(results_, OutFolder().work());
    const auto place = [&](std::size_t i) { return work.relative() / std::to_string(i); };
    run_children({open.size(), [&](std::size_t i) { return begin(outcomes_[open[i]], place(i)); },
                  [&](std::size_t i, const ChildEnd& end) { finish(outcomes_[open[i]], place(i), end); }},
                 options_.jobs, options_.limits, options_.stop, progress);
    return std::move(outcomes_);
  }

 private:
  static void start_anew(MeshOutcome& outcome) {
    outcome.status = Status::not_run;
    outcome.was_settled = false;
    outcome.state.error.reset();
  }

  void check_places(const std::vector<std::size_t>& open) {
    const ResultFolder::Hold hold(results_);
    for (const std::size_t i : open) {
      const std::string& name = outcomes_[i].mesh.name;
      results_.check_free(OutFolder().state(name));
      for (const Product& product : products_of(name, request_, OutFolder())) {
        if (product.wanted && product.is_folder) results_.check_folder(product.place);
        if (product.wanted && !product.is_folder) results_.check_free(product.place);
      }
    }
  }

  std::vector<std::string> begin(const MeshOutcome& outcome, const fs::path& work) const {
    const fs::path folder = results_.path() / work;
    std::error_code error;
    if (!fs::create_directory(folder, error) && error)
      throw core::WriteFailed("cannot make the folder " + folder.string() + ": " + error.message());
    std::vector<std::string> words = {"/proc/self/exe"};
    add_words(words, compare_words(request_, outcome.mesh, folder, out_, options_.threads));
    return words;
  }

  void finish(MeshOutcome& outcome, const fs::path& work, const ChildEnd& end) {
    MeshState& state = outcome.state;
    state.seconds = end.seconds;
    state.limits = options_.limits;
    state.error = error_of(end, options_.limits);
    if (!state.error) {
      take_result(results_.path() / work / "report.json", state);
      state.key["sha256"] = state.result.at("mesh").at("sha256");  // of the bytes that were read
      outcome.sha256 = state.key["sha256"];
    }
    publish(outcome.mesh.name, work, state);
    results_.remove_work(work);
    outcome.status = state.error ? Status::failed : Status::done;
    if (tell_) tell_(outcome);
  }

  /// Replaces the earlier files of a mesh by the new ones. If this is interrupted, the state is missing; and
  /// runs that make files of the same mesh, perhaps with other options, do not mix them.
  void publish(const std::string& name, const fs::path& work, MeshState& state) {
    const std::vector<Product> products = products_of(name, request_, OutFolder());
    if (!state.error) state.files = made_files(products, results_.path() / work);
    write_state(results_.path() / work / "state.json", state);
    const fs::path state_place = OutFolder().state(name);
    const ResultFolder::Hold hold(results_);
    results_.remove(state_place);  // it does not describe the new files
    std::set<fs::path> made;
    for (const std::string& file : state.files) {
      const fs::path place = place_of(file, products);
      results_.move(work / file, place);
      made.insert(place);
    }
    for (const Product& product : products) {
      std::vector<std::string> before =
          product.is_folder ? results_.files_in(product.place) : std::vector{product.place.string()};
      for (const std::string& file : before)
        if (!made.contains(file)) results_.remove(file);
    }
    results_.move(work / "state.json", state_place);
  }

  const BatchRequest& request_;
  const RunOptions& options_;
  ResultFolder& results_;
  const OutFolder out_;
  const TellOutcome& tell_;
  std::vector<MeshOutcome> outcomes_;
};

}  // namespace

std::vector<MeshOutcome> look_at(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                 const RunOptions& options, const OutFolder& out,
                                 const core::Progress& progress) {
  static_cast<void>(prepare(request.comparison));
  const Json common = common_key(request);
  std::vector<MeshOutcome> outcomes(meshes.size());
  core::parallel_for(0, meshes.size(), 1, [&](std::size_t i, std::size_t) {
    progress.throw_if_cancelled();
    MeshOutcome& outcome = outcomes[i];
    outcome.mesh = meshes[i];
    Json key = mesh_key(common, meshes[i].path);  // reads the mesh, for its hash
    outcome.sha256 = key["sha256"];
    if (const std::string reason = out.refusal(meshes[i].name); !reason.empty()) {
      outcome.status = Status::failed;
      outcome.state.error = no_place(reason);
      outcome.state.limits = options.limits;
    } else if (std::optional<MeshState> state = known_state(out, outcome);
               state && is_settled(*state, key, options.limits, products_of(meshes[i].name, request, out))) {
      outcome.state = std::move(*state);
      outcome.status = outcome.state.error ? Status::failed : Status::done;
      outcome.was_settled = true;
    }
    outcome.state.key = std::move(key);
  });
  return outcomes;
}

std::vector<MeshOutcome> run_batch(const std::vector<CollectionMesh>& meshes, const BatchRequest& request,
                                   const RunOptions& options, ResultFolder& out,
                                   const core::Progress& progress, const TellOutcome& tell) {
  return Run(request, options, out, tell).run(meshes, progress);
}

}  // namespace morsel::tools::batch
