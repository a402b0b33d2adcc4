#include "morsel/tools/report/hierarchy_table.h"

#include "morsel/core/text/printable.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/comparison_table.h"

namespace morsel::tools {

void HierarchyTable::begin(const HierarchyBasis& basis) {
  headline_ = field_line(basis.made.input) + "; " + plan_.field.chain.name + ", levels by " +
              std::string(to_string(plan_.kind));
  const char* const first = plan_.kind == HierarchyKind::iteration ? "iteration"
                            : plan_.counts.empty()                 ? "threshold"
                                                                   : "count";
  rows_ = {
      {first, "minima", "saddles", "(mult.)", "maxima", "total", "arcs", "cells", "kept", "moved", "new"}};
}

void HierarchyTable::level(const Level& level) {
  const auto counted = [&](PointStatus status) {
    return level.place == 0 ? std::string() : grouped(level.count(status));
  };
  rows_.push_back({level.name.asked, grouped(level.points.minima), grouped(level.points.saddles),
                   grouped(level.points.saddle_multiplicity), grouped(level.points.maxima),
                   grouped(level.points.total()), grouped(level.complex.arc_count()),
                   grouped(level.quad_cells), counted(PointStatus::kept), counted(PointStatus::moved),
                   counted(PointStatus::fresh)});
  if (!level.name.note.empty()) notes_ += core::printable(level.name.note) + "\n";
}

std::string HierarchyTable::text() const {
  return core::printable(headline_) + "\n" + text_table(rows_) + notes_;
}

}  // namespace morsel::tools
