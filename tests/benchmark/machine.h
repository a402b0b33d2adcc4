#pragma once
/// What the benchmark ran on.

#include <map>
#include <string>
#include <vector>

namespace morsel::benchmark {

struct Machine {
  std::string processor;
  unsigned processors = 0;
  std::string instruction_set;  ///< the one that salient smoothing chooses
  std::string compiler;
  /// Bytes a second that so many threads can read and write at best (a sum of two long arrays into a third).
  std::map<int, double> bandwidth;
};

Machine this_machine(const std::vector<int>& thread_counts);

}  // namespace morsel::benchmark
