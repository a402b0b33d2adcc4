#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/tools/formats/journal.h"
#include "morsel/tools/report/trial_journal.h"
#include "support/scratch.h"
#include "target.h"

namespace {

using namespace morsel;
using tools::Json;

const Json kKey = {{"mesh", "m"}, {"seed", 1}};

struct Read {
  std::vector<Json> entries;
  bool warns;
};

/// What a run finds in the file, of entries that are trials of `outcomes` each.
Read read(const std::filesystem::path& path, std::size_t outcomes) {
  tools::Journal journal(path, kKey);
  const tools::TrialJournal trials(journal, outcomes);
  fuzz::require(trials.count() <= journal.entries().size(), "more trials than entries");
  return {journal.entries(), !journal.warnings().empty()};
}

}  // namespace

void morsel::fuzz::journal(std::string_view bytes) {
  static const test::Scratch kFolder;
  const std::filesystem::path path = kFolder.file("journal", bytes);
  try {
    read(path, 1);
    const Read again = read(path, 1);
    require(!again.warns, "damage is reported once");
    require(read(path, 1).entries == again.entries, "entries stay");
    const Json trial = {{"surface", "noise 1 normal 0"}, {"trials", {{1, 1, 1, 1, 3, 3, 3, 0.5, 0.5}}}};
    {
      tools::Journal journal(path, kKey);
      journal.add(trial);
    }
    const Read more = read(path, 1);
    require(!more.warns && more.entries.size() == again.entries.size() + 1 && more.entries.back() == trial,
            "an entry that is added comes last");
  } catch (const core::InvalidArgument&) {  // no journal: it is left as it is
    require(test::contents(path) == bytes, "a file that is not a journal stays");
  }
}
