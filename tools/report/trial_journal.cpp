#include "morsel/tools/report/trial_journal.h"

#include <algorithm>
#include <utility>

#include "morsel/core/text/numbers.h"
#include "morsel/core/types.h"

namespace morsel::tools {
namespace {

std::string surface_name(const Perturbation& perturbation, std::size_t number) {
  std::string name = std::string(to_string(perturbation.kind)) + " " + core::shortest(perturbation.amount);
  if (perturbation.kind == PerturbationKind::noise)
    name += " " + std::string(to_string(perturbation.direction));
  return name + " " + std::to_string(number);
}

/// The last of ten numbers is 1 for a sum of distances that may not be the least; nine else.
Json to_json(const Trial& trial) {
  Json numbers = {trial.points.minima,     trial.points.saddles,      trial.points.saddle_multiplicity,
                  trial.points.maxima,     trial.agreement.reference, trial.agreement.found,
                  trial.agreement.matched, trial.agreement.distances, trial.chance};
  if (!trial.agreement.is_least) numbers.push_back(1);
  return numbers;
}

/// Checks that matched points do not outnumber points, and that F-scores are possible.
Trial trial_of(const JsonView& json) {
  const std::vector<JsonView> numbers = json.list(9, 10);
  Trial trial;
  trial.points.minima = numbers[0].count(core::kNone);
  trial.points.saddles = numbers[1].count(core::kNone);
  trial.points.saddle_multiplicity = numbers[2].count(core::kNone);
  trial.points.maxima = numbers[3].count(core::kNone);
  if (trial.points.saddle_multiplicity < trial.points.saddles) numbers[2].refuse("is less than the saddles");
  const std::uint64_t reference = numbers[4].count(core::kNone);
  const std::uint64_t found = numbers[5].count(trial.points.total());
  trial.agreement = {reference, found, numbers[6].count(std::min(reference, found)), numbers[7].number(0),
                     true};
  trial.chance = numbers[8].number(0);
  if (trial.chance > 1) numbers[8].refuse("is out of range");
  trial.agreement.is_least = numbers.size() == 9 || numbers[9].count(1) == 0;
  return trial;
}

}  // namespace

TrialJournal::TrialJournal(Journal& journal, std::size_t outcomes) : journal_(journal) {
  journal.take_entries([&](const JsonView& entry) {
    std::vector<Trial> trials;
    for (const JsonView& trial : entry["trials"].list(outcomes, outcomes)) trials.push_back(trial_of(trial));
    known_[entry["surface"].text()] = std::move(trials);
  });
}

std::optional<std::vector<Trial>> TrialJournal::find(const Perturbation& perturbation,
                                                     std::size_t number) const {
  const auto entry = known_.find(surface_name(perturbation, number));
  return entry == known_.end() ? std::nullopt : std::optional(entry->second);
}

void TrialJournal::add(const Perturbation& perturbation, std::size_t number,
                       const std::vector<Trial>& trials) {
  Json list = Json::array();
  for (const Trial& trial : trials) list.push_back(to_json(trial));
  journal_.add({{"surface", surface_name(perturbation, number)}, {"trials", std::move(list)}});
}

}  // namespace morsel::tools
