#include "morsel/tools/report/stability_writer.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

Json estimate_section(const Estimate& estimate) {
  if (estimate.count == 0) return nullptr;
  return {{"mean", estimate.mean},
          {"deviation", estimate.count > 1 ? Json(estimate.deviation) : Json()},
          {"half_width", estimate.half_width ? Json(*estimate.half_width) : Json()}};
}

Cell cell(const std::optional<double>& value) { return value ? Cell(*value) : Cell(nullptr); }

void write_trials(JsonSink& json, const PerturbationOutcome& perturbed, double edge) {
  json.begin_array("runs");
  for (std::size_t t = 0; t < perturbed.trials.size(); ++t) {
    const Trial& trial = perturbed.trials[t];
    const Agreement& agreement = trial.agreement;
    std::optional<double> drift = agreement.drift();
    if (drift) *drift /= edge;
    json.row({{"trial", std::uint64_t{t + 1}},
              {"minima", std::uint64_t{trial.points.minima}},
              {"saddles", std::uint64_t{trial.points.saddles}},
              {"saddle_multiplicity", std::uint64_t{trial.points.saddle_multiplicity}},
              {"maxima", std::uint64_t{trial.points.maxima}},
              {"found", std::uint64_t{agreement.found}},
              {"matched", std::uint64_t{agreement.matched}},
              {"recall", agreement.recall()},
              {"precision", agreement.precision()},
              {"f_score", agreement.f_score()},
              {"drift", cell(drift)},
              {"chance", trial.chance}});
  }
  json.end_array();
}

Estimate in_edges(Estimate drift, double edge) {
  drift.mean /= edge;
  drift.deviation /= edge;
  if (drift.half_width) *drift.half_width /= edge;
  return drift;
}

void write_perturbation(JsonSink& json, const PerturbationOutcome& perturbed, double edge) {
  const Perturbation& perturbation = perturbed.perturbation;
  json.begin_object();
  json.member("perturbation", to_string(perturbation.kind));
  json.member("amount", perturbation.amount);
  json.member("trials", perturbed.trials.size());
  json.member("points", estimate_section(perturbed.found()));
  json.member("recall", estimate_section(perturbed.recall()));
  json.member("precision", estimate_section(perturbed.precision()));
  json.member("f_score", estimate_section(perturbed.f_score()));
  json.member("drift", estimate_section(in_edges(perturbed.drift(), edge)));
  json.member("chance", estimate_section(perturbed.chance()));
  write_trials(json, perturbed, edge);
  json.end_object();
}

void write_outcome(JsonSink& json, const StabilityReport& report, const StabilityOutcome& outcome) {
  json.begin_object();
  json.member("field", report.plan.functions[outcome.field].specification);
  json.member("method", report.plan.chains[outcome.method].specification);
  json.member("target", outcome.target ? Json(*outcome.target) : Json());
  json.begin_object("clean");
  Json made =
      method_section(report.plan.chains[outcome.method], outcome.clean, report.loaded.source.numbering);
  made.erase("iterations");  // they are not counted
  for (const auto& [key, value] : made.items()) json.member(key, value);
  json.member("critical_points", counts_section(outcome.points));
  json.member("points", outcome.with_reference.found);
  json.end_object();
  json.member("agreement", {{"share", outcome.agreement()},
                            {"chance", outcome.chance},
                            {"matched", outcome.with_reference.matched},
                            {"reference_points", outcome.with_reference.reference}});
  json.begin_array("perturbations");
  for (const PerturbationOutcome& perturbed : outcome.perturbations)
    write_perturbation(json, perturbed, report.result.mean_edge_length);
  json.end_array();
  json.end_object();
}

void add(CsvLine& line, const Estimate& estimate) {
  line.add(estimate.count > 0 ? std::optional(estimate.mean) : std::nullopt);
  line.add(estimate.half_width);
}

}  // namespace

Json request_section(const StabilityRequest& request, const core::BuildOptions& build) {
  Json asked = {{"fields", request.fields},
                {"methods", request.methods},
                {"noise", request.noise},
                {"kind", to_string(request.noise_kind)},
                {"decimate", request.decimate},
                {"subdivide", request.subdivide},
                {"trials", request.trials},
                {"seed", request.seed},
                {"radius", request.radius},
                {"points", to_string(request.points)},
                {"reference_field", request.reference_field},
                {"reference", request.reference},
                {"repair", build.repair}};
  add_build_options(asked, build);
  if (request.target) asked["target"] = *request.target;
  return asked;
}

Json trials_key(const StabilityRequest& request, const ReportInput& input, const Registry& registry) {
  Json asked = request_section(request, input.build);
  for (const char* key : {"noise", "kind", "decimate", "subdivide", "trials"}) asked.erase(key);
  if (!input.format.empty()) asked["format"] = input.format;
  return {{"schema", "morsel.stability/1"},
          {"tool", tool_section()},
          {"mesh", input.mesh_sha256},
          {"request", std::move(asked)},
          {"files", files_section(input_files(request, registry))}};
}

void write_stability(JsonSink& json, const StabilityReport& report) {
  const StabilityResult& result = report.result;
  const double diagonal = report.loaded.mesh.bounding_box().diagonal();
  json.begin_object();
  json.member("schema", "morsel.stability/1");
  json.member("tool", tool_section());
  json.member("request", request_section(report.request, report.input.build));
  json.member("mesh", mesh_section(report.input.mesh_path, report.input.mesh_sha256, report.loaded));
  Json matching = {{"radius", result.radius},
                   {"radius_of_diagonal", result.radius / diagonal},
                   {"mean_edge_length", result.mean_edge_length},
                   {"confidence", kConfidence},
                   {"placements", kPlacements}};
  if (const std::vector<std::string> warnings = result.warnings(); !warnings.empty())
    matching["warnings"] = warnings;
  json.member("matching", matching);
  json.begin_array("fields");
  for (std::size_t f = 0; f < result.fields.size(); ++f) {
    Json section = {{"specification", report.plan.functions[f].specification}};
    section.update(field_section(result.fields[f]));
    json.begin_object();
    for (const auto& [key, value] : section.items()) json.member(key, value);
    json.end_object();
  }
  json.end_array();
  json.begin_array("outcomes");
  for (const StabilityOutcome& outcome : result.outcomes) write_outcome(json, report, outcome);
  json.end_array();
  json.member("timings",
              {{"load", report.input.load_seconds},
               {"clean", result.clean_seconds},
               {"trials", result.trial_seconds},
               {"total", report.input.load_seconds + result.clean_seconds + result.trial_seconds}});
  json.end_object();
}

void write_stability_csv(std::ostream& out, const StabilityReport& report) {
  CsvTable table(out, {"version",      "mesh",
                       "sha256",       "seed",
                       "radius",       "compared",
                       "field",        "field_parameters",
                       "method",       "method_parameters",
                       "target",       "clean_points",
                       "agreement",    "agreement_chance",
                       "perturbation", "amount",
                       "kind",         "trials",
                       "points",       "points_half_width",
                       "f_score",      "f_score_half_width",
                       "recall",       "recall_half_width",
                       "precision",    "precision_half_width",
                       "drift",        "drift_half_width",
                       "chance",       "chance_half_width"});
  const StabilityResult& result = report.result;
  std::vector<Json> parameters;
  parameters.reserve(result.fields.size());
  for (const FieldOutcome& field : result.fields) parameters.push_back(field_parameters(summary_of(field)));
  for (const StabilityOutcome& outcome : result.outcomes)
    for (const PerturbationOutcome& perturbed : outcome.perturbations) {
      const Perturbation& perturbation = perturbed.perturbation;
      const bool is_noise = perturbation.kind == PerturbationKind::noise;
      CsvLine line;
      line.add(kVersion);
      line.add_path(report.input.mesh_path);
      line.add(report.input.mesh_sha256);
      line.add(std::uint64_t{report.plan.seed});
      line.add(result.radius);
      line.add(to_string(report.plan.points));
      line.add(report.plan.functions[outcome.field].specification);
      line.add_json(parameters[outcome.field]);
      line.add(report.plan.chains[outcome.method].specification);
      line.add_json(parameters_section(outcome.clean.steps));
      line.add(outcome.target ? std::to_string(*outcome.target) : "");
      line.add(std::uint64_t{outcome.with_reference.found});
      line.add(outcome.agreement());
      line.add(outcome.chance);
      line.add(to_string(perturbation.kind));
      line.add(perturbation.amount);
      line.add(is_noise ? to_string(perturbation.direction) : "");
      line.add(std::uint64_t{perturbed.trials.size()});
      add(line, perturbed.found());
      add(line, perturbed.f_score());
      add(line, perturbed.recall());
      add(line, perturbed.precision());
      add(line, in_edges(perturbed.drift(), result.mean_edge_length));
      add(line, perturbed.chance());
      table.add(line);
    }
}

}  // namespace morsel::tools
