#include "morsel/tools/report/stability_table.h"

#include <vector>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/comparison_table.h"

namespace morsel::tools {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string rounded(const Estimate& estimate, double unit = 1) {
  return estimate.count == 0 ? "" : core::to_decimals(estimate.mean / unit, 3);
}

std::string width(const Estimate& estimate) {
  return estimate.half_width ? core::to_decimals(*estimate.half_width, 3) : "";
}

class Tables {
 public:
  Tables(const StabilityPlan& plan, const StabilityResult& result) : plan_(plan), result_(result) {}

  std::string text() const {
    std::string text;
    for (const FieldOutcome& field : result_.fields) text += field_line(field) + "\n";
    text += std::to_string(plan_.trials) + (plan_.trials == 1 ? " trial" : " trials") + ", seed " +
            std::to_string(plan_.seed) + "; " + (plan_.points == PointChoice::all ? "points" : "extrema") +
            " matched within " + core::to_digits(result_.radius) + "; mean edge length " +
            core::to_digits(result_.mean_edge_length) + ", the unit of noise and drift\n";
    for (const std::optional<std::size_t>& target : plan_.targets)
      text += (target ? "\nTarget " + std::to_string(*target) : "\nEach method's own count") + "\n" +
              text_table(clean_rows(target)) + "\n" + text_table(perturbed_rows(target));
    return text;
  }

 private:
  std::string name(const StabilityOutcome& outcome) const {
    const std::string& method = plan_.chains[outcome.method].specification;
    if (plan_.functions.size() == 1) return method;
    return plan_.functions[outcome.field].specification + ", " + method;
  }

  Rows clean_rows(const std::optional<std::size_t>& target) const {
    Rows rows = {
        {"clean surface", "minima", "saddles", "maxima", "total", "compared", "agreement", "chance"}};
    for (const StabilityOutcome& outcome : result_.outcomes) {
      if (outcome.target != target) continue;
      rows.push_back({name(outcome), grouped(outcome.points.minima), grouped(outcome.points.saddles),
                      grouped(outcome.points.maxima), grouped(outcome.points.total()),
                      grouped(outcome.with_reference.found), core::to_decimals(outcome.agreement(), 3),
                      core::to_decimals(outcome.chance, 3)});
    }
    return rows;
  }

  Rows perturbed_rows(const std::optional<std::size_t>& target) const {
    Rows rows = {
        {"perturbation", "method", "points", "F", "\u00b1", "recall", "precision", "drift", "chance"}};
    for (std::size_t p = 0; p < plan_.perturbations.size(); ++p)
      for (const StabilityOutcome& outcome : result_.outcomes) {
        if (outcome.target != target) continue;
        const PerturbationOutcome& perturbed = outcome.perturbations[p];
        const Estimate f = perturbed.f_score();
        rows.push_back({to_string(perturbed.perturbation), name(outcome),
                        core::to_decimals(perturbed.found().mean, 1), rounded(f), width(f),
                        rounded(perturbed.recall()), rounded(perturbed.precision()),
                        rounded(perturbed.drift(), result_.mean_edge_length), rounded(perturbed.chance())});
      }
    return rows;
  }

  const StabilityPlan& plan_;
  const StabilityResult& result_;
};

}  // namespace

std::string stability_table(const StabilityPlan& plan, const StabilityResult& result) {
  return Tables(plan, result).text();
}

}  // namespace morsel::tools
