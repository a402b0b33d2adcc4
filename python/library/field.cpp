/// Fields: from Morse functions, from values, and by methods.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/specification.h"
#include "morsel/python/binding/arrays.h"
#include "morsel/python/binding/data.h"
#include "morsel/python/binding/job.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/tools/study/chain.h"

namespace morsel::python {
namespace {

using core::ScalarField;
using tools::FieldOutcome;
using tools::Registry;

FieldHandle handle_of(const MeshHandle& mesh, std::shared_ptr<const ScalarField> field, FieldStory story) {
  return std::make_shared<FieldData>(FieldData{mesh, std::move(field), std::move(story)});
}

/// A Morse function in the syntax of the command line, on a mesh.
FieldHandle evaluate(const MeshHandle& mesh, const std::string& specification, const Registry& registry,
                     const py::object& report) {
  const tools::NamedFunction function = registry.make_function(specification);
  return compute(report, [&](const core::Progress& progress) {
    const auto outcome =
        std::make_shared<const FieldOutcome>(tools::evaluate_field(mesh->loaded, function, progress));
    FieldStory story;
    story.function = specification;
    story.input = outcome;
    return handle_of(mesh, {outcome, &outcome->field}, std::move(story));
  });
}

core::FlatArray<core::Index> ranks_from(const py::array& array) {
  const std::vector<core::Index> ranks = indices_from(array, "the ranks");
  return {ranks.begin(), ranks.end()};
}

/// Values by vertex of the mesh; `ranks` is None, or their order.
FieldHandle given(const MeshHandle& mesh, const py::array& array, const std::optional<py::array>& ranks,
                  const std::string& name) {
  std::vector<double> values = values_from(array, "the values");
  std::optional<core::FlatArray<core::Index>> order;
  if (ranks) order = ranks_from(*ranks);
  return compute(py::none(), [&](const core::Progress&) {
    ScalarField field = order ? ScalarField(mesh->mesh(), std::move(values), std::move(*order))
                              : ScalarField(mesh->mesh(), std::move(values));
    return given_field(mesh, std::move(field), name, !order);
  });
}

FieldHandle negated(const FieldHandle& field) {
  return compute(py::none(), [&](const core::Progress&) {
    return given_field(field->mesh, field->field->negated(), "values", false);
  });
}

struct Applied {
  std::optional<std::size_t> target;
  bool count_iterations;
  py::object on_iteration;  // None, or called with the number and the field of each iteration
  bool is_ended = false;    // by on_iteration
};

core::IterationCallback callback_of(Applied& options, const MeshHandle& mesh,
                                    const core::Progress& progress) {
  if (options.on_iteration.is_none()) return {};
  return [&options, mesh, &progress](int number, const ScalarField& field) {
    const FieldHandle passed = given_field(mesh, field, "values", false);
    call_python(progress, [&] { options.is_ended = says_stop(options.on_iteration(number, passed)); });
    return !options.is_ended;
  };
}

/// A chain of methods on a field.
FieldHandle apply(const FieldHandle& input, const std::string& chain, std::optional<std::size_t> target,
                  bool count_iterations, py::object on_iteration, const Registry& registry,
                  const py::object& report) {
  tools::check_target(target);
  const tools::MethodChain steps = steps_after(input->story, chain, registry);
  const tools::NamedFunction function = function_for(steps, input->story, registry);
  Applied options{target, count_iterations, std::move(on_iteration)};
  return compute(report, [&](const core::Progress& progress) {
    const core::LoadedMesh loaded = reevaluates(steps) ? mesh_with_values(*input) : input->mesh->loaded;
    const tools::Stopwatch watch;
    tools::ChainOutcome outcome =
        tools::apply_chain(steps, loaded, function, *input->field,
                           {.target = target,
                            .count_iterations = count_iterations,
                            .on_iteration = callback_of(options, input->mesh, progress)},
                           progress);
    FieldStory story = input->story;
    story.is_request = story.is_request && !story.target && !options.is_ended;
    story.method += (story.method.empty() ? "" : "+") + chain;
    story.target = target;
    story.reached = std::move(outcome.target);
    story.method_seconds += watch.seconds();
    for (tools::StepOutcome& step : outcome.steps) story.steps.push_back(std::move(step));
    return handle_of(input->mesh, std::make_shared<const ScalarField>(std::move(outcome.field)),
                     std::move(story));
  });
}

/// The field before any method.
FieldHandle input_of(const FieldHandle& field) {
  FieldStory story = field->story;
  story.method.clear();
  story.target.reset();
  story.steps.clear();
  story.reached.reset();
  story.method_seconds = 0;
  std::shared_ptr<const ScalarField> input(story.input, &story.input->field);
  return handle_of(field->mesh, std::move(input), std::move(story));
}

}  // namespace

void add_field(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(core::IterationRecord, iteration, minima, saddles, saddle_multiplicity, maxima,
                       change);
  py::class_<FieldData, FieldHandle>(m, "Field")
      .def_readonly("mesh", &FieldData::mesh)
      .def_property_readonly("values", [](const FieldData& f) { return view_of(f.field->values(), f.field); })
      .def_property_readonly("ranks", [](const FieldData& f) { return view_of(f.field->ranks(), f.field); })
      .def_property_readonly("order", [](const FieldData& f) { return view_of(f.field->order(), f.field); })
      .def_property_readonly("min", [](const FieldData& f) { return f.field->min(); })
      .def_property_readonly("max", [](const FieldData& f) { return f.field->max(); })
      .def_property_readonly("input", &input_of)
      .def_property_readonly("steps", [](const FieldData& f) { return steps(f.story.steps); })
      .def_property_readonly("function", [](const FieldData& f) { return text(f.story.function); })
      .def_property_readonly("name", [](const FieldData& f) { return text(f.story.name); })
      .def_property_readonly("method", [](const FieldData& f) { return text(f.story.method); })
      .def_property_readonly("parameters",
                             [](const FieldData& f) { return parameters(f.story.input->parameters); })
      .def_property_readonly("warnings", [](const FieldData& f) { return texts(f.story.input->warnings); })
      .def_property_readonly("reached", [](const FieldData& f) { return python::target(f.story.reached); })
      .def("negated", &negated);
  m.def("evaluate", &evaluate);
  m.def("given", &given);
  m.def("apply", &apply);
}

}  // namespace morsel::python
