#include "morsel/tools/report/row_journal.h"

#include <map>

namespace morsel::tools {

RowJournal::RowJournal(Journal& journal, const PreparedSweep& prepared)
    : journal_(journal), prepared_(prepared), rows_(prepared.combinations.size()) {
  std::map<std::string, const Json*> entries;
  for (const Json& entry : journal.entries()) entries[entry.at("combination")] = &entry;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (const auto entry = entries.find(name(i)); entry != entries.end()) {
      rows_[i] = {entry->second->at("result"), entry->second->at("seconds")};
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
