#include "benchmark/machine.h"

#include <fstream>
#include <thread>
#include <vector>

#include "benchmark/measure.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/smoothing/instruction_set.h"

namespace morsel::benchmark {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

double bandwidth() {
  const std::size_t count = std::size_t{1} << 25;  // 256 MiB an array: more than any cache
  std::vector<double> a(count, 1.0);
  std::vector<double> b(count, 2.0);
  std::vector<double> c(count, 0.0);
  const Cost cost = measured(
      [&] {
        core::parallel_for(0, count, 1 << 16, [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) c[i] = a[i] + 3 * b[i];
        });
        return 0;
      },
      5);
  return 3.0 * sizeof(double) * static_cast<double>(count) / cost.fastest;
}

}  // namespace

Machine this_machine(const std::vector<int>& thread_counts) {
  Machine machine;
  machine.processor = processor_name();
  machine.processors = std::thread::hardware_concurrency();
  machine.instruction_set = morse::to_string(morse::best_instruction_set());
  machine.compiler = "g++ " __VERSION__;
  for (const int threads : thread_counts) {
    const core::ThreadLimit limit(threads);
    machine.bandwidth[threads] = bandwidth();
  }
  return machine;
}

}  // namespace morsel::benchmark
