#include "morsel/tools/study/summary.h"

namespace morsel::tools {

FieldSummary summary_of(const FieldOutcome& outcome) {
  return {outcome.name,        outcome.parameters, outcome.field.min(),
          outcome.field.max(), outcome.files,      outcome.warnings};
}

PersistenceSummary summary_of(const persistence::Diagram& diagram, double extent) {
  PersistenceSummary summary;
  summary.pairs = diagram.pairs.size();
  summary.infinite_pairs = diagram.cap_pairs().size();
  for (const auto& saddle : diagram.essential_saddles) summary.essential_saddles += saddle.count;
  if (diagram.finite_count > 0) summary.largest = diagram.largest();
  for (std::size_t i = 0; i < summary.above.size(); ++i)
    summary.above[i] =
        diagram.count_above(PersistenceSummary::kPercents[i] / 100 * extent) + summary.infinite_pairs;
  return summary;
}

}  // namespace morsel::tools
