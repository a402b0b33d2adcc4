#pragma once
/// Seconds and memory of one thing done.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "morsel/tools/study/comparison.h"

namespace morsel::benchmark {

using tools::Stopwatch;

struct Cost {
  double seconds = 0;  ///< the median of the runs
  double fastest = 0;  ///< the shortest run
  int runs = 0;
  std::size_t peak = 0;  ///< bytes of memory above what was in use before, at most, in the first run
};

/// Memory that the process holds now, and the most that it held since reset_peak(), in bytes.
std::size_t resident_bytes();
std::size_t peak_bytes();
/// Gives free memory back to the system first, so that what is measured next does not reuse it.
void reset_peak();

/// Runs `run`, each time after `prepare` if given, which is not timed, at least `at_least` times and until
/// `enough` seconds are spent, at most ten times; its result is destroyed outside of what is timed.
template <class Run>
Cost measured(Run&& run, int at_least = 3, double enough = 1, const std::function<void()>& prepare = {}) {
  Cost cost;
  std::vector<double> seconds;
  double spent = 0;
  while (cost.runs < at_least || (spent < enough && cost.runs < 10)) {
    if (prepare) prepare();
    reset_peak();
    const std::size_t before = resident_bytes();
    const Stopwatch watch;
    {
      [[maybe_unused]] const auto result = run();
      seconds.push_back(watch.seconds());
    }
    if (cost.runs++ == 0) cost.peak = std::max(peak_bytes(), before) - before;
    spent += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  cost.fastest = seconds.front();
  cost.seconds = seconds[seconds.size() / 2];
  return cost;
}

/// What a process took.
struct ProcessCost {
  double seconds = 0;
  std::size_t peak = 0;
};
/// Runs a program with arguments, its input and output closed. Throws if it fails.
ProcessCost measured_process(const std::vector<std::string>& command);

/// What measured_process() starts in between, the first argument of the benchmark then being kWatch: on Linux
/// the peak memory of a process counts that of the one that started it, so that it must be a small one.
/// Returns an exit code.
int watch_process(char** command);
inline constexpr const char* kWatch = "--watch-process";

}  // namespace morsel::benchmark
