#include "morsel/tools/report/comparison_table.h"

#include <optional>

#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {
namespace {

/// What the columns mean that are about more than their own row.
std::string foot(const MethodOutcome& first) {
  const double radius = matching_radius(first.field.mesh());
  const std::string points = first.chosen ? "chosen points" : "points";
  std::string text;
  if (first.chosen)
    text = "points to added: of the points that were chosen; the columns behind: of the whole field\n";
  text += core::printable("kept: " + points + " of " + first.specification) +
          " with the same type at the same vertex\nmoved: others of it with one of the same type within " +
          core::to_digits(radius) +
          " (2 % of the root of the area), one to one\nadded: points that are neither\n"
          ">1 %: pairs above 1 % of the input field's range\n";
  if (first.chosen && first.chosen->made.has_percentiles)
    text += "percentile: of mesh saliency, the mean of the points; 0.50 by chance\n";
  return text;
}

std::vector<std::string> heads(const MethodOutcome& first) {
  if (!first.chosen)
    return {"method", "minima", "saddles", "(mult.)", "maxima", "total", "pairs",
            ">1 %",   "arcs",   "cells",   "kept",    "moved",  "added", "seconds"};
  std::vector<std::string> heads = {"method", "points", "minima", "saddles",
                                    "maxima", "kept",   "moved",  "added"};
  if (first.chosen->made.has_percentiles) heads.emplace_back("percentile");
  heads.insert(heads.end(), {"total", "pairs", ">1 %", "arcs", "cells", "seconds"});
  return heads;
}

using Cells = std::vector<std::string>;

/// total, pairs, >1 %, arcs, cells
Cells field_cells(const MethodOutcome& outcome) {
  const Measurement& m = outcome.measurement;
  return {grouped(m.critical_points.total()), grouped(m.diagram.pairs.size()),
          grouped(summary_of(m.diagram, outcome.input_extent).above_one_percent()),
          grouped(m.complex.arc_count()), grouped(m.cells)};
}

/// kept, moved, added
Cells matching_cells(const Matching& matching) {
  return {grouped(matching.kept.size()), grouped(matching.moved.size()), grouped(matching.added)};
}

Cells row_of(const MethodOutcome& outcome) {
  const morse::CriticalPoints& points = outcome.shown_points();
  Cells row = {outcome.specification};
  const auto add = [&](const Cells& cells) { row.insert(row.end(), cells.begin(), cells.end()); };
  if (outcome.chosen) {
    const ChosenOutcome& chosen = *outcome.chosen;
    add({grouped(points.total()), grouped(points.minima), grouped(points.saddles), grouped(points.maxima)});
    add(matching_cells(chosen.compared_to_first));
    const std::optional<double> mean = chosen.made.mean_percentile();
    if (chosen.made.has_percentiles) add({mean ? core::to_decimals(*mean, 2) : "-"});
    add(field_cells(outcome));
  } else {
    add({grouped(points.minima), grouped(points.saddles), grouped(points.saddle_multiplicity),
         grouped(points.maxima)});
    add(field_cells(outcome));
    add(matching_cells(outcome.compared_to_first));
  }
  double seconds = 0;
  for (const auto& [step, time] : outcome.timings) seconds += time;
  add({core::to_decimals(seconds, 2)});
  return row;
}

}  // namespace

std::string field_line(const FieldOutcome& outcome) {
  return outcome.name + ": " + core::to_digits(outcome.field.min()) + " to " +
         core::to_digits(outcome.field.max()) + " on " + grouped(outcome.field.mesh().vertex_count()) +
         " vertices";
}

void ComparisonTable::field(const FieldOutcome& outcome) {
  headline_ = field_line(outcome);
  rows_.clear();
}

void ComparisonTable::method(const MethodOutcome& outcome) {
  if (rows_.empty()) {
    rows_.push_back(heads(outcome));
    foot_ = foot(outcome);
  }
  rows_.push_back(row_of(outcome));
  const auto note = [&](const std::string& text) {
    notes_ += core::printable(outcome.specification + ": " + text) + "\n";
  };
  for (const StepOutcome& step : outcome.steps)
    for (const auto& [name, value] : step.details)
      if (name == "note") note(std::get<std::string>(value));
  if (outcome.chosen && !outcome.chosen->made.note.empty()) note(outcome.chosen->made.note);
  if (!outcome.target) return;
  for (const std::string& text : {outcome.target->note, early_end(*outcome.target)})
    if (!text.empty()) note(text);
}

std::string ComparisonTable::text() const {
  return core::printable(headline_) + "\n" + text_table(rows_) + foot_ + notes_;
}

}  // namespace morsel::tools
