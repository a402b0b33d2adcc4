#pragma once
/// The trials of an interrupted stability study.

#include <map>
#include <string>

#include "morsel/tools/formats/journal.h"
#include "morsel/tools/study/stability.h"

namespace morsel::tools {

/// Keeps trials in a journal; an entry has those of one perturbed surface.
class TrialJournal : public TrialStore {
 public:
  /// Refers to the journal. `outcomes`: trials of a surface; entries that have another number, or numbers out
  /// of range, are dropped.
  TrialJournal(Journal& journal, std::size_t outcomes);

  std::optional<std::vector<Trial>> find(const Perturbation& perturbation, std::size_t number) const override;
  void add(const Perturbation& perturbation, std::size_t number, const std::vector<Trial>& trials) override;

  /// The number of surfaces that the journal has.
  std::size_t count() const { return known_.size(); }

 private:
  Journal& journal_;
  std::map<std::string, std::vector<Trial>> known_;
};

}  // namespace morsel::tools
