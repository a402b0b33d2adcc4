#pragma once
/// Reads back the parts of documents about fields and methods that outcome_sections.h writes. All throw
/// BadInput (json_view.h) on other shapes.

#include <vector>

#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {

/// A field_section(), whose files are parameters then.
FieldSummary read_field(const JsonView& field);

/// The steps of a method, {"name", "parameters"}, by parameters_section(): without their details.
std::vector<StepOutcome> read_steps(const JsonView& method);

}  // namespace morsel::tools
