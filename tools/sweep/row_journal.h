#pragma once
/// The rows of an interrupted sweep.

#include <cstddef>
#include <string>

#include "morsel/tools/formats/journal.h"
#include "morsel/tools/sweep/sweep.h"

namespace morsel::tools {

/// Keeps rows in a journal, an entry each.
class RowJournal {
 public:
  /// Refers to both. Entries that are not rows, all of one, are dropped.
  RowJournal(Journal& journal, const PreparedSweep& prepared);

  /// Rows of this sweep that the journal has.
  std::size_t count() const { return count_; }
  /// With these known, and those to come told to the journal; refers to this.
  SweepOptions options();

 private:
  std::string name(std::size_t combination) const;

  Journal& journal_;
  const PreparedSweep& prepared_;
  std::vector<std::optional<SweepRow>> rows_;
  std::size_t count_ = 0;
};

}  // namespace morsel::tools
