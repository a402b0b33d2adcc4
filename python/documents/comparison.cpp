/// Comparisons as reports, tables, pages and files for other programs; checks of reports.

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/documents/module.h"
#include "morsel/python/documents/source.h"
#include "morsel/tools/export/export_sink.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/html/html_sink.h"
#include "morsel/tools/report/comparison_table.h"
#include "morsel/tools/report/report_check.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::python {
namespace {

/// Hands a sink what a comparison kept.
void replay(const ComparisonData& comparison, tools::ComparisonSink& sink, const core::Progress& progress) {
  sink.field(*comparison.field);
  for (const auto& method : comparison.methods) {
    progress.throw_if_cancelled();
    sink.begin_method(method->name);
    sink.method(*method);
  }
}

std::string table(const ComparisonHandle& comparison) {
  tools::ComparisonTable table;
  run_job(py::none(), [&](const core::Progress& progress) { replay(*comparison, table, progress); });
  return table.text();
}

void write_report(const ComparisonHandle& comparison, const std::string& path,
                  const std::optional<std::string>& mesh_file, bool items, const py::object& report) {
  run_job(report, [&](const core::Progress& progress) {
    core::FileWriter file(path);  // before the mesh is written
    const DocumentMesh mesh = document_mesh(comparison->input, {path, mesh_file, true, true},
                                            files_of(*comparison->field), progress);
    tools::JsonStream json(file.stream());
    tools::ReportWriter writer(json, mesh.loaded, mesh.about(items), comparison->request);
    replay(*comparison, writer, progress);
    writer.finish();
    file.commit();
  });
}

/// `page`: the one that is written; empty for none.
std::string comparison_command(const ComparisonData& comparison, const DocumentMesh& mesh,
                               const std::string& page = {}) {
  std::vector<std::string> words = tools::words_of(comparison.request, mesh.repair);
  if (!page.empty()) tools::add_option(words, "--html", page);
  return command_of("compare", mesh, words);
}

tools::Provenance provenance_of(const ComparisonData& comparison, const DocumentMesh& mesh) {
  return {comparison_command(comparison, mesh),
          tools::request_section(mesh.about(), comparison.request),
          {mesh.file}};
}

/// `is_kept`: whether the page names its own path, as one that `morsel compare --html` writes does.
void write_page(const ComparisonHandle& comparison, const std::string& path,
                const std::optional<std::string>& mesh_file, bool is_kept, const py::object& report) {
  run_job(report, [&](const core::Progress& progress) {
    const DocumentMesh mesh = document_mesh(comparison->input, {path, mesh_file, false, true},
                                            files_of(*comparison->field), progress);
    core::FileWriter file(path);
    tools::HtmlSink page(file, mesh.loaded, mesh.about(), comparison->request,
                         comparison_command(*comparison, mesh, is_kept ? path : ""),
                         provenance_of(*comparison, mesh));
    replay(*comparison, page, progress);
    page.finish();
    file.commit();
  });
}

void export_to(const ComparisonHandle& comparison, const std::string& folder,
               const std::optional<std::string>& mesh_file, bool glb, const py::object& report) {
  run_job(report, [&](const core::Progress& progress) {
    tools::ResultFolder results(folder);
    const DocumentMesh mesh =
        document_mesh(comparison->input, {{}, mesh_file}, files_of(*comparison->field), progress);
    tools::ExportSink sink(results, mesh.loaded, provenance_of(*comparison, mesh), glb);
    replay(*comparison, sink, progress);
  });
}

/// (path of the mesh or of the list of meshes, whether it is missing, [(where, before, after)])
py::tuple check(const std::string& path, const tools::Registry& registry, const py::object& report) {
  const tools::ReportCheck result = compute(
      report, [&](const core::Progress& progress) { return tools::check_report(path, progress, registry); });
  py::list differences;
  for (const tools::Difference& one : result.differences)
    differences.append(py::make_tuple(text(one.where), text(one.before), text(one.after)));
  return py::make_tuple(text(result.input_path), result.input_is_missing, differences);
}

}  // namespace

void add_comparison_documents(py::module_& m) {
  m.def("comparison_table", [](const ComparisonHandle& comparison) { return text(table(comparison)); });
  m.def("write_report", &write_report);
  m.def("write_page", &write_page);
  m.def("export_comparison", &export_to);
  m.def("check", &check);
}

}  // namespace morsel::python
