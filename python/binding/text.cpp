#include "morsel/python/binding/text.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <variant>

#include "morsel/python/binding/arrays.h"

namespace morsel::python {

py::str text(std::string_view bytes) {
  PyObject* const made = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

py::list texts(const std::vector<std::string>& all) {
  py::list list;
  for (const std::string& one : all) list.append(text(one));
  return list;
}

py::dict parameters(const core::Parameters& all) {
  py::dict result;
  for (const auto& [key, value] : all)
    result[text(key)] = std::visit(
        [](const auto& held) -> py::object {
          if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::string>)
            return text(held);
          else
            return py::cast(held);
        },
        value);
  return result;
}

py::list defects(const std::vector<core::Defect>& all) {
  py::list list;
  for (const core::Defect& defect : all)
    list.append(py::make_tuple(text(core::defect_name(defect.kind)), defect.count, py::cast(defect.first),
                               text(core::describe(defect))));
  return list;
}

py::dict timings(const tools::Timings& all) {
  py::dict result;
  for (const auto& [step, seconds] : all) result[text(step)] = seconds;
  return result;
}

namespace {

py::object end(const std::optional<core::IterationEnd>& reached) {
  if (!reached) return py::none();
  return py::make_tuple(reached->iterations_run, text(reached->stopped_by));
}

}  // namespace

py::list steps(const std::vector<tools::StepOutcome>& all) {
  py::list list;
  for (const tools::StepOutcome& step : all)
    list.append(py::make_tuple(text(step.name), parameters(step.parameters), parameters(step.details),
                               taken(step.iterations), texts(step.warnings), end(step.end),
                               py::cast(step.sigma)));
  return list;
}

py::object target(const std::optional<tools::TargetOutcome>& outcome) {
  if (!outcome) return py::none();
  py::dict result;
  result["wanted"] = outcome->wanted;
  result["reached"] = outcome->reached;
  result["iterations"] = outcome->iterations;
  result["left_by_next"] = outcome->left_by_next ? py::cast(*outcome->left_by_next) : py::none();
  result["before_cancelling"] = outcome->before_cancelling;
  result["cancelled"] = taken(outcome->cancelled);
  result["largest_cancelled"] = outcome->largest_cancelled;
  result["unfolded"] = taken(outcome->unfolded);
  result["largest_unfolding"] = outcome->largest_unfolding;
  result["note"] = text(outcome->note);
  result["early_end"] = text(tools::early_end(*outcome));
  return result;
}

}  // namespace morsel::python
