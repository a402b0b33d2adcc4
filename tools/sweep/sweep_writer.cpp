#include "morsel/tools/sweep/sweep_writer.h"

#include <array>
#include <string_view>

#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

constexpr std::array kCounts = {"minima", "saddles", "saddle_multiplicity", "maxima", "total"};

const std::string& value_of(const SweepReport& report, std::size_t row, std::size_t variation) {
  const Variation& varied = report.prepared.variations[variation];
  return varied.values[report.prepared.combinations[row].choices[variation]];
}

double all_seconds(const Json& seconds) {
  double sum = 0;
  for (const auto& [part, value] : seconds.items()) sum += value.get<double>();
  return sum;
}

void write_row(JsonSink& json, const SweepReport& report, std::size_t i) {
  const Combination& combination = report.prepared.combinations[i];
  Json values = Json::object();
  for (std::size_t k = 0; k < combination.choices.size(); ++k)
    values[report.prepared.variations[k].key] = value_of(report, i, k);
  json.begin_object();
  json.member("values", values);
  json.member("specification",
              {{"field", to_string(combination.field)}, {"method", to_string(combination.steps)}});
  for (const auto& [key, value] : report.rows[i].result.items()) json.member(key, value);
  json.end_object();
}

}  // namespace

Json request_section(const SweepRequest& request, const PreparedSweep& prepared, bool repair) {
  Json variations = Json::array();
  for (const Variation& variation : prepared.variations)
    variations.push_back({{"key", variation.key}, {"values", variation.values}});
  return {{"field", request.field},
          {"method", request.method},
          {"vary", request.vary},
          {"variations", std::move(variations)},
          {"repair", repair}};
}

Json rows_key(const ReportInput& input, const std::vector<HashedFile>& files) {
  return {{"schema", "morsel.sweep/1"},
          {"tool", tool_section()},
          {"mesh", input.mesh_sha256},
          {"repair", input.repair},
          {"files", files_section(files)}};
}

void write_sweep(JsonSink& json, const SweepReport& report) {
  json.begin_object();
  json.member("schema", "morsel.sweep/1");
  json.member("tool", tool_section());
  json.member("request", request_section(report.request, report.prepared, report.input.repair));
  json.member("mesh", mesh_section(report.input.mesh_path, report.input.mesh_sha256, report.loaded.mesh,
                                   report.loaded.source.repairs));
  json.begin_array("rows");
  for (std::size_t i = 0; i < report.rows.size(); ++i) write_row(json, report, i);
  json.end_array();
  Json seconds = Json::array();
  for (const SweepRow& row : report.rows) seconds.push_back(row.seconds);
  json.member("timings", {{"load", report.input.load_seconds}, {"rows", std::move(seconds)}});
  json.end_object();
}

void write_sweep_csv(std::ostream& out, const SweepReport& report) {
  CsvLine head;
  for (const char* column : {"version", "mesh", "sha256", "field", "method"}) head.add(column);
  for (const Variation& variation : report.prepared.variations) head.add(variation.key);
  head.add("iterations_run");
  for (const char* count : kCounts) head.add(count);
  for (const char* column : {"pairs", "infinite_pairs", "essential_saddles", "largest_persistence",
                             "pairs_over_0.1_percent", "pairs_over_1_percent", "pairs_over_5_percent", "min",
                             "max", "field_parameters", "method_parameters", "seconds"})
    head.add(column);
  out << head.text() << '\n';
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const Combination& combination = report.prepared.combinations[i];
    const Json& result = report.rows[i].result;
    CsvLine line;
    line.add(kVersion);
    line.add_path(report.input.mesh_path);
    line.add(report.input.mesh_sha256);
    line.add(to_string(combination.field));
    line.add(to_string(combination.steps));
    for (std::size_t k = 0; k < combination.choices.size(); ++k) line.add(value_of(report, i, k));
    line.add_json(result["iterations_run"]);
    for (const char* count : kCounts) line.add_json(result["critical_points"].at(count));
    const Json& persistence = result["persistence"];
    for (const char* number : {"pairs", "infinite_pairs", "essential_saddles", "max"})
      line.add_json(persistence.at(number));
    for (const Json& above : persistence.at("above")) line.add_json(above.at("pairs"));
    line.add_json(result["method"].at("min"));
    line.add_json(result["method"].at("max"));
    line.add_json(result["field"].at("parameters"));
    line.add_json(result["method"].at("parameters"));
    line.add(all_seconds(report.rows[i].seconds));
    out << line.text() << '\n';
  }
}

std::string sweep_table(const SweepReport& report) {
  std::vector<std::vector<std::string>> rows(1);
  for (const Variation& variation : report.prepared.variations) rows.front().push_back(variation.key);
  for (const char* head :
       {"minima", "saddles", "(mult.)", "maxima", "total", "pairs", ">1 %", "largest", "seconds"})
    rows.front().emplace_back(head);
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const Json& result = report.rows[i].result;
    std::vector<std::string>& row = rows.emplace_back();
    for (std::size_t k = 0; k < report.prepared.variations.size(); ++k) row.push_back(value_of(report, i, k));
    for (const char* count : kCounts)
      row.push_back(grouped(result["critical_points"].at(count).get<std::uint64_t>()));
    const Json& persistence = result["persistence"];
    row.push_back(grouped(persistence.at("pairs").get<std::uint64_t>()));
    row.push_back(grouped(persistence.at("above").at(1).at("pairs").get<std::uint64_t>()));
    const Json& largest = persistence.at("max");
    row.push_back(largest.is_null() ? "" : core::to_digits(largest.get<double>()));
    row.push_back(core::to_decimals(all_seconds(report.rows[i].seconds), 2));
  }
  return text_table(rows);
}

}  // namespace morsel::tools
