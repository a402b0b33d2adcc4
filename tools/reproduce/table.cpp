#include "morsel/tools/reproduce/table.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/study/made_points.h"

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
      outcome.cells.push_back({row.iterations == 0 ? nullptr : &setting, &run,
                               outcome.model->percentile(extrema_of(run), progress)});
      if (row.iterations == 0) break;
    }
    table.push_back(std::move(outcome));
  }
  return table;
}

namespace {

void replace_all(std::string& text, std::string_view word, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += with.size())
    text.replace(at, word.size(), with);
}

/// As many extrema of the run's field as wanted, by rank.
std::vector<core::Index> ranked_extrema(const Model& model, const MethodRun& run, morse::PointRank rank,
                                        std::size_t count, const core::Progress& progress) {
  if (count == 0) return {};
  PointsRequest request;
  request.rank = rank;
  request.spacing = core::Length::absolute(0);
  const PointsPlan plan = prepare(request);
  return PointMaker(plan, model.loaded()).make(run.made.for_points(), count, progress).places;
}

/// What both tables end with: version, the mesh's hash, and all resolved parameters.
void add_origin(CsvLine& line, const Model& model, const MethodRun& run) {
  line.add(kVersion);
  line.add(model.sha256());
  line.add(kField);
  line.add_json(to_json(run.made.input.parameters));
  line.add_json(parameters_section(run.made.outcome.steps));
}

}  // namespace

std::vector<ControlOutcome> make_controls(const std::vector<std::unique_ptr<Model>>& models,
                                          const core::Progress& progress) {
  std::vector<ControlOutcome> outcomes;
  for (const TableRow& row : table_rows()) {
    if (row.iterations == 0) continue;
    Model& model = *models[row.model];
    std::size_t points = 0;   // that the first control leaves
    std::size_t extrema = 0;  // likewise
    for (const ControlRecipe& control : controls()) {
      std::string method(control.method);
      replace_all(method, "{n}", std::to_string(row.iterations));
      replace_all(method, "{k}", std::to_string(points));
      const MethodRun& run = model.run(method, progress);
      const std::vector<core::Index> chosen =
          control.rank ? ranked_extrema(model, run, *control.rank, extrema, progress) : extrema_of(run);
      if (&control == &controls().front()) {
        points = run.total();
        extrema = chosen.size();
      }
      outcomes.push_back({&control, &row, &model, &run, chosen.size(), model.percentile(chosen, progress)});
    }
  }
  return outcomes;
}

void write_table_csv(std::ostream& out, const std::vector<TableRowOutcome>& rows) {
  CsvTable table(out, {"model", "mesh", "vertices", "figure", "iterations", "method", "points",
                       "paper_points", "seconds", "paper_seconds", "percentile", "version", "sha256", "field",
                       "field_parameters", "method_parameters"});
  for (const TableRowOutcome& row : rows)
    for (const TableCell& cell : row.cells) {
      CsvLine line;
      line.add(row.model->recipe().name);
      line.add_path(row.model->file().path.filename().string());
      line.add(std::uint64_t{row.model->mesh().vertex_count()});
      line.add(row.recipe->figure);
      line.add(static_cast<std::uint64_t>(row.recipe->iterations));
      line.add(cell.run->plan.chain.specification);
      line.add(std::uint64_t{cell.run->total()});
      line.add_json(row.recipe->paper_points ? Json(*row.recipe->paper_points) : Json());
      line.add(cell.run->seconds);
      line.add(row.recipe->paper_seconds);
      line.add(cell.percentile);
      add_origin(line, *row.model, *cell.run);
      table.add(line);
    }
}

void write_controls_csv(std::ostream& out, const std::vector<ControlOutcome>& controls) {
  CsvTable table(out,
                 {"model", "mesh", "figure", "iterations", "control", "method", "rank", "points", "extrema",
                  "percentile", "version", "sha256", "field", "field_parameters", "method_parameters"});
  for (const ControlOutcome& control : controls) {
    CsvLine line;
    line.add(control.model->recipe().name);
    line.add_path(control.model->file().path.filename().string());
    line.add(control.row->figure);
    line.add(static_cast<std::uint64_t>(control.row->iterations));
    line.add(control.recipe->title);
    line.add(control.run->plan.chain.specification);
    line.add(control.recipe->rank ? std::string(to_string(*control.recipe->rank)) : "");
    line.add(std::uint64_t{control.run->total()});
    line.add(std::uint64_t{control.extrema});
    line.add(control.percentile);
    add_origin(line, *control.model, *control.run);
    table.add(line);
  }
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
  std::vector<std::vector<std::string>> controls = {
      {"model", "iterations", "control", "points", "extrema", "percentile"}};
  for (const ControlOutcome& control : reproduction.controls)
    controls.push_back({std::string(control.model->recipe().name), std::to_string(control.row->iterations),
                        std::string(control.recipe->title), grouped(control.run->total()),
                        grouped(control.extrema),
                        control.percentile ? core::to_decimals(*control.percentile, 2) : "-"});
  return text_table(rows) + "\n" + text_table(controls) +
         "percentile: of mesh saliency, the mean of the extrema; 0.50 by chance\n";
}

}  // namespace morsel::tools::reproduce
