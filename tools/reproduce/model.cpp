#include "morsel/tools/reproduce/outcome.h"

#include "morsel/tools/report/hashed_mesh.h"

namespace morsel::tools::reproduce {

Model::Model(const ModelRecipe& recipe, MeshFile file, core::LoadedMesh loaded, std::string sha256)
    : recipe_(recipe),
      file_(std::move(file)),
      loaded_(std::move(loaded)),
      sha256_(std::move(sha256)),
      studio_(loaded_.mesh) {}

Model Model::read(const ModelRecipe& recipe, const MeshFile& file, bool repair,
                  const core::Progress& progress) {
  HashedMesh mesh = read_hashed_mesh(file.path, {.repair = repair}, progress);
  return {recipe, file, std::move(mesh.loaded), std::move(mesh.sha256)};
}

const MethodRun& Model::run(const std::string& method, const core::Progress& progress) {
  std::unique_ptr<const MethodRun>& run = runs_[method];
  if (run) return *run;
  FieldPlan plan = prepare(FieldRequest{std::string(kField), method, {}});
  MadeField made = make_field(plan, loaded_, progress);
  Timings timings;
  Measurement measurement = measure(made.field(), timings, progress);
  const double seconds =
      made.method_seconds + timings.front().second;  // the first step is the classification
  run = std::make_unique<const MethodRun>(
      MethodRun{std::move(plan), std::move(made), std::move(measurement), seconds});
  return *run;
}

}  // namespace morsel::tools::reproduce
