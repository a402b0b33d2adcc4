#include "morsel/tools/export/export_sink.h"

#include <array>
#include <functional>
#include <span>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/tools/export/complex_file.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/export/surface_file.h"
#include "morsel/tools/formats/csv.h"

namespace morsel::tools {
namespace {

void write_critical_points(const core::FileTarget& target, const core::LoadedMesh& loaded,
                           const MethodOutcome& outcome, std::span<const double> persistence,
                           const Provenance& provenance) {
  core::FileWriter file(target, core::Sync::never);
  file.write("vertex,x,y,z,type,multiplicity,value,persistence,origin,provenance\n");
  const std::vector<morse::CriticalPoint>& critical = outcome.measurement.critical_points.points;
  for (std::size_t i = 0; i < critical.size(); ++i) {
    if (i % 1024 == 0) core::throw_if_stopped();
    const morse::CriticalPoint& point = critical[i];
    file.write_number(std::uint64_t{loaded.source.numbering.input_vertex(point.vertex)});
    for (const double x : loaded.mesh.position(outcome.places[i])) {
      file.write(",");
      file.write_number(x);
    }
    file.write(",");
    file.write(to_string(point.type));
    file.write(",");
    file.write_number(std::uint64_t{point.multiplicity});
    file.write(",");
    file.write_number(outcome.field.value(point.vertex));
    file.write(",");
    file.write_number(persistence[point.vertex]);  // "inf" if it is essential
    file.write(",");
    if (outcome.origins[i] != core::kNone)
      file.write_number(std::uint64_t{loaded.source.numbering.input_vertex(outcome.origins[i])});
    file.write(",");
    if (i == 0) file.write(csv_field(provenance.json()));
    file.write("\n");
  }
  file.commit();
}

}  // namespace

ExportSink::ExportSink(ResultFolder& folder, const core::LoadedMesh& loaded, Provenance provenance)
    : folder_(folder), loaded_(loaded), provenance_(std::move(provenance)) {}

void ExportSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
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
  const SurfaceFile surface{loaded_, field_name_, outcome.field, types, persistence, m.segmentation, chosen};
  Provenance provenance = provenance_.with_method(outcome.steps);
  if (outcome.chosen && outcome.chosen->made.fill) provenance.set_fill(*outcome.chosen->made.fill);
  const core::FileTarget surface_target = folder_.claim(name + ".surface.vtp");
  const core::FileTarget complex_target = folder_.claim(name + ".complex.vtp");
  const core::FileTarget points_target = folder_.claim(name + ".points.csv");
  const std::array<std::function<void()>, 3> writers = {
      [&] { write_surface_file(surface_target, surface, provenance); },
      [&] { write_complex_file(complex_target, loaded_, m.complex, provenance); },
      [&] {
        if (outcome.chosen)
          write_points_table(points_target, outcome.chosen->made, loaded_, field_name_, provenance,
                             core::Sync::never);
        else
          write_critical_points(points_target, loaded_, outcome, persistence, provenance);
      }};
  core::parallel_for(0, writers.size(), 1, [&](std::size_t i, std::size_t) { writers[i](); });
}

}  // namespace morsel::tools
