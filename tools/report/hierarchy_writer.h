#pragma once
/// The JSON document of a hierarchy ("morsel.hierarchy/1", see hierarchy.schema.json).

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools {

/// The request, with its defaults.
Json request_section(const HierarchyRequest& request, const ReportInput& input);

/// Writes the document while the levels are made. Without ReportInput::items it leaves out all lists that
/// grow with the mesh: cancellations, points, arcs, cells.
class HierarchyWriter : public HierarchySink {
 public:
  /// Refers to all but `input`, which must outlive the writer. `request` with its defaults.
  HierarchyWriter(JsonSink& json, const core::LoadedMesh& loaded, const ReportInput& input,
                  const HierarchyRequest& request, const HierarchyPlan& plan);
  void begin(const HierarchyBasis& basis) override;
  void level(const Level& level) override;
  /// Closes the document; nothing may follow.
  void finish();

 private:
  void write_cancellations(const mscomplex::PersistenceHierarchy& hierarchy);
  void write_name(const Level& level);
  void write_items(const Level& level);
  void write_points(const Level& level);
  void write_arcs(const Level& level);
  void write_cells(const Level& level, SegmentKind kind);
  Cell vertex(core::Index v) const;

  JsonSink& json_;
  const core::LoadedMesh& loaded_;
  const HierarchyPlan& plan_;
  bool items_;
  Json timings_;
  Stopwatch watch_;
};

}  // namespace morsel::tools
