/// Cut surfaces and quads as files and documents.

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/documents/module.h"
#include "morsel/python/documents/source.h"
#include "morsel/tools/export/cut_files.h"
#include "morsel/tools/report/cut_writer.h"
#include "morsel/tools/report/quads_writer.h"

namespace morsel::python {
namespace {

/// .off, .ply: the surface cut open; .vtp: the cut; .json: what was cut.
void write_cut(const CutHandle& cut, const std::string& path, const std::optional<std::string>& mesh_file,
               const tools::Registry& registry, const py::object& report) {
  const std::string extension = core::file_extension(path);
  if (extension != ".json" && extension != ".vtp") tools::check_cut_mesh_path(path);
  run_job(report, [&](const core::Progress& progress) {
    const DocumentField source(cut->field, {path, mesh_file}, registry, progress);
    const core::LoadedMesh& loaded = source.mesh().loaded;
    const tools::CutRequest request{source.request(), cut->shorten, source.mesh().build};
    const tools::CutOutcome& made = cut->made;
    if (extension == ".json")
      return write_document(path, [&](tools::JsonSink& json) {
        tools::write_cut_document(json, request, source.source(), made,
                                  {{"complex", made.complex_seconds},
                                   {"cut", made.cut_seconds},
                                   {"shorten", made.shorten_seconds},
                                   {"open", made.open_seconds}});
      });
    std::vector<std::string> words;
    if (!cut->shorten) words.emplace_back("--no-shorten");
    const tools::Provenance provenance = source.provenance("cut", words, tools::request_section(request));
    if (extension == ".vtp")
      tools::write_cut_graph(path, made.cut, loaded, provenance);
    else
      tools::write_cut_mesh(path, made.opened, loaded.source.numbering, provenance, progress);
  });
}

/// .obj: the quads; .json: counts, repairs and quality.
void write_quads(const QuadsHandle& quads, const std::string& path,
                 const std::optional<std::string>& mesh_file, const tools::Registry& registry,
                 const py::object& report) {
  const std::string extension = core::file_extension(path);
  if (extension != ".json" && extension != ".obj")
    throw core::InvalidArgument("quads are written to .obj or .json, not to " + path);
  run_job(report, [&](const core::Progress& progress) {
    const DocumentField source(quads->field, {path, mesh_file}, registry, progress);
    const tools::QuadsRequest request{source.request(), quads->request, source.mesh().build};
    const tools::Quadrangulation& made = quads->made;
    if (extension == ".json")
      return write_document(path, [&](tools::JsonSink& json) {
        tools::write_quads(json, request, source.source(), made,
                           {{"layout", made.layout_seconds},
                            {"sampling", made.sampling_seconds},
                            {"measuring", made.measuring_seconds}});
      });
    std::vector<std::string> words = {"--resolution", std::to_string(quads->request.resolution),
                                      "--relaxation", std::to_string(quads->request.relaxation)};
    if (!quads->request.persistence.empty())
      words.insert(words.end(), {"--persistence", quads->request.persistence});
    core::write_obj(path, made.mesh.positions, made.mesh.quads,
                    source.provenance("quads", words, tools::request_section(request)).lines(), progress);
  });
}

}  // namespace

void add_surface_documents(py::module_& m) {
  m.def("write_cut", &write_cut);
  m.def("write_quads", &write_quads);
}

}  // namespace morsel::python
