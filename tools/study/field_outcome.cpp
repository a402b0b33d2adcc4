#include "morsel/tools/study/field_outcome.h"

#include <algorithm>
#include <utility>

#include "morsel/morse/critical_points.h"
#include "morsel/tools/study/stopwatch.h"

namespace morsel::tools {
namespace {

/// Says so if most critical points come from the order of vertex numbers alone; else empty.
std::string plateau_warning(const core::ScalarField& field, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const auto is_flat = [&](core::Index e) {
    const auto [a, b] = mesh.edge_vertices(e);
    return field.value(a) == field.value(b);
  };
  std::vector<bool> tied(mesh.vertex_count(), false);
  bool any = false;
  for (core::Index e = 0; e < mesh.edge_count(); ++e) {
    if (!is_flat(e)) continue;
    const auto [a, b] = mesh.edge_vertices(e);
    tied[a] = tied[b] = any = true;
  }
  if (!any) return {};
  const std::vector<morse::CriticalPoint> points = morse::classify(field, progress).points;
  const auto by_number = static_cast<std::size_t>(
      std::ranges::count_if(points, [&](const morse::CriticalPoint& point) { return tied[point.vertex]; }));
  if (field.extent() == 0)
    return "the field is constant: its " + std::to_string(points.size()) +
           " critical points come from the order of vertex numbers alone";
  if (2 * by_number <= points.size()) return {};
  return std::to_string(by_number) + " of the field's " + std::to_string(points.size()) +
         " critical points have a neighbour of the same value: which vertices they are, and how many, "
         "depends on "
         "the order of vertex numbers";
}

}  // namespace

FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress) {
  const Stopwatch watch;
  core::FunctionResult result = function.function->evaluate(loaded.mesh, {&loaded.source, progress});
  std::vector<std::string> warnings = std::move(result.warnings);
  if (std::string text = plateau_warning(result.field, progress.unreported()); !text.empty())
    warnings.push_back(std::move(text));
  return {function.name,  std::move(result.field), std::move(result.parameters), watch.seconds(),
          function.files, function.unit,           std::move(warnings)};
}

}  // namespace morsel::tools
