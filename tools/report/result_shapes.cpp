#include "morsel/tools/report/result_shapes.h"

#include <algorithm>
#include <optional>
#include <string>

#include "morsel/tools/study/summary.h"

namespace morsel::tools {
namespace {

void check_values(const JsonView& values) {
  for (const auto& [name, value] : values.members())
    if (value.json().is_structured()) value.refuse("is neither a number nor a text");
}

}  // namespace

void check_members(const JsonView& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) static_cast<void>(object[name]);
  for (const auto& [key, value] : object.members())
    if (std::find(names.begin(), names.end(), key) == names.end()) value.refuse("is not one of its members");
}

void check_counts(const JsonView& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) static_cast<void>(object[name].count());
}

void check_critical_points(const JsonView& points) {
  check_members(points, {"minima", "saddles", "saddle_multiplicity", "maxima", "total"});
  const std::uint64_t saddles = points["saddles"].count();
  if (points["saddle_multiplicity"].count() < saddles)
    points["saddle_multiplicity"].refuse("is less than the number of saddles");
  if (points["total"].count() != points["minima"].count() + saddles + points["maxima"].count())
    points["total"].refuse("is not the sum of minima, saddles and maxima");
}

void check_persistence(const JsonView& persistence) {
  check_members(persistence, {"pairs", "infinite_pairs", "essential_saddles", "max", "above"});
  check_counts(persistence, {"pairs", "infinite_pairs", "essential_saddles"});
  if (const JsonView max = persistence["max"]; !max.is_null()) static_cast<void>(max.number(0));
  constexpr auto& kPercents = PersistenceSummary::kPercents;
  const std::vector<JsonView> above = persistence["above"].list(kPercents.size(), kPercents.size());
  for (std::size_t i = 0; i < kPercents.size(); ++i) {
    check_counts(above[i], {"pairs"});
    if (above[i]["percent"].number() != kPercents[i])
      above[i]["percent"].refuse("is not that of every report");
  }
}

void check_parameters(const JsonView& parameters) {
  const std::optional<JsonView> steps = parameters.find("steps");
  if (!steps || !steps->json().is_array()) return check_values(parameters);
  for (const JsonView& step : steps->list(1)) {
    static_cast<void>(step["name"].text());
    check_values(step["values"]);
  }
}

void check_range(const JsonView& field) {
  if (field["min"].number() > field["max"].number()) field["min"].refuse("is larger than the maximum");
}

void check_field(const JsonView& field) {
  static_cast<void>(field["name"].text());
  check_parameters(field["parameters"]);
  check_range(field);
}

void check_sha256(const JsonView& hash) {
  const std::string& digits = hash.text();
  if (digits.size() != 64 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    hash.refuse("is not a SHA-256");
}

void check_mesh(const JsonView& mesh) {
  static_cast<void>(mesh["path"].path());
  check_sha256(mesh["sha256"]);
  check_counts(mesh, {"vertices", "edges", "faces", "components", "boundary_loops", "genus"});
  constexpr auto kMost = static_cast<std::int64_t>(JsonView::kMostCount);
  static_cast<void>(mesh["euler_characteristic"].integer(-kMost, kMost));
  static_cast<void>(mesh["bbox_diagonal"].number(0));
  for (const JsonView& repair : mesh["repairs"].list()) {
    static_cast<void>(repair["action"].text());
    check_counts(repair, {"count"});
  }
  if (const std::optional<JsonView> warnings = mesh.find("warnings"))
    for (const JsonView& warning : warnings->list(1)) static_cast<void>(warning.text());
}

}  // namespace morsel::tools
