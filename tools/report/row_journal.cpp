#include "morsel/tools/report/row_journal.h"

#include <map>

#include "morsel/tools/report/sweep_row.h"

namespace morsel::tools {

RowJournal::RowJournal(Journal& journal, const SweepPlan& plan, const std::vector<HashedFile>& files)
    : journal_(journal), plan_(plan), files_(files), rows_(plan.combinations.size()) {
  std::map<std::string, SweepRow> known;
  journal.take_entries([&](const JsonView& entry) {
    known[entry["combination"].text()] = read_row(entry["result"], entry["seconds"]);
  });
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (const auto row = known.find(name(i)); row != known.end()) {
      rows_[i] = row->second;
      ++count_;
    }
}

SweepOptions RowJournal::options() {
  return {rows_, [this](std::size_t i, const SweepRow& row) {
            journal_.add({{"combination", name(i)},
                          {"result", row_section(row, files_)},
                          {"seconds", seconds_section(row.seconds)}});
          }};
}

std::string RowJournal::name(std::size_t combination) const {
  const Combination& named = plan_.combinations[combination];
  return to_string(named.field) + " " + to_string(named.steps);
}

}  // namespace morsel::tools
