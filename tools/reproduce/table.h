#pragma once
/// The paper's Table 1 beside the results, and the controls.

#include <ostream>
#include <string>
#include <vector>

#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools::reproduce {

/// Runs every row with every setting (a conventional row once).
std::vector<TableRowOutcome> make_table(const std::vector<std::unique_ptr<Model>>& models,
                                        const core::Progress& progress = {});

/// Runs every control on the model of each row that iterates.
std::vector<ControlOutcome> make_controls(const std::vector<std::unique_ptr<Model>>& models,
                                          const core::Progress& progress = {});

/// The method of a row: conventional, or salient with its iterations and the setting's keys.
std::string method_of(const TableRow& row, const TableSetting& setting);

/// A line for each row and setting: model, mesh, vertices, figure, iterations, method, points, paper_points,
/// seconds, paper_seconds (empty where the paper has no number), percentile (the mean saliency percentile of
/// the extrema, empty without one), version, the mesh's sha256, and all resolved parameters. RFC 4180.
void write_table_csv(std::ostream& out, const std::vector<TableRowOutcome>& rows);

/// A line for each control: model, mesh, figure, iterations, control, method, rank (empty: all extrema),
/// points, extrema, percentile, version, sha256 and parameters as above. RFC 4180.
void write_controls_csv(std::ostream& out, const std::vector<ControlOutcome>& controls);

}  // namespace morsel::tools::reproduce
