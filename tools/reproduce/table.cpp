#include "morsel/tools/reproduce/table.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools::reproduce {

std::string method_of(const TableRow& row, const TableSetting& setting) {
  if (row.iterations == 0) return "conventional";
  return "salient:iterations=" + std::to_string(row.iterations) + "," + std::string(setting.keys);
}

std::vector<TableRowOutcome> make_table(const std::vector<std::unique_ptr<Model>>& models,
                                        const core::Progress& progress) {
  std::vector<TableRowOutcome> table;
  for (const TableRow& row : table_rows()) {
    TableRowOutcome outcome{&row, models[row.model].get(), {}};
    for (const TableSetting& setting : table_settings()) {
      const MethodRun& run = outcome.model->run(method_of(row, setting), progress);
      outcome.cells.push_back({row.iterations == 0 ? nullptr : &setting, &run});
      if (row.iterations == 0) break;
    }
    table.push_back(std::move(outcome));
  }
  return table;
}

std::string table_csv(const std::vector<TableRowOutcome>& table) {
  std::string text =
      "model,mesh,vertices,figure,iterations,method,points,paper_points,seconds,paper_seconds,version,sha256,"
      "field,field_parameters,method_parameters\r\n";
  for (const TableRowOutcome& row : table)
    for (const TableCell& cell : row.cells)
      text += std::string(row.model->recipe().name) + "," +
              csv_path(row.model->file().path.filename().string()) + "," +
              std::to_string(row.model->mesh().vertex_count()) + "," + std::string(row.recipe->figure) + "," +
              std::to_string(row.recipe->iterations) + "," + csv_field(cell.run->plan.chain.specification) +
              "," + std::to_string(cell.run->total()) + "," +
              (row.recipe->paper_points ? std::to_string(*row.recipe->paper_points) : "") + "," +
              core::shortest(cell.run->seconds) + "," +
              (row.recipe->paper_seconds ? core::shortest(*row.recipe->paper_seconds) : "") + "," + kVersion +
              "," + row.model->sha256() + "," + std::string(kField) + "," +
              csv_field(json_text(to_json(cell.run->made.input.parameters))) + "," +
              csv_field(json_text(parameters_section(cell.run->made.outcome.steps))) + "\r\n";
  return text;
}

std::string table_text(const Reproduction& reproduction) {
  std::vector<std::vector<std::string>> rows = {{"model", "vertices", "figure", "iterations", "paper"}};
  for (const TableSetting& setting : table_settings()) rows[0].emplace_back(setting.keys);
  for (const TableRowOutcome& row : reproduction.table) {
    std::vector<std::string> cells = {
        std::string(row.model->recipe().name), grouped(row.model->mesh().vertex_count()),
        std::string(row.recipe->figure),
        row.recipe->iterations == 0 ? "-" : std::to_string(row.recipe->iterations),
        row.recipe->paper_points ? grouped(static_cast<std::uint64_t>(*row.recipe->paper_points)) : ""};
    for (std::size_t i = 0; i < table_settings().size(); ++i)
      cells.push_back(grouped(row.cells[std::min(i, row.cells.size() - 1)].run->total()));
    rows.push_back(std::move(cells));
  }
  return text_table(rows);
}

}  // namespace morsel::tools::reproduce
