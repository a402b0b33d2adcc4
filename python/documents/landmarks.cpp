/// Chosen points compared with those that people marked, of lists of files and of meshes in memory.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/documents/module.h"
#include "morsel/python/documents/source.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/landmarks_table.h"
#include "morsel/tools/report/landmarks_writer.h"

namespace morsel::python {
namespace {

using core::Index;

/// Meshes and their marks, in memory; both in the mesh's own numbers.
class MarkedInMemory : public tools::MarkedMeshes {
 public:
  void add(const MeshHandle& mesh, std::vector<Index> marks) {
    const std::string name = mesh->path.empty() ? "mesh " + std::to_string(size()) : mesh->path;
    const Index count = mesh->mesh().vertex_count();
    if (marks.empty()) throw core::InvalidArgument(name + " has no marked vertex");
    std::vector<bool> is_marked(count, false);
    for (const Index v : marks) {
      if (v >= count)
        throw core::InvalidArgument(name + " has " + std::to_string(count) + " vertices, so none is number " +
                                    std::to_string(v));
      if (is_marked[v])
        throw core::InvalidArgument("vertex " + std::to_string(v) + " of " + name + " is marked twice");
      is_marked[v] = true;
    }
    meshes_.push_back({mesh, name, std::move(marks)});
  }
  std::size_t size() const override { return meshes_.size(); }
  std::string name(std::size_t i) const override { return meshes_[i].name; }
  tools::MarkedMesh load(std::size_t i, const core::Progress&) override {
    return {in_own_numbers(meshes_[i].mesh->loaded), meshes_[i].marks, {}};
  }

 private:
  struct Marked {
    MeshHandle mesh;
    std::string name;
    std::vector<Index> marks;
  };
  std::vector<Marked> meshes_;
};

struct LandmarksData {
  std::unique_ptr<tools::MarkedFiles> files;  ///< null where meshes are in memory
  std::vector<std::string> names;             ///< of the meshes
  tools::LandmarksPlan plan;
  std::vector<tools::HashedFile> field_files;
  std::vector<tools::LandmarksOnMesh> meshes;
  std::vector<tools::LandmarksSummary> summaries;
  double seconds = 0;
};
using LandmarksHandle = std::shared_ptr<LandmarksData>;

tools::LandmarksRequest request_of(const py::dict& given) {
  tools::LandmarksRequest request;
  const RequestReader reader(given);
  reader.take("fields", request.fields);
  reader.take("methods", request.methods);
  reader.take("points", request.count);
  reader.take_length("radius", request.radius);
  reader.take_length("largest_radius", request.largest_radius);
  reader.take("first", request.first);
  reader.take("resamples", request.resamples);
  reader.take("seed", request.seed);
  if (request.first > 1) throw core::InvalidArgument("the first vertex of a file is number 0 or 1");
  request.choice = points_request(given["choice"].cast<py::dict>());
  return request;
}

void run(LandmarksData& data, tools::MarkedMeshes& meshes, const core::Progress& progress) {
  const tools::Stopwatch watch;
  for (std::size_t i = 0; i < meshes.size(); ++i) data.names.push_back(meshes.name(i));
  data.meshes = tools::run_landmarks(meshes, data.plan, progress);
  data.summaries = tools::summarize(data.plan, data.meshes);
  data.seconds = watch.seconds();
}

LandmarksHandle landmarks_of_list(const std::string& list, bool repair,
                                  const std::optional<std::string>& weld,
                                  const std::optional<std::string>& mask, const py::dict& given,
                                  const tools::Registry& registry, const py::object& report) {
  auto data = std::make_shared<LandmarksData>();
  data->plan = tools::prepare(request_of(given), registry);
  const core::BuildOptions build =
      tools::build_for(data->plan.functions, build_options({repair, weld, mask}));
  run_job(report, [&](const core::Progress& progress) {
    const tools::LandmarksRequest& request = data->plan.request;
    data->files = std::make_unique<tools::MarkedFiles>(list, request.first, build);
    data->field_files = tools::input_files(tools::fields_of(request), registry);
    run(*data, *data->files, progress);
  });
  return data;
}

/// `marked`: pairs of a mesh and an array of vertices.
LandmarksHandle landmarks_of_meshes(const std::vector<std::pair<MeshHandle, py::array>>& marked,
                                    const py::dict& given, const tools::Registry& registry,
                                    const py::object& report) {
  if (marked.empty()) throw core::InvalidArgument("there is no marked mesh");
  MarkedInMemory meshes;
  for (const auto& [mesh, marks] : marked) meshes.add(mesh, indices_from(marks, "the marked vertices"));
  auto data = std::make_shared<LandmarksData>();
  data->plan = tools::prepare(request_of(given), registry);
  run_job(report, [&](const core::Progress& progress) { run(*data, meshes, progress); });
  return data;
}

/// (mean, low, high), without an interval None for both.
py::tuple mean_of(const tools::MeshMean& of) {
  const auto end = [&](double tools::Interval::*which) -> py::object {
    return of.interval ? py::cast((*of.interval).*which) : py::none();
  };
  return py::make_tuple(of.mean, end(&tools::Interval::low), end(&tools::Interval::high));
}

py::dict row(const LandmarksData& data, std::size_t i) {
  const tools::LandmarksSummary& s = data.summaries[i];
  const bool is_made = i < data.plan.made_rows();
  const tools::LandmarksRequest& request = data.plan.request;
  py::dict result;
  result["name"] = text(data.plan.name_of(i));
  result["field"] = is_made ? py::object(text(request.fields[data.plan.field_of(i)])) : py::none();
  result["method"] = is_made ? py::object(text(request.methods[data.plan.method_of(i)])) : py::none();
  result["points"] = mean_of(s.points);
  result["recall"] = mean_of(s.recall);
  result["precision"] = mean_of(s.precision);
  result["f_score"] = mean_of(s.f_score);
  result["matched_recall"] = mean_of(s.matched_recall);
  result["matched_precision"] = mean_of(s.matched_precision);
  result["matched_f_score"] = mean_of(s.matched_f_score);
  result["false_negatives"] = mean_of(s.false_negatives);
  result["false_positives"] = mean_of(s.false_positives);
  result["f_score_gain"] = mean_of(s.f_score_gain);
  result["distance"] = s.distance;
  result["fewer"] = s.fewer;
  return result;
}

py::list rows(const LandmarksData& data) {
  py::list list;
  for (std::size_t i = 0; i < data.summaries.size(); ++i) list.append(row(data, i));
  return list;
}

/// What each row has on a mesh: (name, marks, [(chosen points, F-score, note)]).
py::tuple on_mesh(const LandmarksHandle& data, std::size_t i) {
  if (i >= data->meshes.size()) throw py::index_error("there is no such mesh");
  const tools::LandmarksOnMesh& mesh = data->meshes[i];
  py::list list;
  for (const tools::LandmarkRow& row : mesh.rows)
    list.append(py::make_tuple(view_of(std::span<const Index>(row.points), data),
                               row.mean([](const tools::MarkScore& score) { return score.f_score(); }),
                               text(row.note)));
  return py::make_tuple(text(data->names[i]), mesh.marks, list);
}

/// (what, texts) of all warnings, once each.
py::list warnings(const LandmarksData& data) {
  py::list list;
  const auto tell = [&](const std::string& what, const std::vector<std::string>& all) {
    if (!all.empty()) list.append(py::make_tuple(text(what), texts(all)));
  };
  for (std::size_t i = 0; i < data.meshes.size(); ++i) {
    if (data.files) tell(data.names[i], data.files->warnings(i));
    tell(data.names[i], data.meshes[i].warnings);
    for (const tools::FieldSummary& field : data.meshes[i].fields)
      tell(data.names[i] + ": " + field.name, field.warnings);
    for (const tools::LandmarkRow& row : data.meshes[i].rows) {
      tell(data.names[i], row.warnings);
      if (row.fill) tell(data.names[i] + ": " + row.fill->name, row.fill->warnings);
    }
  }
  return list;
}

void write_landmarks(const LandmarksHandle& data, const std::string& path, const py::object& report) {
  const std::string extension = core::file_extension(path);
  if (extension != ".json" && extension != ".csv")
    throw core::InvalidArgument("landmarks are written to .json or .csv, not to " + path);
  if (!data->files)
    throw core::InvalidArgument(
        "the document of a study of landmarks names files: make it of a list of files to write it");
  std::vector<std::string> read = paths_of(data->field_files);
  read.push_back(data->files->list().path);
  for (std::size_t i = 0; i < data->files->size(); ++i) {
    read.push_back(data->files->path_of(i).string());
    read.push_back(data->files->marks_path_of(i).string());
  }
  check_outputs({path}, {}, read);
  run_job(report, [&](const core::Progress&) {
    const tools::LandmarksReport document{*data->files,    data->plan,        data->meshes,
                                          data->summaries, data->field_files, data->seconds};
    if (extension == ".json")
      return write_document(path, [&](tools::JsonSink& json) { tools::write_landmarks(json, document); });
    core::FileWriter file(path);
    tools::write_landmarks_csv(file.stream(), document);
    file.commit();
  });
}

}  // namespace

void add_landmarks(py::module_& m) {
  py::class_<LandmarksData, LandmarksHandle>(m, "Landmarks")
      .def("__len__", [](const LandmarksData& data) { return data.meshes.size(); })
      .def("rows", &rows)
      .def("on_mesh", &on_mesh)
      .def("warnings", &warnings)
      .def_property_readonly("seed", [](const LandmarksData& data) { return data.plan.request.seed; })
      .def("table", [](const LandmarksData& data) {
        return text(tools::landmarks_table(data.plan, data.meshes, data.summaries));
      });
  m.def("landmarks_of_list", &landmarks_of_list);
  m.def("landmarks_of_meshes", &landmarks_of_meshes);
  m.def("write_landmarks", &write_landmarks);
}

}  // namespace morsel::python
