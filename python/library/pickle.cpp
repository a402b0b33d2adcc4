/// Meshes and fields as tuples of arrays, numbers and texts, which pickle takes, and back.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/io/vertex_mask.h"
#include "morsel/core/text/parameters.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"

namespace morsel::python {
namespace {

using core::Index;
using core::ScalarField;

/// The elements of an array that field_state() or mesh_state() made.
template <class T>
std::vector<T> elements_of(const py::handle& array) {
  const auto elements = array.cast<py::array_t<T, py::array::c_style>>();
  return {elements.data(), elements.data() + elements.size()};
}

py::tuple mesh_state(const MeshHandle& mesh) {
  const core::MeshSource& source = mesh->loaded.source;
  py::list repairs;
  for (const core::Repair& repair : source.repairs)
    repairs.append(py::make_tuple(text(repair.action), repair.count));
  py::list properties;
  for (const core::VertexProperty& property : source.properties)
    properties.append(
        py::make_tuple(text(property.name), view_of(std::span<const double>(property.values), mesh)));
  return py::make_tuple(
      rows_of(mesh->mesh().positions(), mesh), rows_of<Index, 3>(mesh->mesh().triangles(), mesh),
      py::bytes(mesh->path), mesh->build.repair, std::int64_t{mesh->file_time.time_since_epoch().count()},
      source.numbering.input_count, taken(std::vector<Index>(source.numbering.to_input)),
      taken(std::vector<Index>(source.numbering.from_input)), repairs, properties, py::bytes(mesh->file),
      mesh->build.weld ? py::object(text(core::to_string(*mesh->build.weld))) : py::none(),
      texts(source.warnings),
      mesh->build.mask ? py::object(text(core::to_string(*mesh->build.mask))) : py::none());
}

MeshHandle restored_mesh(const py::tuple& state) {
  std::vector<core::Point> points = points_from(state[0].cast<py::array>(), "the vertices");
  std::vector<core::Triangle> triangles = triangles_from(state[1].cast<py::array>());
  using FileTime = std::filesystem::file_time_type;
  const FileTime time{FileTime::duration(state[4].cast<std::int64_t>())};
  core::MeshSource source{
      {state[5].cast<std::size_t>(), elements_of<Index>(state[6]), elements_of<Index>(state[7])}, {}, {}};
  for (const py::handle& repair : state[8]) {
    auto [action, count] = repair.cast<std::pair<std::string, std::size_t>>();
    source.repairs.push_back({std::move(action), count});
  }
  for (const py::handle& property : state[9]) {
    auto [name, values] = property.cast<std::pair<std::string, py::array>>();
    source.properties.push_back({std::move(name), values_from(values, "a property")});
  }
  const auto path = state[2].cast<std::string>();
  const auto file = state[10].cast<std::string>();
  const core::BuildOptions build =
      build_options({state[3].cast<bool>(), state[11].cast<std::optional<std::string>>(),
                     state[13].cast<std::optional<std::string>>()});
  source.warnings = state[12].cast<std::vector<std::string>>();
  return compute(py::none(), [&](const core::Progress&) {
    core::TriangleMesh mesh(std::move(points), std::move(triangles));
    return std::make_shared<MeshData>(
        MeshData{{std::move(mesh), std::move(source)}, path, build, time, file});
  });
}

py::tuple state_of(const std::shared_ptr<const ScalarField>& field) {
  return py::make_tuple(view_of(field->values(), field), view_of(field->ranks(), field));
}

ScalarField restored(const MeshHandle& mesh, const py::tuple& state) {
  const auto ranks = elements_of<Index>(state[1]);
  return {mesh->mesh(), elements_of<double>(state[0]), {ranks.begin(), ranks.end()}};
}

py::tuple state_of(const tools::StepOutcome& step) {
  const auto end =
      step.end ? std::optional(std::pair(step.end->iterations_run, step.end->stopped_by)) : std::nullopt;
  return py::make_tuple(step.name, step.parameters, step.details, taken(step.iterations), end, step.sigma,
                        step.warnings);
}

tools::StepOutcome restored_step(const py::tuple& state) {
  tools::StepOutcome step{state[0].cast<std::string>(), state[1].cast<core::Parameters>(),
                          state[2].cast<core::Parameters>(), elements_of<core::IterationRecord>(state[3])};
  if (const auto end = state[4].cast<std::optional<std::pair<std::int64_t, std::string>>>())
    step.end = core::IterationEnd{end->first, end->second};
  step.sigma = state[5].cast<std::optional<double>>();
  step.warnings = state[6].cast<std::vector<std::string>>();
  return step;
}

py::tuple state_of(const std::shared_ptr<const tools::FieldOutcome>& outcome) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const core::FileParameter& file : outcome->files) files.emplace_back(file.key, file.path);
  return py::make_tuple(outcome->name, state_of({outcome, &outcome->field}), outcome->parameters,
                        outcome->seconds, files, outcome->unit, outcome->warnings);
}

std::shared_ptr<const tools::FieldOutcome> restored_outcome(const MeshHandle& mesh, const py::tuple& state) {
  tools::FieldOutcome outcome{state[0].cast<std::string>(), restored(mesh, state[1]),
                              state[2].cast<core::Parameters>(), state[3].cast<double>()};
  for (auto& [key, path] : state[4].cast<std::vector<std::pair<std::string, std::string>>>())
    outcome.files.push_back({key, path});
  outcome.unit = state[5].cast<std::string>();
  outcome.warnings = state[6].cast<std::vector<std::string>>();
  return std::make_shared<const tools::FieldOutcome>(std::move(outcome));
}

/// Of a field of a request without a target also how it was made; of others values and order alone.
py::tuple field_state(const FieldHandle& field) {
  const FieldStory& story = field->story;
  if (!story.is_request || story.target) return py::make_tuple(state_of(field->field));
  py::list steps;
  for (const tools::StepOutcome& step : story.steps) steps.append(state_of(step));
  return py::make_tuple(story.steps.empty() ? py::object(py::none()) : py::object(state_of(field->field)),
                        state_of(story.input), story.function, story.name, story.method, steps,
                        story.method_seconds);
}

FieldHandle restored_field(const MeshHandle& mesh, const py::tuple& state) {
  if (state.size() == 1) return given_field(mesh, restored(mesh, state[0]), "values", false);
  FieldStory story;
  story.input = restored_outcome(mesh, state[1]);
  story.function = state[2].cast<std::string>();
  story.name = state[3].cast<std::string>();
  story.method = state[4].cast<std::string>();
  for (const py::handle& step : state[5]) story.steps.push_back(restored_step(step.cast<py::tuple>()));
  story.method_seconds = state[6].cast<double>();
  std::shared_ptr<const ScalarField> field(story.input, &story.input->field);
  if (!story.steps.empty()) field = std::make_shared<const ScalarField>(restored(mesh, state[0]));
  return std::make_shared<FieldData>(FieldData{mesh, std::move(field), std::move(story)});
}

}  // namespace

void add_pickling(py::module_& m) {
  m.def("mesh_state", &mesh_state);
  m.def("restored_mesh", &restored_mesh);
  m.def("field_state", &field_state);
  m.def("restored_field", &restored_field);
}

}  // namespace morsel::python
