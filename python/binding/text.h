#pragma once
/// Texts, parameters and defects as Python has them.

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::python {

namespace py = pybind11;

/// A text of the library, which may quote bytes of a file that are not UTF-8: those become replacement
/// characters.
py::str text(std::string_view bytes);
py::list texts(const std::vector<std::string>& all);

/// A dict, in the order of the parameters.
py::dict parameters(const core::Parameters& all);

/// (kind, count, first, description) of each.
py::list defects(const std::vector<core::Defect>& all);

/// A dict: seconds by step.
py::dict timings(const tools::Timings& all);

/// (name, parameters, details, iterations, warnings, end, sigma) of each; iterations are a structured array,
/// the end (iterations, what stopped them) or None.
py::list steps(const std::vector<tools::StepOutcome>& all);

/// How a wanted number was reached, as a dict; None if there was none.
py::object target(const std::optional<tools::TargetOutcome>& outcome);

}  // namespace morsel::python
