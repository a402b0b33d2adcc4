#include "morsel/tools/report/hierarchy_writer.h"

#include <span>
#include <vector>

#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

using core::Index;
using mscomplex::NodeKind;

Cell number(Index i) { return i == core::kNone ? Cell(nullptr) : Cell(std::uint64_t{i}); }

/// An overlap as members of a row: the other cell, the area shared with it, and its share of this
/// cell's area.
struct SharedCells {
  Cell other = nullptr;
  Cell area = nullptr;
  Cell share = nullptr;

  SharedCells(const mscomplex::Overlap& overlap, double whole) {
    if (overlap.segment == core::kNone) return;
    other = number(overlap.segment);
    area = overlap.area;
    if (whole > 0) share = overlap.area / whole;
  }
};

}  // namespace

Json request_section(const HierarchyRequest& request, const ReportInput& input) {
  Json asked = {{"field", request.field.field},
                {"method", request.field.method},
                {"by", to_string(request.kind)},
                {"repair", input.build.repair}};
  add_build_options(asked, input.build);
  if (!input.items) asked["items"] = false;
  if (!request.levels.empty()) asked["levels"] = request.levels;
  if (!request.counts.empty()) asked["counts"] = request.counts;
  if (request.field.target) asked["target"] = *request.field.target;
  return asked;
}

HierarchyWriter::HierarchyWriter(JsonSink& json, const core::LoadedMesh& loaded, const ReportInput& input,
                                 const HierarchyRequest& request, const HierarchyPlan& plan)
    : json_(json),
      loaded_(loaded),
      plan_(plan),
      items_(input.items),
      timings_({{"load", input.load_seconds}}) {
  json_.begin_object();
  json_.member("schema", "morsel.hierarchy/1");
  json_.member("tool", tool_section());
  json_.member("request", request_section(request, input));
  json_.member("mesh", mesh_section(input.mesh_path, input.mesh_sha256, loaded));
}

void HierarchyWriter::begin(const HierarchyBasis& basis) {
  json_.member("field", field_section(basis.made.input));
  json_.member("method", method_section(plan_.field, basis.made, loaded_.source.numbering));
  timings_["field"] = basis.made.input.seconds;
  timings_["method"] = basis.made.method_seconds;
  if (basis.hierarchy != nullptr) {
    timings_["hierarchy"] = basis.hierarchy_seconds;
    if (items_) write_cancellations(*basis.hierarchy);
  }
  timings_["levels"] = Json::array();
  json_.begin_array("levels");
}

void HierarchyWriter::write_cancellations(const mscomplex::PersistenceHierarchy& hierarchy) {
  const mscomplex::MorseSmaleComplex& complex = hierarchy.complex();
  json_.begin_array("cancellations");
  json_.rows(hierarchy.cancellations().size(), [&](std::size_t i, const TakeRow& take) {
    const mscomplex::Cancellation& c = hierarchy.cancellations()[i];
    const mscomplex::Node extremum = complex.node(c.extremum);
    const mscomplex::Node survivor = complex.node(c.survivor);
    const bool to_cap = survivor.kind == NodeKind::cap;
    take({{"kind", extremum.kind == NodeKind::minimum ? "minimum-saddle" : "saddle-maximum"},
          {"saddle", vertex(complex.node(hierarchy.saddle_of(c)).vertex)},
          {"extremum", vertex(extremum.vertex)},
          {"survivor", to_cap ? Cell(nullptr) : vertex(survivor.vertex)},
          {"persistence", c.persistence}});
  });
  json_.end_array();
}

Cell HierarchyWriter::vertex(Index v) const {
  return v == core::kNone ? Cell(nullptr) : Cell(std::uint64_t{loaded_.source.numbering.input_vertex(v)});
}

void HierarchyWriter::level(const Level& level) {
  json_.begin_object();
  write_name(level);
  json_.member("field", {{"min", level.field->min()}, {"max", level.field->max()}});
  json_.member("critical_points", counts_section(level.points));
  json_.member("links", {{"kept", level.count(PointStatus::kept)},
                         {"moved", level.count(PointStatus::moved)},
                         {"new", level.count(PointStatus::fresh)}});
  json_.member("ms_complex", complex_section(level.complex, level.segmentation, level.quad_cells));
  if (items_) write_items(level);
  json_.end_object();
  Json seconds = {{"level", level.place}};
  seconds.update(timings_section(level.timings));
  timings_["levels"].push_back(std::move(seconds));
}

void HierarchyWriter::write_name(const Level& level) {
  json_.member("level", level.place);
  if (level.name.iteration) json_.member("iteration", *level.name.iteration);
  if (!level.name.cancelled) return;
  const CancelledLevel& cancelled = *level.name.cancelled;
  if (cancelled.threshold) {
    json_.member("asked", level.name.asked);
    json_.member("threshold", *cancelled.threshold);
  }
  if (cancelled.count) json_.member("count", *cancelled.count);
  json_.member("cancellations", cancelled.cancellations);
  json_.member("largest_cancelled", cancelled.largest);
  json_.member("note", level.name.note);
}

void HierarchyWriter::write_items(const Level& level) {
  write_points(level);
  write_arcs(level);
  json_.begin_object("cells");
  for (const SegmentKind kind : mscomplex::kSegmentKinds) write_cells(level, kind);
  json_.end_object();
}

void HierarchyWriter::write_points(const Level& level) {
  json_.begin_array("points");
  json_.rows(level.points.points.size(), [&](std::size_t i, const TakeRow& take) {
    const morse::CriticalPoint& point = level.points.points[i];
    take({{"vertex", vertex(point.vertex)},
          {"position", std::span<const double, 3>(loaded_.mesh.position(point.vertex).data(), 3)},
          {"type", to_string(point.type)},
          {"multiplicity", std::uint64_t{point.multiplicity}},
          {"value", level.field->value(point.vertex)},
          {"persistence", level.persistence[i]},
          {"parent", vertex(level.parents[i])},
          {"status", to_string(level.status(i))}});
  });
  json_.end_array();
}

void HierarchyWriter::write_arcs(const Level& level) {
  using mscomplex::MorseSmaleComplex;
  json_.begin_array("arcs");
  json_.rows(level.complex.arc_count(), [&](std::size_t i, const TakeRow& take) {
    const mscomplex::Arc arc = level.complex.arc(static_cast<Index>(i));
    const mscomplex::Node end = level.complex.node(arc.end);
    const bool to_cap = end.kind == NodeKind::cap;
    take({{"kind", arc.kind == mscomplex::ArcKind::descending ? "descending" : "ascending"},
          {"saddle", vertex(level.complex.node(arc.saddle).vertex)},
          {"end", to_cap ? Cell(nullptr) : vertex(end.vertex)},
          {"cap", to_cap ? number(end.cell) : Cell(nullptr)}});
  });
  json_.end_array();
}

void HierarchyWriter::write_cells(const Level& level, SegmentKind kind) {
  const std::vector<Index> labels = level.labels(kind);
  const CellLinks& links = level.cell_links(kind);
  const auto top_of = [&](Index label) { return level.complex.node(level.complex.maximum_node(label)); };
  json_.begin_array(key_of(kind));
  json_.rows(labels.size(), [&](std::size_t i, const TakeRow& take) {
    const Index label = labels[i];
    Index minimum = label;
    Index top = label;
    if (kind == SegmentKind::morse_smale) {
      minimum = level.segmentation.cells[label][0];
      top = level.segmentation.cells[label][1];
    }
    Cell lowest = nullptr;
    Cell highest = nullptr;
    Cell cap = nullptr;
    if (kind != SegmentKind::descending) lowest = vertex(level.complex.node(minimum).vertex);
    if (kind != SegmentKind::ascending) {
      const mscomplex::Node node = top_of(top);
      (node.kind == NodeKind::cap ? cap : highest) =
          node.kind == NodeKind::cap ? number(node.cell) : vertex(node.vertex);
    }
    const double area = links.areas[label];
    const SharedCells parent(links.parents[label], area);
    const SharedCells child(links.merges_into[label], area);
    take({{"label", std::uint64_t{label}},
          {"minimum", lowest},
          {"maximum", highest},
          {"cap", cap},
          {"area", area},
          {"parent", parent.other},
          {"parent_area", parent.area},
          {"parent_share", parent.share},
          {"merges_into", child.other},
          {"merged_area", child.area},
          {"merged_share", child.share}});
  });
  json_.end_array();
}

void HierarchyWriter::finish() {
  json_.end_array();
  timings_["total"] = watch_.seconds() + timings_["load"].get<double>();
  json_.member("timings", timings_);
  json_.end_object();
}

}  // namespace morsel::tools
