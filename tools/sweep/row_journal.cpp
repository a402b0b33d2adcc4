#include "morsel/tools/sweep/row_journal.h"

#include <map>

#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {
namespace {

/// All that documents, tables and plots take from a row.
void check_row(const JsonView& result, const JsonView& seconds) {
  check_members(result, {"field", "method", "iterations_run", "critical_points", "persistence"});
  check_field(result["field"]);
  check_field(result["method"]);
  if (const JsonView run = result["iterations_run"]; !run.is_null()) static_cast<void>(run.count());
  check_critical_points(result["critical_points"]);
  check_persistence(result["persistence"]);
  check_members(seconds, {"field", "method", "measuring"});
  for (const auto& [part, value] : seconds.members()) static_cast<void>(value.number(0));
}

}  // namespace

RowJournal::RowJournal(Journal& journal, const PreparedSweep& prepared)
    : journal_(journal), prepared_(prepared), rows_(prepared.combinations.size()) {
  std::map<std::string, SweepRow> known;
  journal.take_entries([&](const JsonView& entry) {
    check_row(entry["result"], entry["seconds"]);
    known[entry["combination"].text()] = {entry["result"].json(), entry["seconds"].json()};
  });
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (const auto row = known.find(name(i)); row != known.end()) {
      rows_[i] = row->second;
      ++count_;
    }
}

SweepOptions RowJournal::options() {
  return {rows_, [this](std::size_t i, const SweepRow& row) {
            journal_.add({{"combination", name(i)}, {"result", row.result}, {"seconds", row.seconds}});
          }};
}

std::string RowJournal::name(std::size_t combination) const {
  const Combination& named = prepared_.combinations[combination];
  return to_string(named.field) + " " + to_string(named.steps);
}

}  // namespace morsel::tools
