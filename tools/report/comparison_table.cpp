#include "morsel/tools/report/comparison_table.h"

#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {
namespace {

/// What the columns mean that are about more than their own row.
std::string foot(const MethodOutcome& first) {
  return core::printable("kept: points of " + first.specification) +
         " with the same type at the same vertex\nmoved: others of it with one of the same type within " +
         core::to_digits(matching_radius(first.field.mesh())) +
         " (2 % of the root of the area), one to one\nadded: points that are neither\n"
         ">1 %: pairs above 1 % of the input field's range\n";
}

}  // namespace

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
                   grouped(summary_of(m.diagram, outcome.input_extent).above_one_percent()),
                   grouped(m.complex.arc_count()), grouped(m.cells), grouped(matching.kept.size()),
                   grouped(matching.moved.size()), grouped(matching.added), core::to_decimals(seconds, 2)});
  if (rows_.size() == 2) foot_ = foot(outcome);
  const auto note = [&](const std::string& text) {
    notes_ += core::printable(outcome.specification + ": " + text) + "\n";
  };
  for (const StepOutcome& step : outcome.steps)
    for (const auto& [name, value] : step.details)
      if (name == "note") note(std::get<std::string>(value));
  if (!outcome.target) return;
  for (const std::string& text : {outcome.target->note, early_end(*outcome.target)})
    if (!text.empty()) note(text);
}

std::string ComparisonTable::text() const {
  return core::printable(headline_) + "\n" + text_table(rows_) + foot_ + notes_;
}

}  // namespace morsel::tools
