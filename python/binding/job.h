#pragma once
/// Computations that Python waits for: they run without the interpreter lock, report their progress, end on
/// Ctrl-C, and may call Python.

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "morsel/core/parallel/progress.h"

namespace morsel::python {

namespace py = pybind11;

/// Runs `work` on a thread of its own, while the calling thread waits without the interpreter lock. Twenty
/// times a second the calling thread
/// - calls report(step, fraction), if `report` is not None, with the latest progress; where that returns
///   False the work is stopped and Cancelled thrown;
/// - lets Python handle signals: Ctrl-C stops the work and throws KeyboardInterrupt.
/// It also runs what the work, on any of its threads, hands to call_python(). So all Python runs on the
/// thread that asked for the work, and its exceptions come out of here as they are. Throws Cancelled when the
/// interpreter is about to end.
///
/// The calling thread must hold the interpreter lock. Jobs may be nested, by Python that a job calls.
void run_job(const py::object& report, const std::function<void(const core::Progress&)>& work);

/// The seconds that the work of the last job of this thread took on its own, for measuring what lies around
/// it.
double seconds_of_last_job();

/// run_job() with a result.
template <class Work>
auto compute(const py::object& report, const Work& work) {
  std::optional<std::invoke_result_t<Work, const core::Progress&>> result;
  run_job(report, [&](const core::Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

/// Calls `call`, with the interpreter lock, on the thread that waits for the job whose progress this is, and
/// waits for it; on the calling thread itself if it is of no job. Where `call` throws, so does this: the work
/// is to end, and what it threw is thrown by run_job().
void call_python(const core::Progress& progress, const std::function<void()>& call);

/// Whether a function of Python has answered False, numpy's included: the work is to end.
bool says_stop(const py::object& answer);

/// Each extension module has a copy of this code, but methods of users belong to `library`, and jobs of other
/// modules call them: the list of jobs is the library's. Called when the library is loaded. At the end of the
/// interpreter all jobs are stopped, since their threads could not come back to it.
void own_jobs(py::module_& library);
/// Called when another module is loaded.
void share_jobs(const py::module_& library);

/// A Python object that threads without the interpreter lock may copy and drop.
std::shared_ptr<py::object> shared(py::object object);

}  // namespace morsel::python
