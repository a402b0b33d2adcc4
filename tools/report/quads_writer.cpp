#include "morsel/tools/report/quads_writer.h"

#include <utility>

#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

Json quality_section(const mscomplex::QuadQuality& q) {
  Json valence = Json::array();
  for (std::size_t k = 0; k < q.valence.size(); ++k)
    if (q.valence[k] > 0) valence.push_back({{"valence", k}, {"vertices", q.valence[k]}});
  return {
      {"extraordinary_vertices", q.extraordinary},
      {"valences", std::move(valence)},
      {"angle", {{"mean", q.angle_mean}, {"max", q.angle_max}}},
      {"scaled_jacobian", {{"mean", q.scaled_jacobian_mean}, {"min", q.scaled_jacobian_min}}},
      {"concave_quads", q.concave},
      {"area",
       {{"mean", q.area_mean}, {"deviation", q.area_deviation}, {"min", q.area_min}, {"max", q.area_max}}},
      {"distance",
       {{"max", q.distance_max}, {"mean", q.distance_mean}, {"max_from_input", q.distance_from_input}}}};
}

}  // namespace

Json request_section(const QuadsRequest& asked) {
  Json section = {{"field", asked.field.field},
                  {"method", asked.field.method},
                  {"repair", asked.build.repair},
                  {"resolution", asked.quads.resolution},
                  {"relaxation", asked.quads.relaxation}};
  add_build_options(section, asked.build);
  if (asked.field.target) section["target"] = *asked.field.target;
  if (!asked.quads.persistence.empty()) section["persistence"] = asked.quads.persistence;
  return section;
}

void write_quads(JsonSink& json, const QuadsRequest& request, const FieldSource& source,
                 const Quadrangulation& result, const Timings& timings) {
  const core::VertexNumbering& numbering = source.loaded.source.numbering;
  const mscomplex::MorseSmaleComplex& complex = result.repaired.complex;
  const auto vertex_of = [&](core::Index node) {
    return std::uint64_t{numbering.input_vertex(complex.node(node).vertex)};
  };
  begin_field_document(json, "morsel.quads/1", request_section(request), source);
  json.member("simplification", {{"threshold", result.threshold}, {"cancelled_pairs", result.cancelled}});
  json.begin_array("repairs");
  for (const mscomplex::DanglingRepair& r : result.repaired.repairs)
    json.row({{"problem", "dangling arc"},
              {"cancelled", r.kind == mscomplex::NodeKind::minimum ? "minimum" : "maximum"},
              {"vertex", std::uint64_t{numbering.input_vertex(r.vertex)}},
              {"saddle", std::uint64_t{numbering.input_vertex(r.saddle_vertex)}},
              {"persistence", r.persistence}});
  json.end_array();
  json.member("layout", {{"minima", complex.minimum_count()},
                         {"saddles", complex.saddle_count()},
                         {"maxima", complex.maximum_count()},
                         {"arcs", complex.arc_count()},
                         {"patches", complex.quad_count()},
                         {"boundary_patches", boundary_patches(complex)},
                         {"arcs_by_fewest_triangles", result.layout.missed},
                         {"nodes_left", result.layout.left}});
  json.member("quads", {{"vertices", result.mesh.positions.size()}, {"quads", result.mesh.quads.size()}});
  json.member("quality", quality_section(result.quality));
  json.begin_array("patches");
  for (core::Index q = 0; q < complex.quad_count(); ++q) {
    const mscomplex::Quad quad = complex.quad(q);
    const mscomplex::PatchQuality& quality = result.quality.patches[q];
    json.row({{"patch", std::uint64_t{q}},
              {"sides", std::uint64_t{complex.kind(quad.nodes[2]) == mscomplex::NodeKind::cap ? 5u : 4u}},
              {"minimum", vertex_of(quad.nodes[0])},
              {"saddle", vertex_of(quad.nodes[1])},
              {"maximum", vertex_of(quad.nodes[2])},
              {"other_saddle", vertex_of(quad.nodes[3])},
              {"area", quality.area},
              {"angle_mean", quality.angle_mean},
              {"scaled_jacobian_min", quality.scaled_jacobian_min}});
  }
  json.end_array();
  json.member("timings", timings_section(timings));
  json.end_object();
}

}  // namespace morsel::tools
