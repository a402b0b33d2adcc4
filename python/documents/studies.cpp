/// Hierarchies, sweeps and stability as documents and tables.

#include <pybind11/stl.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/documents/module.h"
#include "morsel/python/documents/source.h"
#include "morsel/tools/export/hierarchy_export.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/report/hierarchy_writer.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/report/stability_table.h"
#include "morsel/tools/report/stability_writer.h"
#include "morsel/tools/report/sweep_writer.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::python {
namespace {

/// Writes a table as JSON or CSV.
void write_table(const std::string& path, const std::function<void(tools::JsonSink&)>& json,
                 const std::function<void(std::ostream&)>& csv) {
  const std::string extension = core::file_extension(path);
  if (extension == ".json") return write_document(path, json);
  if (extension != ".csv") throw core::InvalidArgument("a table is written to .json or .csv, not to " + path);
  core::FileWriter file(path);
  csv(file.stream());
  file.commit();
}

/// The files that the fields of a sweep read.
std::vector<tools::HashedFile> read_by(const SweepData& sweep) {
  std::set<std::string> fields;
  for (const tools::Combination& combination : sweep.plan.combinations)
    fields.insert(core::to_string(combination.field));
  return tools::input_files({fields.begin(), fields.end()}, sweep.plan.registry);
}

void write_sweep(const SweepHandle& sweep, const std::string& path,
                 const std::optional<std::string>& mesh_file, const py::object& report) {
  run_job(report, [&](const core::Progress& progress) {
    const std::vector<tools::HashedFile> files = read_by(*sweep);
    const DocumentMesh mesh = document_mesh(sweep->input, {path, mesh_file}, paths_of(files), progress);
    const tools::ReportInput about = mesh.about();
    const tools::SweepReport document{mesh.loaded, about, sweep->request, sweep->plan, sweep->rows, files};
    write_table(
        path, [&](tools::JsonSink& json) { tools::write_sweep(json, document); },
        [&](std::ostream& out) { tools::write_sweep_csv(out, document); });
  });
}

std::string sweep_table(const SweepHandle& sweep) {
  const tools::ReportInput about;
  const std::vector<tools::HashedFile> files;
  const core::LoadedMesh& loaded = sweep->input.mesh->loaded;
  return tools::sweep_table({loaded, about, sweep->request, sweep->plan, sweep->rows, files});
}

void write_stability(const StabilityHandle& stability, const std::string& path,
                     const std::optional<std::string>& mesh_file, const py::object& report) {
  run_job(report, [&](const core::Progress& progress) {
    std::vector<std::string> read;
    for (const tools::FieldOutcome& field : stability->result.fields)
      for (const std::string& file : files_of(field)) read.push_back(file);
    const DocumentMesh mesh = document_mesh(stability->input, {path, mesh_file}, read, progress);
    const tools::ReportInput about = mesh.about();
    const tools::StabilityReport document{mesh.loaded, about, stability->request, stability->plan,
                                          stability->result};
    write_table(
        path, [&](tools::JsonSink& json) { tools::write_stability(json, document); },
        [&](std::ostream& out) { tools::write_stability_csv(out, document); });
  });
}

/// What makes the levels again, one by one. Throws InvalidArgument where no command line does.
tools::HierarchyPlan plan_of(const LevelsData& levels, const tools::Registry& registry) {
  if (!levels.field->story.is_request) documented(*levels.field, registry);  // which says why it cannot be
  return tools::prepare(levels.request, registry);
}

DocumentMesh mesh_of(const LevelsData& levels, const DocumentPlace& place, const core::Progress& progress) {
  return document_mesh(study_input(levels.field), place, files_of(*levels.field->story.input), progress);
}

void write_hierarchy(const LevelsHandle& levels, const std::string& path,
                     const std::optional<std::string>& mesh_file, bool items, const tools::Registry& registry,
                     const py::object& report) {
  const tools::HierarchyPlan plan = plan_of(*levels, registry);
  run_job(report, [&](const core::Progress& progress) {
    const DocumentMesh mesh = mesh_of(*levels, {path, mesh_file}, progress);
    const tools::ReportInput about = mesh.about(items);
    const tools::HierarchyRequest request = tools::with_defaults(levels->request);
    write_document(path, [&](tools::JsonSink& json) {
      tools::HierarchyWriter writer(json, mesh.loaded, about, request, plan);
      tools::run_hierarchy(mesh.loaded, plan, {&writer}, progress);
      writer.finish();
    });
  });
}

std::string hierarchy_command(const tools::HierarchyRequest& request, const DocumentMesh& mesh) {
  std::vector<std::string> words = tools::words_of(request.field, mesh.build);
  tools::add_option(words, "--by",
                    request.kind == tools::HierarchyKind::iteration ? "iteration" : "persistence");
  if (!request.levels.empty()) tools::add_option(words, "--levels", request.levels);
  if (!request.counts.empty()) tools::add_option(words, "--counts", request.counts);
  return command_of("hierarchy", mesh, words);
}

void export_hierarchy(const LevelsHandle& levels, const std::string& folder,
                      const std::optional<std::string>& mesh_file, const tools::Registry& registry,
                      const py::object& report) {
  const tools::HierarchyPlan plan = plan_of(*levels, registry);
  run_job(report, [&](const core::Progress& progress) {
    tools::ResultFolder results(folder);
    const DocumentMesh mesh = mesh_of(*levels, {{}, mesh_file}, progress);
    const tools::HierarchyRequest request = tools::with_defaults(levels->request);
    tools::HierarchyExport files(
        results, mesh.loaded,
        {hierarchy_command(request, mesh), tools::request_section(request, mesh.about()), {mesh.file}});
    tools::run_hierarchy(mesh.loaded, plan, {&files}, progress);
  });
}

}  // namespace

void add_study_documents(py::module_& m) {
  m.def("write_sweep", &write_sweep);
  m.def("sweep_table", [](const SweepHandle& sweep) { return text(sweep_table(sweep)); });
  m.def("write_stability", &write_stability);
  m.def("stability_table", [](const StabilityHandle& stability) {
    return text(tools::stability_table(stability->plan, stability->result));
  });
  m.def("write_hierarchy", &write_hierarchy);
  m.def("export_hierarchy", &export_hierarchy);
}

}  // namespace morsel::python
