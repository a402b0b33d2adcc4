#pragma once
/// The parts of the module morsel._documents: results as reports, pages and files.

#include <pybind11/pybind11.h>

namespace morsel::python {

namespace py = pybind11;

void add_comparison_documents(py::module_& m);
void add_study_documents(py::module_& m);
void add_field_documents(py::module_& m);
void add_surface_documents(py::module_& m);
void add_landmarks(py::module_& m);

}  // namespace morsel::python
