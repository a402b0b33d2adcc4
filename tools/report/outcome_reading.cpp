#include "morsel/tools/report/outcome_reading.h"

#include <limits>
#include <optional>

#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {
namespace {

core::ParameterValue read_value(const JsonView& value) {
  const Json& json = value.json();
  if (json.is_boolean()) return value.truth();
  if (json.is_string()) return value.text();
  if (json.is_number_integer())
    return value.integer(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();  // as to_json() writes it
  return value.number();
}

core::Parameters read_parameters(const JsonView& values) {
  core::Parameters parameters;
  for (const auto& [name, value] : values.members()) parameters.emplace_back(name, read_value(value));
  return parameters;
}

}  // namespace

FieldSummary read_field(const JsonView& field) {
  check_field(field);
  FieldSummary summary{field["name"].text(), read_parameters(field["parameters"]), field["min"].number(),
                       field["max"].number()};
  if (const std::optional<JsonView> warnings = field.find("warnings"))
    for (const JsonView& warning : warnings->list(1)) summary.warnings.push_back(warning.text());
  return summary;
}

std::vector<StepOutcome> read_steps(const JsonView& method) {
  const JsonView parameters = method["parameters"];
  const std::optional<JsonView> listed = parameters.find("steps");
  if (!listed || !listed->json().is_array())
    return {{method["name"].text(), read_parameters(parameters), {}, {}}};
  std::vector<StepOutcome> steps;
  for (const JsonView& step : listed->list(2))
    steps.push_back({step["name"].text(), read_parameters(step["values"]), {}, {}});
  return steps;
}

}  // namespace morsel::tools
