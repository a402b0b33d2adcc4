#include "morsel/tools/report/cut_writer.h"

#include "morsel/core/parallel/stop.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

void write_components(JsonSink& json, const std::vector<ComponentCut>& components) {
  json.begin_array("components");
  for (const ComponentCut& part : components)
    json.row({{"vertices", std::uint64_t{part.vertices}},
              {"genus", std::uint64_t{part.genus}},
              {"boundary_loops", std::uint64_t{part.loops}},
              {"paths", std::uint64_t{part.paths}},
              {"length_found", part.length_found},
              {"length", part.length},
              {"copies", std::uint64_t{part.copies}}});
  json.end_array();
}

void write_paths(JsonSink& json, const mscomplex::CutGraph& cut, const core::VertexNumbering& numbering) {
  json.begin_array("paths");
  for (const mscomplex::CutPath& path : cut.paths) {
    core::throw_if_stopped();
    Json vertices = Json::array();
    for (const core::Index v : path.vertices) vertices.push_back(numbering.input_vertex(v));
    json.begin_object();
    json.member("component", path.component);
    json.member("length", path.length);
    json.member("vertices", vertices);
    json.end_object();
  }
  json.end_array();
}

void write_output(JsonSink& json, const mscomplex::CutMesh& opened, const core::VertexNumbering& numbering) {
  const auto numbers = [&](core::Index first, core::Index last) {
    Json list = Json::array();
    for (core::Index v = first; v < last; ++v) list.push_back(numbering.input_vertex(opened.original(v)));
    return list;
  };
  json.begin_object("output");
  json.member("vertices", opened.mesh.vertex_count());
  json.member("faces", opened.mesh.triangle_count());
  json.member("first_copy", opened.original_count());
  json.member("copied", numbers(opened.original_count(), opened.mesh.vertex_count()));
  if (!numbering.to_input.empty()) json.member("input_vertices", numbers(0, opened.original_count()));
  json.end_object();
}

}  // namespace

Json request_section(const CutRequest& request) {
  Json section = {{"field", request.field.field},
                  {"method", request.field.method},
                  {"shorten", request.shorten},
                  {"repair", request.build.repair}};
  add_build_options(section, request.build);
  if (request.field.target) section["target"] = *request.field.target;
  return section;
}

void write_cut_document(JsonSink& json, const CutRequest& request, const FieldSource& source,
                        const CutOutcome& outcome, const Timings& timings) {
  const core::VertexNumbering& numbering = source.loaded.source.numbering;
  begin_field_document(json, "morsel.cut/1", request_section(request), source);
  json.begin_object("cut");
  json.member("length_found", outcome.length_found);
  json.member("length", outcome.cut.length);
  json.member("edges", outcome.cut.edges.size());
  if (request.shorten)
    json.member(
        "shortening",
        {{"attempts", outcome.attempts}, {"replaced", outcome.replaced}, {"settled", outcome.is_settled}});
  write_components(json, outcome.components);
  write_paths(json, outcome.cut, numbering);
  json.end_object();
  write_output(json, outcome.opened, numbering);
  json.member("timings", timings_section(timings));
  json.end_object();
}

}  // namespace morsel::tools
