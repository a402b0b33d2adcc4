#include "morsel/tools/reproduce/document.h"

#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/reproduce/table.h"

namespace morsel::tools::reproduce {
namespace {

Json request_section(const Request& request) {
  Json section = {{"data", nullptr},
                  {"meshes", request.samples.string()},
                  {"size", request.size},
                  {"samples", request.pixel_samples},
                  {"views", request.views},
                  {"up", request.ups},
                  {"repair", request.build.repair}};
  add_build_options(section, request.build);
  if (!request.data.empty()) section["data"] = request.data.string();
  return section;
}

Json model_section(const Model& model, const PictureOptions& pictures) {
  return {{"name", model.recipe().name},
          {"paper", model.recipe().paper},
          {"sample", model.file().is_sample},
          {"made", model.file().is_made},
          {"view", pictures.camera.view},
          {"mesh", mesh_section(model.file().path, model.sha256(), model.loaded())}};
}

/// A method on the field, with all its parameters and counts.
Json run_section(const Model& model, const MethodRun& run) {
  return {{"specification", run.plan.chain.specification},
          {"field", field_section(run.made.input)},
          {"method", method_section(run.plan, run.made, model.loaded().source.numbering)},
          {"critical_points", counts_section(run.measurement.critical_points)},
          {"ms_complex",
           complex_section(run.measurement.complex, run.measurement.segmentation, run.measurement.cells)}};
}

Json panel_section(const Model& model, const PanelOutcome& panel, std::size_t number) {
  Json section = {{"panel", std::string(1, static_cast<char>('a' + number))},
                  {"title", panel.recipe->title},
                  {"file", panel.file},
                  {"command", command_line(panel.command())},
                  {"paper", nullptr}};
  if (!panel.recipe->paper.empty()) section["paper"] = panel.recipe->paper;
  section.update(run_section(model, *panel.run));
  return section;
}

Json region_section(const Model& model, const ComparedRegion& region) {
  return {{"vertex", model.loaded().source.numbering.input_vertex(region.vertex)},
          {"radius", core::to_string(region.radius)},
          {"all", region.all},
          {"first", region.first},
          {"second", region.second},
          {"places", region.places},
          {"more_of_first", region.more_of_first},
          {"more_of_second", region.more_of_second}};
}

Json figure_section(const FigureOutcome& figure) {
  const int number = figure.recipe->number;
  Json section = {{"figure", number > 0 ? Json(number) : Json()},
                  {"section", number > 0 ? Json() : Json(figure.recipe->section)},
                  {"title", figure.recipe->title},
                  {"model", figure.model->recipe().name},
                  {"file", figure.file},
                  {"paper", figure.recipe->paper},
                  {"here", figure.finding},
                  {"panels", Json::array()}};
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    section["panels"].push_back(panel_section(*figure.model, figure.panels[i], i));
  if (figure.region) section["region"] = region_section(*figure.model, *figure.region);
  if (!figure.levels.empty()) {
    section["levels"] = Json::array();
    for (const LevelLinks& level : figure.levels)
      section["levels"].push_back({{"points", level.points},
                                   {"segments", level.cells},
                                   {"kept", level.kept},
                                   {"moved", level.moved},
                                   {"new", level.fresh}});
  }
  return section;
}

Json percentile_section(const std::optional<double>& percentile) {
  return percentile ? Json(*percentile) : Json();
}

Json row_section(const TableRowOutcome& row) {
  Json section = {{"model", row.model->recipe().name},
                  {"figure", row.recipe->figure},
                  {"iterations", row.recipe->iterations},
                  {"paper", {{"points", nullptr}, {"seconds", nullptr}}},
                  {"runs", Json::array()}};
  if (row.recipe->paper_points) section["paper"]["points"] = *row.recipe->paper_points;
  if (row.recipe->paper_seconds) section["paper"]["seconds"] = *row.recipe->paper_seconds;
  for (const TableCell& cell : row.cells) {
    section["runs"].push_back(run_section(*row.model, *cell.run));
    section["runs"].back()["percentile"] = percentile_section(cell.percentile);
  }
  return section;
}

Json control_section(const ControlOutcome& control) {
  Json section = {{"model", control.model->recipe().name},
                  {"figure", control.row->figure},
                  {"iterations", control.row->iterations},
                  {"control", control.recipe->title},
                  {"rank", control.recipe->rank ? Json(to_string(*control.recipe->rank)) : Json()},
                  {"extrema", control.extrema},
                  {"percentile", percentile_section(control.percentile)}};
  section.update(run_section(*control.model, *control.run));
  return section;
}

/// Seconds of every run of the table, row by row, and of the steps.
Json all_timings(const Reproduction& reproduction) {
  Json section = timings_section(reproduction.timings);
  section["table"] = Json::array();
  for (const TableRowOutcome& row : reproduction.table) {
    Json seconds = Json::array();
    for (const TableCell& cell : row.cells) seconds.push_back(cell.run->seconds);
    section["table"].push_back(std::move(seconds));
  }
  return section;
}

}  // namespace

Provenance provenance_of(const Request& request, const std::vector<const Model*>& models) {
  std::vector<HashedFile> meshes;
  for (const Model* model : models) meshes.push_back({model->file().path.string(), model->sha256()});
  return {command_line(command_words(request)), request_section(request), meshes};
}

Provenance page_provenance(const Prepared& prepared, const Reproduction& reproduction) {
  std::vector<const Model*> models;
  Json runs = Json::array();
  for (const auto& model : reproduction.models) {
    models.push_back(model.get());
    for (const auto& [name, run] : model->runs())
      runs.push_back({{"model", model->recipe().name},
                      {"function", run->made.input.name},
                      {"field", to_json(run->made.input.parameters)},
                      {"method", name.second},
                      {"parameters", parameters_section(run->made.outcome.steps)}});
  }
  Provenance provenance = provenance_of(prepared.request, models);
  provenance.set("runs", std::move(runs));
  return provenance;
}

void write_document(JsonSink& json, const Prepared& prepared, const Reproduction& reproduction) {
  Json models = Json::array();
  for (std::size_t i = 0; i < reproduction.models.size(); ++i)
    models.push_back(model_section(*reproduction.models[i], prepared.pictures[i]));
  Json figures = Json::array();
  for (const FigureOutcome& figure : reproduction.figures) figures.push_back(figure_section(figure));
  Json table = Json::array();
  for (const TableRowOutcome& row : reproduction.table) table.push_back(row_section(row));
  Json controls = Json::array();
  for (const ControlOutcome& control : reproduction.controls) controls.push_back(control_section(control));
  json.begin_object();
  json.member("schema", "morsel.reproduction/1");
  json.member("tool", tool_section());
  json.member("request", request_section(prepared.request));
  json.member("models", models);
  json.member("figures", figures);
  json.member("table", table);
  json.member("controls", controls);
  json.member("timings", all_timings(reproduction));
  json.end_object();
}

}  // namespace morsel::tools::reproduce
