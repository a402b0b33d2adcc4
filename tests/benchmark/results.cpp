#include "benchmark/results.h"

#include <cstdio>

#include "morsel/tools/formats/text_table.h"

namespace morsel::benchmark {
namespace {

std::string printed(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

/// Of the bandwidth of so many threads.
double bandwidth_share(const Row& row, const Machine& machine) {
  return row.bytes_moved / row.cost.seconds / machine.bandwidth.at(row.threads);
}

}  // namespace

nlohmann::ordered_json to_json(const Row& row, const Machine& machine) {
  nlohmann::ordered_json json = {
      {"step", row.step},
      {"mesh", row.mesh},
      {"vertices", row.vertices},
      {"field", row.field},
      {"threads", row.threads},
      {"seconds", row.cost.seconds},
      {"fastest", row.cost.fastest},
      {"runs", row.cost.runs},
      {"ns_per_vertex", 1e9 * row.cost.seconds / static_cast<double>(row.vertices)},
      {"peak_bytes", row.cost.peak}};
  if (row.pairs > 0) {
    json["pairs"] = row.pairs;
    json["ns_per_pair"] = 1e9 * row.cost.seconds / row.pairs;
  }
  if (row.bytes_moved > 0) {
    json["bytes_moved"] = row.bytes_moved;
    json["bandwidth_share"] = bandwidth_share(row, machine);
  }
  if (row.error) json["error"] = *row.error;
  if (row.growth) json["growth"] = *row.growth;
  for (const Baseline& baseline : row.baselines)
    json["baselines"].push_back({{"name", baseline.name},
                                 {"seconds", baseline.seconds},
                                 {"ratio", baseline.seconds / row.cost.seconds}});
  if (!row.note.empty()) json["note"] = row.note;
  return json;
}

std::string table(const std::vector<Row>& rows, const Machine& machine) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    for (const Baseline& baseline : row.baselines)
      if (std::find(names.begin(), names.end(), baseline.name) == names.end()) names.push_back(baseline.name);
  std::vector<std::vector<std::string>> cells = {{"step", "mesh", "vertices", "field", "threads", "seconds"}};
  for (const std::string& name : names) {
    cells[0].push_back(name);
    cells[0].emplace_back("ratio");
  }
  for (const char* title : {"ns/vertex", "ns/pair", "bandwidth", "error", "peak MB", "growth", "note"})
    cells[0].emplace_back(title);
  for (const Row& row : rows) {
    std::vector<std::string> line = {row.step,
                                     row.mesh,
                                     tools::grouped(row.vertices),
                                     row.field,
                                     std::to_string(row.threads),
                                     printed("%.3g", row.cost.seconds)};
    for (const std::string& name : names) {
      const auto baseline = std::find_if(row.baselines.begin(), row.baselines.end(),
                                         [&](const Baseline& b) { return b.name == name; });
      const bool here = baseline != row.baselines.end();
      line.push_back(here ? printed("%.3g", baseline->seconds) : "");
      line.push_back(here ? printed("%.1f", baseline->seconds / row.cost.seconds) : "");
    }
    line.push_back(printed("%.3g", 1e9 * row.cost.seconds / static_cast<double>(row.vertices)));
    line.push_back(row.pairs > 0 ? printed("%.3f", 1e9 * row.cost.seconds / row.pairs) : "");
    line.push_back(row.bytes_moved > 0 ? printed("%.0f %%", 100 * bandwidth_share(row, machine)) : "");
    line.push_back(row.error ? printed("%.1e", *row.error) : "");
    line.push_back(printed("%.0f", 1e-6 * static_cast<double>(row.cost.peak)));
    line.push_back(row.growth ? printed("%.2f", *row.growth) : "");
    line.push_back(row.note);
    cells.push_back(std::move(line));
  }
  for (std::size_t column = cells[0].size(); column-- > 0;) {
    bool filled = false;
    for (std::size_t i = 1; i < cells.size(); ++i) filled |= !cells[i][column].empty();
    if (!filled)
      for (auto& line : cells) line.erase(line.begin() + static_cast<std::ptrdiff_t>(column));
  }
  return tools::text_table(cells);
}

}  // namespace morsel::benchmark
