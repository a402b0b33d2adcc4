#pragma once
/// The rows of an interrupted parameter sweep.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/tools/formats/journal.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::tools {

/// Keeps rows in a journal, an entry each.
class RowJournal {
 public:
  /// Refers to all three; `files` are those that the fields read. Entries that are not complete rows are
  /// dropped.
  RowJournal(Journal& journal, const SweepPlan& plan, const std::vector<HashedFile>& files);

  /// The number of rows of this sweep that the journal has.
  std::size_t count() const { return count_; }
  /// Options with these rows known, and a callback that adds new ones to the journal; refers to this.
  SweepOptions options();

 private:
  std::string name(std::size_t combination) const;

  Journal& journal_;
  const SweepPlan& plan_;
  const std::vector<HashedFile>& files_;
  std::vector<std::optional<SweepRow>> rows_;
  std::size_t count_ = 0;
};

}  // namespace morsel::tools
