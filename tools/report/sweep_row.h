#pragma once
/// Writes and reads rows of parameter sweeps in documents and journals.

#include <span>

#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::tools {

/// {"field", "method", "iterations_run", "critical_points", "persistence"}, see sweep.schema.json; `known` as
/// for field_parameters().
Json row_section(const SweepRow& row, std::span<const HashedFile> known = {});
/// {"field", "method", "measuring"}
Json seconds_section(const SweepSeconds& seconds);

/// The row that both sections were made of, without the details of its steps, which no section holds. Throws
/// BadInput (json_view.h) on other shapes.
SweepRow read_row(const JsonView& row, const JsonView& seconds);

}  // namespace morsel::tools
