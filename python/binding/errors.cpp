#include "morsel/python/binding/errors.h"

#include <pybind11/stl.h>

#include <exception>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/python/binding/text.h"

namespace morsel::python {
namespace {

namespace py = pybind11;

/// Makes `NAME(arguments…)` the exception that Python sees.
template <class... Arguments>
void raise(const char* name, Arguments&&... arguments) {
  const py::object type = py::module_::import("morsel._errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr exception) {
  if (!exception) return;
  try {
    std::rethrow_exception(std::move(exception));
  } catch (const core::MeshError& error) {
    raise("MeshError", text(error.what()), defects(error.defects()));
  } catch (const core::Error& error) {
    switch (error.kind()) {
      case core::ErrorKind::invalid_argument:
        return raise("ArgumentError", text(error.what()));
      case core::ErrorKind::bad_input:
        return raise("InputError", text(error.what()));
      case core::ErrorKind::write_failed:
        return raise("WriteError", text(error.what()));
      case core::ErrorKind::cancelled:
        return raise("Cancelled", text("stopped by the progress function"));
    }
  }
}

}  // namespace

void translate_errors() { py::register_local_exception_translator(translate); }

}  // namespace morsel::python
