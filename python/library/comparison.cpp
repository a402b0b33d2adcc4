/// Comparisons of methods.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/request.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/python/library/results.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/presets.h"
#include "morsel/tools/study/summary.h"

namespace morsel::python {
namespace {

using tools::ComparisonRequest;
using tools::FieldOutcome;
using tools::MethodOutcome;

/// Keeps the results.
class Keeper : public tools::ComparisonSink {
 public:
  explicit Keeper(ComparisonData& data) : data_(data) {}
  void field(const FieldOutcome&) override {}
  void method(const MethodOutcome&) override {}
  void keep_field(const std::shared_ptr<const FieldOutcome>& outcome) override { data_.field = outcome; }
  void keep_method(const std::shared_ptr<const MethodOutcome>& outcome) override {
    data_.methods.push_back(outcome);
  }

 private:
  ComparisonData& data_;
};

/// The request; a preset, or field and methods, of which None stands for the default.
ComparisonRequest request_of(const std::optional<std::string>& field,
                             const std::optional<std::vector<std::string>>& methods,
                             const std::optional<std::string>& preset, std::optional<std::size_t> target,
                             bool snap, const std::optional<py::dict>& points) {
  ComparisonRequest request;
  request.target = target;  // which presets depend on
  if (preset) tools::apply_preset(*preset, request);
  if (field) request.field = *field;
  if (methods) request.methods = *methods;
  request.snap = snap;
  if (points) request.points = points_request(*points);
  return request;
}

/// `values` is a field, or None where the request names a Morse function.
ComparisonHandle compare(const MeshHandle& mesh, const FieldHandle& values,
                         const std::optional<std::string>& field,
                         const std::optional<std::vector<std::string>>& methods,
                         const std::optional<std::string>& preset, std::optional<std::size_t> target,
                         bool snap, const std::optional<py::dict>& points, const tools::Registry& registry,
                         const py::object& report) {
  ComparisonRequest request = request_of(field, methods, preset, target, snap, points);
  FieldHandle given;
  if (values) {
    StudyField of = compute(py::none(), [&](const core::Progress&) { return study_field(values); });
    request.field = std::move(of.text);
    given = std::move(of.values);
  }
  const tools::ComparisonPlan plan = tools::prepare(request, registry);
  return compute(report, [&](const core::Progress& progress) {
    auto data = std::make_shared<ComparisonData>(ComparisonData{{mesh, given}, std::move(request), {}, {}});
    Keeper keeper(*data);
    tools::run_comparison(given ? data->input.loaded() : mesh->loaded, plan, {&keeper}, progress);
    return data;
  });
}

/// A method's text with the numbers that its counts of other rows were.
std::string resolved_text(const MethodOutcome& outcome) {
  std::vector<core::Specification> steps = core::parse_chain(outcome.specification, "the method");
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (auto& [key, value] : steps[i].given)
      for (const auto& [name, resolved] : outcome.steps[i].parameters)
        if (key == "count" && name == "count" && std::holds_alternative<std::int64_t>(resolved))
          value = std::to_string(std::get<std::int64_t>(resolved));
  return core::to_string(steps);
}

FieldStory story_before(const ComparisonHandle& c) {
  FieldStory story;
  if (c->input.values)
    story.name = c->input.values->story.name;
  else
    story.function = c->request.field;
  story.input = c->field;
  return story;
}

FieldHandle field_of(const ComparisonHandle& c) {
  return std::make_shared<FieldData>(FieldData{c->input.mesh, {c->field, &c->field->field}, story_before(c)});
}

std::shared_ptr<const MethodOutcome> row(const ComparisonHandle& c, std::size_t i) {
  if (i >= c->methods.size()) throw py::index_error("there is no such row");
  return c->methods[i];
}

FieldHandle row_field(const ComparisonHandle& c, const std::shared_ptr<const MethodOutcome>& outcome) {
  FieldStory story = story_before(c);
  story.method = resolved_text(*outcome);
  story.target = c->request.target;
  story.steps = outcome->steps;
  story.reached = outcome->target;
  return std::make_shared<FieldData>(FieldData{c->input.mesh, {outcome, &outcome->field}, std::move(story)});
}

/// The numbers of the table.
py::dict summary(const MethodOutcome& outcome) {
  const tools::PersistenceSummary pairs =
      tools::summary_of(outcome.measurement.diagram, outcome.input_extent);
  py::dict result;
  add_pairs(result, pairs);
  result["arcs"] = outcome.measurement.complex.arc_count();
  result["cells"] = outcome.measurement.cells;
  result["kept"] = outcome.compared_to_first.kept.size();
  result["moved"] = outcome.compared_to_first.moved.size();
  result["added"] = outcome.compared_to_first.added;
  result["removed"] = outcome.compared_to_first.removed;
  double seconds = 0;
  for (const auto& [step, one] : outcome.timings) seconds += one;
  result["seconds"] = seconds;
  return result;
}

/// The points that were chosen of a row's field; None where none were asked for.
py::object chosen_points(const ComparisonHandle& c, const std::shared_ptr<const MethodOutcome>& outcome,
                         const FieldHandle& field) {
  if (!outcome->chosen) return py::none();
  return py::cast(
      std::make_shared<PointsData>(PointsData{field, *c->request.points, {outcome, &outcome->chosen->made}}));
}

py::dict row_dict(const ComparisonHandle& c, std::size_t i) {
  const std::shared_ptr<const MethodOutcome> outcome = row(c, i);
  const auto part = [&](const auto& member) {
    return std::shared_ptr<const std::decay_t<decltype(member)>>(outcome, &member);
  };
  py::dict result;
  result["specification"] = text(outcome->specification);
  result["name"] = text(outcome->name);
  const FieldHandle field = row_field(c, outcome);
  result["field"] = field;
  result["points"] = points_array(part(outcome->measurement.critical_points));
  result["diagram"] = diagram_handle(part(outcome->measurement.diagram));
  result["complex"] = complex_handle(part(outcome->measurement.complex));
  result["segmentation"] = segmentation_dict(part(outcome->measurement.segmentation));
  result["origins"] = view_of(std::span<const core::Index>(outcome->origins), outcome);
  result["places"] = view_of(std::span<const core::Index>(outcome->places), outcome);
  result["chosen"] = chosen_points(c, outcome, field);
  result["summary"] = summary(*outcome);
  result["timings"] = timings(outcome->timings);
  return result;
}

}  // namespace

void add_comparison(py::module_& m) {
  py::class_<ComparisonData, ComparisonHandle>(m, "Comparison")
      .def("__len__", [](const ComparisonData& c) { return c.methods.size(); })
      .def("row", &row_dict)
      .def_property_readonly("mesh", [](const ComparisonData& c) { return c.input.mesh; })
      .def_property_readonly("field", &field_of)
      .def_property_readonly("values", [](const ComparisonData& c) { return c.input.values; })
      .def_property_readonly("field_text", [](const ComparisonData& c) { return text(c.request.field); })
      .def_property_readonly("method_texts", [](const ComparisonData& c) { return texts(c.request.methods); })
      .def_property_readonly("target", [](const ComparisonData& c) { return c.request.target; })
      .def_property_readonly("snap", [](const ComparisonData& c) { return c.request.snap; });
  m.def("compare", &compare);
}

}  // namespace morsel::python
