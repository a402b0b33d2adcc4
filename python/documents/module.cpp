#include "morsel/python/documents/module.h"

#include "morsel/python/binding/errors.h"
#include "morsel/python/binding/job.h"

PYBIND11_MODULE(_documents, m) {
  using namespace morsel::python;
  share_jobs(py::module_::import("morsel._library"));  // which has the types of what is written
  m.doc() = "Reports, pages and files of morsel, as morsel's Python sources write them.";
  translate_errors();
  add_comparison_documents(m);
  add_study_documents(m);
  add_field_documents(m);
  add_surface_documents(m);
  add_landmarks(m);
}
