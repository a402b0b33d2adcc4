#include "morsel/python/binding/job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"

namespace morsel::python {
namespace {

constexpr std::chrono::milliseconds kTick(50);
constexpr std::chrono::seconds kPatience(5);  // with jobs, at the interpreter's end

/// Ends work whose call of Python failed.
struct PythonFailed : std::exception {
  const char* what() const noexcept override { return "a call of Python failed"; }
};

class Job {
 public:
  explicit Job(const py::object& report) : report_(report) {}
  void run(const std::function<void(const core::Progress&)>& work);
  /// Called by the threads of the work.
  void call(const std::function<void()>& function);
  double seconds() const { return seconds_; }
  bool is_of(const std::stop_token& token) const { return stop_.get_token() == token; }
  void stop() { stop_.request_stop(); }
  /// Makes Python code that the waiting thread runs, or the next that it does, end with SystemExit.
  void exit_python() const { PyThreadState_SetAsyncExc(thread_, PyExc_SystemExit); }

 private:
  struct Call {
    const std::function<void()>& function;
    bool is_done = false;
    bool failed = false;
  };

  void work_on(const std::function<void(const core::Progress&)>& work);
  void serve();
  void attend();
  void tell_progress();
  void fail();

  const py::object& report_;
  const unsigned long thread_ = PyThread_get_thread_ident();
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable news_;      // for the thread that waits for the job
  std::condition_variable answered_;  // for threads of the work that wait for a call
  std::vector<Call*> calls_;
  std::string step_;
  double fraction_ = 0;
  bool has_news_ = false;  // progress that was not told yet
  bool is_over_ = false;
  double seconds_ = 0;
  std::exception_ptr work_error_;
  std::exception_ptr python_error_;  // the first; of the waiting thread alone
};

/// The jobs that run.
class Jobs {
 public:
  void add(Job& job) {
    const std::lock_guard lock(mutex_);
    if (is_closed_) throw core::Cancelled();
    jobs_.push_back(&job);
  }
  void remove(const Job& job) {
    const std::lock_guard lock(mutex_);
    std::erase(jobs_, &job);
    left_.notify_all();
  }
  /// Null if it is of no job.
  Job* of(const core::Progress& progress) {
    const std::lock_guard lock(mutex_);
    for (Job* job : jobs_)
      if (job->is_of(progress.stop_token())) return job;
    return nullptr;
  }
  /// Stops all jobs, refuses others, and waits for their threads, which may need the interpreter lock.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
      for (const Job* job : jobs_) job->exit_python();
    }
    const py::gil_scoped_release without_lock;
    std::unique_lock lock(mutex_);
    for (Job* job : jobs_) job->stop();
    left_.wait_for(lock, kPatience, [&] { return jobs_.empty(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  std::vector<Job*> jobs_;
  bool is_closed_ = false;
};

double& last_seconds() {
  thread_local double seconds = 0;
  return seconds;
}

/// Never destroyed, since threads may outlive the interpreter. Set when the module is loaded.
Jobs* all_jobs = nullptr;

constexpr const char* kJobs = "_jobs";

/// A job among the jobs that run.
class Listed {
 public:
  explicit Listed(Job& job) : job_(job) { all_jobs->add(job_); }
  ~Listed() { all_jobs->remove(job_); }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;

 private:
  Job& job_;
};

void Job::run(const std::function<void(const core::Progress&)>& work) {
  {
    const Listed listed(*this);  // until this thread has the lock again
    const py::gil_scoped_release without_lock;
    std::thread worker([&] { work_on(work); });
    serve();
    worker.join();
  }
  if (!python_error_ && has_news_) tell_progress();
  if (python_error_) std::rethrow_exception(python_error_);
  if (work_error_) std::rethrow_exception(work_error_);
}

void Job::work_on(const std::function<void(const core::Progress&)>& work) {
  const core::StopScope scope(stop_.get_token());
  core::Progress::Report report;
  if (!report_.is_none())
    report = [this](std::string_view step, double fraction) {
      const std::lock_guard lock(mutex_);
      step_ = step;
      fraction_ = fraction;
      has_news_ = true;
    };
  const auto start = std::chrono::steady_clock::now();
  try {
    work(core::Progress(std::move(report), stop_.get_token()));
  } catch (...) {
    work_error_ = std::current_exception();
  }
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::lock_guard lock(mutex_);
  is_over_ = true;
  news_.notify_all();
}

/// Until the work is over. Without the interpreter lock.
void Job::serve() {
  std::unique_lock lock(mutex_);
  auto tick = std::chrono::steady_clock::now() + kTick;
  while (!is_over_) {
    news_.wait_until(lock, tick, [&] { return is_over_ || !calls_.empty(); });
    const std::vector<Call*> calls = std::exchange(calls_, {});
    lock.unlock();
    for (Call* call : calls) {
      if (!python_error_) {
        const py::gil_scoped_acquire with_lock;
        try {
          call->function();
        } catch (...) {
          python_error_ = std::current_exception();
          call->failed = true;
        }
      } else {
        call->failed = true;
      }
    }
    if (std::chrono::steady_clock::now() >= tick) {
      attend();
      tick = std::chrono::steady_clock::now() + kTick;
    }
    if (python_error_) stop_.request_stop();
    lock.lock();
    for (Call* call : calls) call->is_done = true;
    if (!calls.empty()) answered_.notify_all();
  }
}

/// Signals and progress.
void Job::attend() {
  if (python_error_) return;
  const py::gil_scoped_acquire with_lock;
  if (PyErr_CheckSignals() != 0) fail();
  if (!python_error_) tell_progress();
}

void Job::tell_progress() {
  if (report_.is_none()) return;
  std::string step;
  double fraction = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!has_news_) return;
    has_news_ = false;
    step = step_;
    fraction = fraction_;
  }
  try {
    if (says_stop(report_(step, fraction))) throw core::Cancelled();
  } catch (...) {
    python_error_ = std::current_exception();
  }
}

/// Takes the exception that Python has set.
void Job::fail() {
  try {
    throw py::error_already_set();
  } catch (...) {
    python_error_ = std::current_exception();
  }
}

void Job::call(const std::function<void()>& function) {
  Call call{function};
  std::unique_lock lock(mutex_);
  calls_.push_back(&call);
  news_.notify_all();
  answered_.wait(lock, [&] { return call.is_done; });
  if (call.failed) throw PythonFailed();
}

}  // namespace

void run_job(const py::object& report, const std::function<void(const core::Progress&)>& work) {
  Job job(report);
  job.run(work);
  last_seconds() = job.seconds();
}

double seconds_of_last_job() { return last_seconds(); }

void call_python(const core::Progress& progress, const std::function<void()>& call) {
  if (Job* const job = all_jobs->of(progress)) return job->call(call);
  const py::gil_scoped_acquire with_lock;
  call();
}

bool says_stop(const py::object& answer) {
  py::detail::make_caster<bool> truth;
  return truth.load(answer, false) && !py::detail::cast_op<bool>(truth);
}

void own_jobs(py::module_& library) {
  all_jobs = new Jobs();
  library.attr(kJobs) = py::capsule(all_jobs, kJobs);
  py::module_::import("atexit").attr("register")(py::cpp_function([] { all_jobs->close(); }));
}

void share_jobs(const py::module_& library) {
  all_jobs = library.attr(kJobs).cast<py::capsule>().get_pointer<Jobs>();
}

std::shared_ptr<py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* kept) {
            const py::gil_scoped_acquire with_lock;
            delete kept;
          }};
}

}  // namespace morsel::python
