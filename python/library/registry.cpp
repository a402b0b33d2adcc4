/// Morse functions and methods by name, those of users that are written in Python included.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/python/binding/own.h"
#include "morsel/python/binding/text.h"
#include "morsel/python/library/module.h"
#include "morsel/tools/study/presets.h"
#include "morsel/tools/study/registry.h"

namespace morsel::python {
namespace {

using core::ParameterKind;

const char* kind_name(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::number:
      return "number";
    case ParameterKind::count:
      return "count";
    case ParameterKind::length:
      return "length";
    case ParameterKind::flag:
      return "flag";
    case ParameterKind::choice:
      return "choice";
    case ParameterKind::text:
      return "text";
    case ParameterKind::list:
      return "list";
  }
  return "";
}

/// (key, kind, default, description, choices) of each.
py::list described(const std::vector<core::ParameterInfo>& parameters) {
  py::list list;
  for (const core::ParameterInfo& info : parameters)
    list.append(py::make_tuple(text(info.key), kind_name(info.kind), text(info.default_value),
                               text(info.description), texts(info.choices)));
  return list;
}

/// (name, summary, parameters) of each.
template <class Entries, class Parameters>
py::list listed(const Entries& entries, const Parameters& parameters_of) {
  py::list list;
  for (const auto& entry : entries)
    list.append(py::make_tuple(text(entry.name), text(entry.summary), described(parameters_of(entry.name))));
  return list;
}

py::list functions(const tools::Registry& registry) {
  return listed(registry.functions(),
                [&](const std::string& name) { return registry.parameters_of_function(name); });
}

py::list methods(const tools::Registry& registry) {
  return listed(registry.methods(),
                [&](const std::string& name) { return registry.parameters_of_method(name); });
}

/// (name, purpose, field, methods) of each.
py::list presets() {
  py::list list;
  for (const tools::Preset& preset : tools::presets())
    list.append(
        py::make_tuple(text(preset.name), text(preset.purpose), text(preset.field), texts(preset.methods)));
  return list;
}

}  // namespace

void add_registry(py::module_& m) {
  using tools::Registry;
  py::class_<Registry, std::shared_ptr<Registry>>(m, "Registry")
      .def(py::init([] { return Registry::standard(); }))
      .def("functions", &functions)
      .def("methods", &methods)
      .def("add_function", &add_own_function, py::arg("name"), py::arg("summary"), py::arg("parameters"),
           py::arg("call"))
      .def("add_method", &add_own_method, py::arg("name"), py::arg("summary"), py::arg("parameters"),
           py::arg("call"));
  m.def("presets", &presets);
  m.def("escape", [](const std::string& word) { return core::escape(word); });
}

}  // namespace morsel::python
