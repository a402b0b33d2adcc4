#include "morsel/tools/report/segments_writer.h"

#include <vector>

#include "morsel/persistence/diagram.h"
#include "morsel/persistence/pairing.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::kNone;
using mscomplex::NodeKind;

Json merging_section(const MadeSegments& made) {
  return {{"segments_before", made.unmerged},
          {"cancelled_pairs", made.cancelled_pairs},
          {"largest_persistence", made.largest_persistence},
          {"note", made.note}};
}

/// A segment's row with the arrays in it.
class SegmentRows {
 public:
  SegmentRows(const MadeSegments& made, const core::ScalarField& field,
              const core::VertexNumbering& numbering)
      : made_(made),
        field_(field),
        numbering_(numbering),
        persistence_(
            persistence::vertex_persistence(persistence::pair_extrema(field), field.mesh().vertex_count())) {}

  void make(std::size_t i, const TakeRow& take) const {
    const auto s = static_cast<Index>(i);
    const mscomplex::Segment& segment = made_.segments.segments[s];
    const std::span<const Index> saddles = made_.segments.saddles(s);
    const std::span<const mscomplex::SegmentNeighbour> neighbours = made_.segments.neighbours(s);
    const mscomplex::Node minimum = node(segment.minimum);
    const mscomplex::Node top = node(segment.top);
    const bool has_cap = segment.top != kNone && top.kind == NodeKind::cap;
    const Index maximum = has_cap ? kNone : top.vertex;

    struct Point {
      Index vertex;
      std::string_view type;
    };
    const auto point = [&](std::size_t k) -> Point {
      if (minimum.vertex != kNone && k-- == 0) return {minimum.vertex, "minimum"};
      if (k < saddles.size()) return {saddles[k], "saddle"};
      return {maximum, "maximum"};
    };
    const std::size_t points =
        saddles.size() + (minimum.vertex != kNone ? 1 : 0) + (maximum != kNone ? 1 : 0);
    const MakeRow critical_points = [&](std::size_t k, const TakeRow& take_point) {
      const auto [v, type] = point(k);
      take_point({{"vertex", numbering_.input_vertex(v)},
                  {"type", type},
                  {"value", field_.value(v)},
                  {"persistence", persistence_[v]}});
    };
    const MakeRow neighbour_rows = [&](std::size_t k, const TakeRow& take_neighbour) {
      take_neighbour({{"segment", neighbours[k].segment},
                      {"length", neighbours[k].length},
                      {"edges", neighbours[k].edges}});
    };
    take({{"segment", s},
          {"minimum", input_vertex(minimum.vertex)},
          {"maximum", input_vertex(maximum)},
          {"cap", has_cap ? Cell(std::uint64_t{top.cell}) : Cell(nullptr)},
          {"area", segment.area},
          {"triangles", segment.triangles},
          {"vertices", segment.vertices},
          {"boundary_length", segment.boundary_length},
          {"mesh_boundary_length", segment.mesh_boundary_length},
          {"critical_points", NestedRows{points, critical_points}},
          {"neighbours", NestedRows{neighbours.size(), neighbour_rows}}});
  }

 private:
  mscomplex::Node node(Index n) const {
    return n == kNone ? mscomplex::Node{} : made_.hierarchy.complex().node(n);
  }
  Cell input_vertex(Index v) const {
    return v == kNone ? Cell(nullptr) : Cell(std::uint64_t{numbering_.input_vertex(v)});
  }

  const MadeSegments& made_;
  const core::ScalarField& field_;
  const core::VertexNumbering& numbering_;
  std::vector<double> persistence_;
};

}  // namespace

Json request_section(const SegmentsRequest& request) {
  Json asked = {{"field", request.field.field},
                {"method", request.field.method},
                {"by", to_string(request.segments.kind)},
                {"repair", request.build.repair}};
  add_build_options(asked, request.build);
  if (request.field.target) asked["target"] = *request.field.target;
  if (request.segments.segments) asked["segments"] = *request.segments.segments;
  if (request.segments.persistence)
    asked["persistence"] = persistence::to_string(*request.segments.persistence);
  return asked;
}

void write_segments(JsonSink& json, const SegmentsRequest& request, const FieldSource& source,
                    const MadeSegments& made, const Timings& timings) {
  const MadeSegments::Areas areas = made.areas();
  begin_field_document(json, "morsel.segments/1", request_section(request), source);
  json.member("merging", merging_section(made));
  json.member("count", made.segments.count());
  json.member("area", {{"smallest", areas.smallest}, {"median", areas.median}, {"largest", areas.largest}});
  json.begin_array("segments");
  const SegmentRows rows(made, source.made.field(), source.loaded.source.numbering);
  json.rows(made.segments.count(), [&](std::size_t i, const TakeRow& take) { rows.make(i, take); });
  json.end_array();
  json.member("timings", timings_section(timings));
  json.end_object();
}

}  // namespace morsel::tools
