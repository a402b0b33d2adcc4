#pragma once
/// Morse functions and methods that are written in Python.

#include <pybind11/pybind11.h>

#include <string>

#include "morsel/tools/study/registry.h"

namespace morsel::python {

namespace py = pybind11;

/// Adds one to a registry. `parameters` is a list of (key, kind, default, description): kind is "flag",
/// "count", "number", "length" or "text", and the default a value of that kind (a length's is its text).
///
/// call(mesh, values) of a function and call(field, values) of a method get a Mesh or Field of this module
/// and a dict of the parameters' values, lengths in the mesh's unit; they return an array of a value per
/// vertex, or a Field on the same mesh, which keeps its order. They are called by call_python(). What they
/// return wrongly is an InvalidArgument that names them, what they raise comes out as it is.
void add_own_function(tools::Registry& registry, const std::string& name, const std::string& summary,
                      const py::list& parameters, py::object call);
void add_own_method(tools::Registry& registry, const std::string& name, const std::string& summary,
                    const py::list& parameters, py::object call);

}  // namespace morsel::python
