#include "morsel/tools/report/outcome_sections.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "morsel/tools/formats/version.h"

namespace morsel::tools {
namespace {

/// The values of a single step directly, of a chain by step.
template <class Values>
Json by_step(const std::vector<StepOutcome>& steps, Values StepOutcome::*values) {
  if (steps.size() == 1) return to_json(steps.front().*values);
  Json list = Json::array();
  for (const StepOutcome& step : steps)
    list.push_back({{"name", step.name}, {"values", to_json(step.*values)}});
  return {{"steps", std::move(list)}};
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

Json to_json(const core::ParameterValue& value) {
  return std::visit(
      [](const auto& held) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, double>) return finite_or_null(held);
        return held;
      },
      value);
}

Json to_json(const core::Parameters& parameters) {
  Json json = Json::object();
  for (const auto& [name, value] : parameters) json[name] = to_json(value);
  return json;
}

Json to_json(const std::vector<core::IterationRecord>& iterations) {
  Json list = Json::array();
  for (const core::IterationRecord& record : iterations)
    list.push_back({{"iteration", record.iteration},
                    {"minima", record.minima},
                    {"saddles", record.saddles},
                    {"saddle_multiplicity", record.saddle_multiplicity},
                    {"maxima", record.maxima},
                    {"total", record.total()},
                    {"change", record.change}});
  return list;
}

Json tool_section() { return {{"name", "morsel"}, {"version", kVersion}}; }

Json field_parameters(const FieldSummary& field, std::span<const HashedFile> known) {
  Json parameters = to_json(field.parameters);
  for (const core::FileParameter& file : field.files) {
    const auto hashed = std::ranges::find(known, file.path, &HashedFile::path);
    parameters[file.key + "_sha256"] = hashed != known.end() ? hashed->sha256 : sha256_of_file(file.path);
  }
  return parameters;
}

Json field_section(const FieldSummary& field, std::span<const HashedFile> known) {
  Json section = {{"name", field.name},
                  {"parameters", field_parameters(field, known)},
                  {"min", field.min},
                  {"max", field.max}};
  if (!field.warnings.empty()) section["warnings"] = field.warnings;
  return section;
}

Json field_section(const FieldOutcome& outcome) { return field_section(summary_of(outcome)); }

Json counts_section(const morse::CriticalPoints& points) {
  return {{"minima", points.minima},
          {"saddles", points.saddles},
          {"saddle_multiplicity", points.saddle_multiplicity},
          {"maxima", points.maxima},
          {"total", points.total()}};
}

Json persistence_section(const PersistenceSummary& summary) {
  Json above = Json::array();
  for (std::size_t i = 0; i < summary.above.size(); ++i)
    above.push_back({{"percent", PersistenceSummary::kPercents[i]}, {"pairs", summary.above[i]}});
  return {{"pairs", summary.pairs},
          {"infinite_pairs", summary.infinite_pairs},
          {"essential_saddles", summary.essential_saddles},
          {"max", summary.largest ? Json(*summary.largest) : Json()},
          {"above", std::move(above)}};
}

Json persistence_section(const persistence::Diagram& diagram, double extent) {
  return persistence_section(summary_of(diagram, extent));
}

Json complex_section(const mscomplex::MorseSmaleComplex& complex, const mscomplex::Segmentation& segmentation,
                     core::Index cells) {
  return {{"minima", complex.minimum_count()},
          {"saddles", complex.saddle_count()},
          {"maxima", complex.maximum_count()},
          {"caps", complex.cap_count()},
          {"arcs", complex.arc_count()},
          {"quads", complex.quad_count()},
          {"cells", cells},
          {"segments",
           {{"descending", segmentation.descending.count},
            {"ascending", segmentation.ascending.count},
            {"morse_smale", segmentation.morse_smale.count}}}};
}

Json timings_section(const Timings& timings) {
  Json json = Json::object();
  for (const auto& [step, seconds] : timings) json[step] = seconds;
  return json;
}

Json parameters_section(const std::vector<StepOutcome>& steps) {
  return by_step(steps, &StepOutcome::parameters);
}

Json steps_section(const std::vector<StepOutcome>& steps) {
  Json section = {{"parameters", parameters_section(steps)},
                  {"details", by_step(steps, &StepOutcome::details)},
                  {"iterations", by_step(steps, &StepOutcome::iterations)}};
  for (const StepOutcome& step : steps)
    for (const std::string& warning : step.warnings) section["warnings"].push_back(warning);
  return section;
}

Json target_section(const TargetOutcome& target, const core::VertexNumbering& numbering) {
  Json unfolded = Json::array();
  for (const core::Index v : target.unfolded) unfolded.push_back(numbering.input_vertex(v));
  return {{"wanted", target.wanted},
          {"reached", target.reached},
          {"iterations", target.iterations},
          {"left_by_next", target.left_by_next ? Json(*target.left_by_next) : Json()},
          {"before_cancelling", target.before_cancelling},
          {"cancelled_pairs", target.cancelled.size()},
          {"largest_cancelled", target.largest_cancelled},
          {"unfolded", unfolded},
          {"largest_unfolding", target.largest_unfolding},
          {"note", target.note}};
}

Json method_section(const MethodChain& chain, const ChainOutcome& outcome,
                    const core::VertexNumbering& numbering) {
  Json section = {{"name", chain.name}};
  section.update(steps_section(outcome.steps));
  if (outcome.target) section["target"] = target_section(*outcome.target, numbering);
  section["min"] = outcome.field.min();
  section["max"] = outcome.field.max();
  return section;
}

Json method_section(const FieldPlan& plan, const MadeField& made, const core::VertexNumbering& numbering) {
  return method_section(plan.chain, made.outcome, numbering);
}

}  // namespace morsel::tools
