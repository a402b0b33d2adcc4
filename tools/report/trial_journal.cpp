#include "morsel/tools/report/trial_journal.h"

#include <utility>

#include "morsel/core/parameters.h"

namespace morsel::tools {
namespace {

std::string surface_name(const Perturbation& perturbation, std::size_t number) {
  std::string name = std::string(to_string(perturbation.kind)) + " " + core::shortest(perturbation.amount);
  if (perturbation.kind == PerturbationKind::noise)
    name += " " + std::string(to_string(perturbation.direction));
  return name + " " + std::to_string(number);
}

Json to_json(const Trial& trial) {
  return {trial.points.minima,     trial.points.saddles,      trial.points.saddle_multiplicity,
          trial.points.maxima,     trial.agreement.reference, trial.agreement.found,
          trial.agreement.matched, trial.agreement.distances, trial.chance};
}

Trial trial_of(const Json& json) {
  Trial trial;
  trial.points.minima = json.at(0);
  trial.points.saddles = json.at(1);
  trial.points.saddle_multiplicity = json.at(2);
  trial.points.maxima = json.at(3);
  trial.agreement = {json.at(4), json.at(5), json.at(6), json.at(7)};
  trial.chance = json.at(8);
  return trial;
}

}  // namespace

TrialJournal::TrialJournal(Journal& journal) : journal_(journal) {
  for (const Json& entry : journal.entries()) {
    std::vector<Trial>& trials = known_[entry.at("surface")];
    trials.clear();
    for (const Json& trial : entry.at("trials")) trials.push_back(trial_of(trial));
  }
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
