#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/reproduce/outcome.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools::reproduce {

Model::Model(const ModelRecipe& recipe, MeshFile file, HashedMesh mesh)
    : recipe_(recipe),
      file_(std::move(file)),
      loaded_(std::move(mesh.loaded)),
      sha256_(std::move(mesh.sha256)),
      studio_(loaded_.mesh) {}

Model Model::read(const ModelRecipe& recipe, const MeshFile& file, const core::BuildOptions& build,
                  const core::Progress& progress) {
  return {recipe, file, read_hashed_mesh(file.path, build, progress)};
}

Model Model::make(const ModelRecipe& recipe, const MeshFile& file, const core::FileTarget& target,
                  const std::vector<std::string>& comments) {
  core::write_off(target, recipe.make(), comments);
  return {recipe, file, read_hashed_mesh(target.path)};
}

const MethodRun& Model::run(const RunName& name, const core::Progress& progress) {
  std::unique_ptr<const MethodRun>& run = runs_[name];
  if (run) return *run;
  FieldPlan plan = prepare(FieldRequest{name.first, name.second, {}});
  MadeField made = make_field(plan, loaded_, progress);
  Timings timings;
  Measurement measurement = measure(made.field(), timings, progress);
  const double seconds =
      made.method_seconds + timings.front().second;  // the first step is the classification
  run = std::make_unique<const MethodRun>(
      MethodRun{std::move(plan), std::move(made), std::move(measurement), seconds});
  return *run;
}

std::optional<double> Model::percentile(std::span<const core::Index> points, const core::Progress& progress) {
  if (points.empty()) return std::nullopt;
  if (percentiles_.empty()) percentiles_ = saliency_percentiles(mesh(), progress);
  double sum = 0;
  for (const core::Index v : points) sum += percentiles_[v];
  return sum / static_cast<double>(points.size());
}

std::vector<core::Index> extrema_of(const MethodRun& run) {
  std::vector<core::Index> extrema;
  for (const morse::CriticalPoint& point : run.measurement.critical_points.points)
    if (point.type != morse::CriticalType::saddle) extrema.push_back(point.vertex);
  return extrema;
}

}  // namespace morsel::tools::reproduce
