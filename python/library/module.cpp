#include "morsel/python/library/module.h"

#include <memory>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/types.h"
#include "morsel/python/binding/errors.h"
#include "morsel/python/binding/job.h"

namespace morsel::python {
namespace {

/// `with`: limits the number of threads between begin and end.
class Threads {
 public:
  explicit Threads(int count) : count_(count) {}
  void begin() {
    if (limit_) throw core::InvalidArgument("these threads are in use already");
    limit_ = std::make_unique<core::ThreadLimit>(count_);
  }
  void end() { limit_.reset(); }

 private:
  int count_;
  std::unique_ptr<core::ThreadLimit> limit_;
};

}  // namespace
}  // namespace morsel::python

PYBIND11_MODULE(_library, m) {
  using namespace morsel::python;
  m.doc() = "The library of morsel, as morsel's Python sources use it.";
  translate_errors();
  own_jobs(m);
  m.attr("version") = MORSEL_VERSION;
  m.attr("none") = morsel::core::kNone;
  py::class_<Threads>(m, "Threads")
      .def(py::init<int>())
      .def("begin", &Threads::begin)
      .def("end", &Threads::end);
  m.def("thread_count", &morsel::core::thread_count);
  m.def("seconds_of_last_job", &seconds_of_last_job);
  add_registry(m);
  add_mesh(m);
  add_field(m);
  add_pickling(m);
  add_measurements(m);
  add_complex(m);
  add_segments(m);
  add_hierarchy(m);
  add_points(m);
  add_surfaces(m);
  add_comparison(m);
  add_sweep(m);
  add_stability(m);
}
