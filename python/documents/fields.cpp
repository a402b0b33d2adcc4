/// Fields, segments and chosen points as files and documents.

#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/persistence/threshold.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/documents/module.h"
#include "morsel/python/documents/source.h"
#include "morsel/tools/export/field_file.h"
#include "morsel/tools/export/label_file.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/report/points_writer.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/report/segments_writer.h"

namespace morsel::python {
namespace {

/// .txt, .ply, .vtp or .glb.
void write_field(const FieldHandle& field, const std::string& path, const tools::Registry& registry,
                 const py::object& report) {
  tools::check_field_path(path);
  run_job(report, [&](const core::Progress& progress) {
    const DocumentField source(field, {path}, registry, progress);
    const DocumentMesh& mesh = source.mesh();
    tools::write_field(path, source.source(), mesh.input_positions(progress),
                       source.provenance("field", {}, tools::request_section(source.request(), mesh.repair)));
  });
}

/// The words of the command line of a request.
std::vector<std::string> words_of(const tools::SegmentRequest& request) {
  std::vector<std::string> words = {"--by", mscomplex::to_string(request.kind)};
  if (request.segments) tools::add_option(words, "--segments", std::to_string(*request.segments));
  if (request.persistence)
    tools::add_option(words, "--persistence", persistence::to_string(*request.persistence));
  return words;
}

/// .json: the table of the segments; .ply, .vtp, .txt, .glb: the labels.
void write_segments(const SegmentsHandle& segments, const std::string& path,
                    const std::optional<std::string>& mesh_file, const tools::Registry& registry,
                    const py::object& report) {
  const bool is_document = core::file_extension(path) == ".json";
  if (!is_document) tools::label_files(path);  // refuses other endings
  run_job(report, [&](const core::Progress& progress) {
    const DocumentField source(segments->field, {path, mesh_file}, registry, progress);
    const DocumentMesh& mesh = source.mesh();
    const tools::SegmentsRequest request{source.request(), segments->request, mesh.repair};
    if (is_document)
      return write_document(path, [&](tools::JsonSink& json) {
        tools::write_segments(json, request, source.source(), segments->made, {});
      });
    const mscomplex::Segments& made = segments->made.segments;
    tools::write_labels(
        path, {"segment", made.vertex, made.triangle}, *segments->field->field, source.made().input.name,
        mesh.loaded.source.numbering, mesh.input_positions(progress),
        source.provenance("segment", words_of(segments->request), tools::request_section(request)));
  });
}

/// Of `morsel points`, which fills up unless it is told not to.
std::vector<std::string> points_words(const tools::PointsRequest& request) {
  std::vector<std::string> words = tools::words_of(request);
  if (!request.fill) tools::add_option(words, "--fill", "none");
  return words;
}

bool are_in_place(const tools::MadePoints& made) {
  return std::ranges::equal(made.places, made.chosen.points, {}, {},
                            [](const morse::ChosenPoint& point) { return point.candidate.point.vertex; });
}

/// .json, .csv, .ply, .vtp or .glb.
void write_points(const PointsHandle& points, const std::string& path,
                  const std::optional<std::string>& mesh_file, const tools::Registry& registry,
                  const py::object& report) {
  const bool is_document = core::file_extension(path) == ".json";
  if (!is_document) tools::check_points_path(path);
  if (!are_in_place(*points->made))
    throw core::InvalidArgument(
        "points that are reported at their origins are in the files of their comparison, not in one of their "
        "own");
  run_job(report, [&](const core::Progress& progress) {
    const DocumentField source(points->field, {path, mesh_file}, registry, progress);
    const DocumentMesh& mesh = source.mesh();
    const tools::Json request = tools::request_section(source.request(), points->request, mesh.repair);
    if (is_document)
      return write_document(path, [&](tools::JsonSink& json) {
        tools::write_points_document(json, request, source.source(), *points->made, {});
      });
    tools::Provenance provenance = source.provenance("points", points_words(points->request), request);
    if (points->made->fill) provenance.set_fill(*points->made->fill);
    tools::write_points(path, *points->made, source.source(), provenance);
  });
}

}  // namespace

void add_field_documents(py::module_& m) {
  m.def("write_field", &write_field);
  m.def("write_segments", &write_segments);
  m.def("write_points", &write_points);
}

}  // namespace morsel::python
