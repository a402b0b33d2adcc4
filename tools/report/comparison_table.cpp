#include "morsel/tools/report/comparison_table.h"

#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {
std::string field_line(const FieldOutcome& outcome) {
  return outcome.name + ": " + core::to_digits(outcome.field.min()) + " to " +
         core::to_digits(outcome.field.max()) + " on " + grouped(outcome.field.mesh().vertex_count()) +
         " vertices";
}

void ComparisonTable::field(const FieldOutcome& outcome) {
  headline_ = field_line(outcome);
  rows_ = {{"method", "minima", "saddles", "(mult.)", "maxima", "total", "pairs", ">1 %", "arcs", "cells",
            "kept", "moved", "added", "seconds"}};
}

void ComparisonTable::method(const MethodOutcome& outcome) {
  const Measurement& m = outcome.measurement;
  double seconds = 0;
  for (const auto& [step, time] : outcome.timings) seconds += time;
  const Matching& matching = outcome.compared_to_first;
  rows_.push_back({outcome.specification, grouped(m.critical_points.minima),
                   grouped(m.critical_points.saddles), grouped(m.critical_points.saddle_multiplicity),
                   grouped(m.critical_points.maxima), grouped(m.critical_points.total()),
                   grouped(m.diagram.pairs.size()),
                   grouped(summary_of(m.diagram, outcome.field.extent()).above_one_percent()),
                   grouped(m.complex.arc_count()), grouped(m.segmentation.morse_smale.count),
                   grouped(matching.kept.size()), grouped(matching.moved.size()), grouped(matching.added),
                   core::to_decimals(seconds, 2)});
  if (outcome.target && !outcome.target->note.empty())
    notes_ += core::printable(outcome.specification + ": " + outcome.target->note) + "\n";
}

std::string ComparisonTable::text() const {
  return core::printable(headline_) + "\n" + text_table(rows_) + notes_;
}

}  // namespace morsel::tools
