#include "morsel/tools/report/sweep_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/sweep_row.h"

namespace morsel::tools {
namespace {

const std::string& value_of(const SweepReport& report, std::size_t row, std::size_t variation) {
  const Variation& varied = report.plan.variations[variation];
  return varied.values[report.plan.combinations[row].choices[variation]];
}

/// Minima, saddles, their multiplicities, maxima and the total.
std::array<std::uint64_t, 5> counts_of(const SweepRow& row) {
  const morse::CriticalPoints& points = row.critical_points;
  return {points.minima, points.saddles, points.saddle_multiplicity, points.maxima, points.total()};
}

/// Whether the field was read from the file that this variation's value names.
bool is_path(const SweepReport& report, std::size_t row, std::size_t variation) {
  const std::string& key = report.plan.variations[variation].key;
  const std::string_view own_key = std::string_view(key).substr(key.rfind('.') + 1);  // npos + 1 is 0
  return std::ranges::any_of(report.rows[row].field.files, [&](const core::FileParameter& file) {
    return file.key == own_key && file.path == value_of(report, row, variation);
  });
}

void write_row(JsonSink& json, const SweepReport& report, std::size_t i) {
  const Combination& combination = report.plan.combinations[i];
  Json values = Json::object();
  for (std::size_t k = 0; k < combination.choices.size(); ++k)
    values[report.plan.variations[k].key] = value_of(report, i, k);
  json.begin_object();
  json.member("values", values);
  json.member("specification",
              {{"field", to_string(combination.field)}, {"method", to_string(combination.steps)}});
  const Json row = row_section(report.rows[i], report.files);
  for (const auto& [key, value] : row.items()) json.member(key, value);
  json.end_object();
}

}  // namespace

Json request_section(const SweepRequest& request, const SweepPlan& plan, const core::BuildOptions& build) {
  Json variations = Json::array();
  for (const Variation& variation : plan.variations)
    variations.push_back({{"key", variation.key}, {"values", variation.values}});
  Json asked = {{"field", request.field},
                {"method", request.method},
                {"vary", request.vary},
                {"variations", std::move(variations)},
                {"repair", build.repair}};
  add_build_options(asked, build);
  return asked;
}

Json rows_key(const ReportInput& input, const std::vector<HashedFile>& files) {
  Json key = {{"schema", "morsel.sweep/1"},
              {"tool", tool_section()},
              {"mesh", input.mesh_sha256},
              {"repair", input.build.repair},
              {"files", files_section(files)}};
  add_build_options(key, input.build);
  if (!input.format.empty()) key["format"] = input.format;
  return key;
}

void write_sweep(JsonSink& json, const SweepReport& report) {
  json.begin_object();
  json.member("schema", "morsel.sweep/1");
  json.member("tool", tool_section());
  json.member("request", request_section(report.request, report.plan, report.input.build));
  json.member("mesh", mesh_section(report.input.mesh_path, report.input.mesh_sha256, report.loaded));
  json.begin_array("rows");
  for (std::size_t i = 0; i < report.rows.size(); ++i) write_row(json, report, i);
  json.end_array();
  Json seconds = Json::array();
  for (const SweepRow& row : report.rows) seconds.push_back(seconds_section(row.seconds));
  json.member("timings", {{"load", report.input.load_seconds}, {"rows", std::move(seconds)}});
  json.end_object();
}

void write_sweep_csv(std::ostream& out, const SweepReport& report) {
  std::vector<std::string> columns = {"version", "mesh", "sha256", "field", "method"};
  for (const Variation& variation : report.plan.variations) columns.push_back(variation.key);
  for (const char* column : {"iterations_run", "minima", "saddles", "saddle_multiplicity", "maxima", "total",
                             "pairs", "infinite_pairs", "essential_saddles", "largest_persistence",
                             "pairs_over_0.1_percent", "pairs_over_1_percent", "pairs_over_5_percent", "min",
                             "max", "field_parameters", "method_parameters", "seconds"})
    columns.emplace_back(column);
  CsvTable table(out, columns);
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const Combination& combination = report.plan.combinations[i];
    const SweepRow& row = report.rows[i];
    CsvLine line;
    line.add(kVersion);
    line.add_path(report.input.mesh_path);
    line.add(report.input.mesh_sha256);
    line.add(to_string(combination.field));
    line.add(to_string(combination.steps));
    for (std::size_t k = 0; k < combination.choices.size(); ++k)
      is_path(report, i, k) ? line.add_path(value_of(report, i, k)) : line.add(value_of(report, i, k));
    line.add_json(row.iterations_run ? Json(*row.iterations_run) : Json());
    for (const std::uint64_t count : counts_of(row)) line.add(count);
    const PersistenceSummary& persistence = row.persistence;
    for (const std::uint64_t count :
         {persistence.pairs, persistence.infinite_pairs, persistence.essential_saddles})
      line.add(count);
    line.add_json(persistence.largest ? Json(*persistence.largest) : Json());
    for (const std::uint64_t pairs : persistence.above) line.add(pairs);
    line.add_json(row.min);
    line.add_json(row.max);
    line.add_json(field_parameters(row.field, report.files));
    line.add_json(parameters_section(row.steps));
    line.add(row.seconds.sum());
    table.add(line);
  }
}

std::string sweep_table(const SweepReport& report) {
  std::vector<std::vector<std::string>> rows(1);
  for (const Variation& variation : report.plan.variations) rows.front().push_back(variation.key);
  for (const char* head :
       {"minima", "saddles", "(mult.)", "maxima", "total", "pairs", ">1 %", "largest", "seconds"})
    rows.front().emplace_back(head);
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const SweepRow& row = report.rows[i];
    std::vector<std::string>& cells = rows.emplace_back();
    for (std::size_t k = 0; k < report.plan.variations.size(); ++k) cells.push_back(value_of(report, i, k));
    for (const std::uint64_t count : counts_of(row)) cells.push_back(grouped(count));
    cells.push_back(grouped(row.persistence.pairs));
    cells.push_back(grouped(row.persistence.above[1]));
    const std::optional<double>& largest = row.persistence.largest;
    cells.push_back(largest ? core::to_digits(*largest) : "");
    cells.push_back(core::to_decimals(row.seconds.sum(), 2));
  }
  return text_table(rows);
}

}  // namespace morsel::tools
