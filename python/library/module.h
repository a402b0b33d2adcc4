#pragma once
/// The parts of the module morsel._library: the library and the studies for Python.

#include <pybind11/pybind11.h>

namespace morsel::python {

namespace py = pybind11;

void add_registry(py::module_& m);
void add_mesh(py::module_& m);
void add_field(py::module_& m);
void add_pickling(py::module_& m);
void add_measurements(py::module_& m);
void add_complex(py::module_& m);
void add_segments(py::module_& m);
void add_hierarchy(py::module_& m);
void add_points(py::module_& m);
void add_surfaces(py::module_& m);
void add_comparison(py::module_& m);
void add_sweep(py::module_& m);
void add_stability(py::module_& m);

}  // namespace morsel::python
