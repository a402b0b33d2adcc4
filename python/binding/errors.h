#pragma once
/// The library's errors as Python's exceptions.

#include <pybind11/pybind11.h>

namespace morsel::python {

/// From now on the library's errors that leave functions of the module are the exceptions of morsel._errors:
/// InvalidArgument is ArgumentError, BadInput InputError, MeshError itself with its defects, WriteFailed
/// WriteError, Cancelled itself. To be called once by each extension module.
void translate_errors();

}  // namespace morsel::python
