#include "morsel/tools/report/landmarks_table.h"

#include <string_view>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/text_table.h"

namespace morsel::tools {
namespace {

std::string with_decimals(double value) { return core::to_decimals(value, 3); }

std::string range(const std::optional<Interval>& interval, std::string_view sign = "") {
  if (!interval) return "";
  const auto signed_text = [&](double value) {
    return (value > 0 ? std::string(sign) : std::string()) + core::to_decimals(value, 2);
  };
  return signed_text(interval->low) + " to " + signed_text(interval->high);
}

std::string run_described(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes) {
  std::size_t marks = 0;
  for (const LandmarksOnMesh& mesh : meshes) marks += mesh.marks;
  const LandmarksRequest& request = plan.request;
  const std::string points = request.count ? grouped(*request.count) + " points on each mesh"
                                           : "as many points as each mesh has marks";
  return grouped(meshes.size()) + (meshes.size() == 1 ? " mesh, " : " meshes, ") + grouped(marks) +
         (marks == 1 ? " mark; " : " marks; ") + points + " (" + std::string(to_string(request.choice.kind)) +
         " by " + std::string(to_string(request.choice.rank)) + ", " +
         core::to_string(request.choice.spacing) + " apart); hits within " + core::to_string(request.radius) +
         " along the surface; seed " + std::to_string(request.seed) + "\n";
}

std::string columns_explained(const LandmarksPlan& plan, bool has_intervals) {
  std::string text =
      "recall: marks with a point within the radius; precision: points with a mark; F: their harmonic mean\n"
      "1:1 F: of pairs, each point with one mark; missed, false: FNE and FPE of Dutagaci et al. 2012\n";
  if (has_intervals)
    text += "95 %: bootstrap over the meshes, " + grouped(plan.request.resamples) +
            " resamples; gain: of F over the first row, mesh by mesh.\n";
  return text;
}

}  // namespace

std::string landmarks_table(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes,
                            const std::vector<LandmarksSummary>& summaries) {
  std::vector<std::vector<std::string>> rows = {
      {"", "points", "F", "95 %", "recall", "precision", "1:1 F", "missed", "false", "gain, 95 %"}};
  for (std::size_t row = 0; row < summaries.size(); ++row) {
    const LandmarksSummary& sum = summaries[row];
    rows.push_back({plan.name_of(row), core::to_decimals(sum.points.mean, 1), with_decimals(sum.f_score.mean),
                    range(sum.f_score.interval), with_decimals(sum.recall.mean),
                    with_decimals(sum.precision.mean), with_decimals(sum.matched_f_score.mean),
                    with_decimals(sum.false_negatives.mean), with_decimals(sum.false_positives.mean),
                    row == 0 ? "" : range(sum.f_score_gain.interval, "+")});
  }
  return run_described(plan, meshes) + text_table(rows) + columns_explained(plan, meshes.size() > 1);
}

}  // namespace morsel::tools
