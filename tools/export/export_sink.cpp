#include "morsel/tools/export/export_sink.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/tools/color/surface_colors.h"
#include "morsel/tools/export/complex_file.h"
#include "morsel/tools/export/glb_scene.h"
#include "morsel/tools/export/graphml_file.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/export/surface_file.h"
#include "morsel/tools/formats/csv.h"

namespace morsel::tools {
namespace {

void write_critical_points(const core::FileTarget& target, const core::LoadedMesh& loaded,
                           const MethodOutcome& outcome, std::span<const double> persistence,
                           const Provenance& provenance) {
  core::FileWriter file(target, core::Sync::never);
  CsvTable table(file.stream(), {"vertex", "x", "y", "z", "type", "type_code", "multiplicity", "value",
                                 "persistence", "origin"});
  const auto input_vertex = [&](core::Index v) {
    return std::uint64_t{loaded.source.numbering.input_vertex(v)};
  };
  const std::vector<morse::CriticalPoint>& critical = outcome.measurement.critical_points.points;
  for (std::size_t i = 0; i < critical.size(); ++i) {
    if (i % 1024 == 0) core::throw_if_stopped();
    const morse::CriticalPoint& point = critical[i];
    CsvLine line;
    line.add(input_vertex(point.vertex));
    for (const double x : loaded.mesh.position(outcome.places[i])) line.add(x);
    line.add(to_string(point.type));
    line.add(std::uint64_t{static_cast<std::uint8_t>(point.type)});
    line.add(std::uint64_t{point.multiplicity});
    line.add(outcome.field.value(point.vertex));
    line.add(persistence[point.vertex]);  // "inf" if it is essential
    outcome.origins[i] != core::kNone ? line.add(input_vertex(outcome.origins[i])) : line.add("");
    table.add(line);
  }
  table.end(provenance.lines());
  file.commit();
}

void write_scene(const core::FileTarget& target, const core::LoadedMesh& loaded, const MethodOutcome& outcome,
                 const Provenance& provenance) {
  GlbScene scene(loaded.mesh);
  const std::vector<SceneMark> marks = marks_of(outcome.shown_points(), outcome.shown_places());
  scene.add_surface(value_colors(outcome.field.values()));
  scene.add_marks(marks);
  scene.add_arcs(outcome.measurement.complex, marks.size());
  scene.write(target, provenance, core::Sync::never);
}

}  // namespace

ExportSink::ExportSink(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance,
                       bool writes_glb)
    : folder_(folder), loaded_(loaded), provenance_(std::move(provenance)), writes_glb_(writes_glb) {}

void ExportSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  original_ = outcome.field;
  provenance_.set_field(outcome);
}

void ExportSink::method(const MethodOutcome& outcome) {
  const std::string name = names_.next(outcome.name);
  const std::vector<double> persistence =
      persistence::vertex_persistence(outcome.measurement.diagram, loaded_.mesh.vertex_count());
  const Measurement& m = outcome.measurement;
  std::vector<std::uint8_t> types(loaded_.mesh.vertex_count(), 0);
  for (const morse::CriticalPoint& point : outcome.shown_points().points)
    types[point.vertex] = static_cast<std::uint8_t>(point.type);
  std::vector<std::int32_t> chosen;
  if (outcome.chosen) chosen = chosen_order(outcome.chosen->made, loaded_.mesh.vertex_count());
  const SurfaceFile surface{loaded_, field_name_, outcome.field,  *original_,
                            types,   persistence, m.segmentation, chosen};
  const ComplexFile complex{loaded_, m.complex, field_name_, outcome.field, persistence};
  Provenance provenance = provenance_.with_method(outcome.steps);
  if (outcome.chosen && outcome.chosen->made.fill) provenance.set_fill(*outcome.chosen->made.fill);
  const core::FileTarget surface_target = folder_.claim(name + ".surface.vtp");
  const core::FileTarget complex_target = folder_.claim(name + ".complex.vtp");
  const core::FileTarget nodes_target = folder_.claim(name + ".nodes.vtp");
  const core::FileTarget graph_target = folder_.claim(name + ".complex.graphml");
  const core::FileTarget points_target = folder_.claim(name + ".points.csv");
  std::vector<std::function<void()>> writers = {
      [&] { write_surface_file(surface_target, surface, provenance); },
      [&] { write_complex_file(complex_target, complex, provenance); },
      [&] { write_nodes_file(nodes_target, complex, provenance); },
      [&] { write_graphml_file(graph_target, complex, provenance); },
      [&] {
        if (outcome.chosen)
          write_points_table(points_target, outcome.chosen->made, loaded_, field_name_, provenance,
                             core::Sync::never);
        else
          write_critical_points(points_target, loaded_, outcome, persistence, provenance);
      }};
  if (writes_glb_)
    writers.emplace_back(
        [&, target = folder_.claim(name + ".glb")] { write_scene(target, loaded_, outcome, provenance); });
  core::parallel_for(0, writers.size(), 1, [&](std::size_t i, std::size_t) { writers[i](); });
}

}  // namespace morsel::tools
