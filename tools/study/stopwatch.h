#pragma once
/// Seconds of the steps of a run.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace morsel::tools {

/// Seconds by step, in the order in which the steps ran.
using Timings = std::vector<std::pair<std::string, double>>;

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace morsel::tools
