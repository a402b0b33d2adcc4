#pragma once
/// The parts of the benchmark. Each appends its rows as they come, and tells what it does on standard error.

#include <functional>
#include <string>
#include <vector>

#include "benchmark/results.h"

namespace morsel::benchmark {

struct Plan {
  std::vector<int> threads = {1, 2};
  bool quick = false;   ///< smaller meshes and fewer of them, to see that everything runs
  std::string program;  ///< the morsel executable
  std::string scratch;  ///< an empty folder
};

using Report = std::function<void(Row)>;

/// Seconds of the plain listing for ten iterations on the bunny, from one of them.
double listing_seconds_on_bunny();

/// Every step but smoothing on a mesh of 1.11 million vertices, beside plain versions and, scaled by
/// `machine_factor`, TTK.
void run_steps(const Plan& plan, double machine_factor, const Report& report);
/// Peak memory of the whole program on that mesh, beside TTK's.
void run_memory(const Plan& plan, const Report& report);
/// Salient smoothing beside the plain listing, by mesh size, precision, accuracy and instruction set.
void run_salient(const Plan& plan, const Report& report);
/// Time and memory by mesh size, of every step, and of the whole program on the largest.
void run_scaling(const Plan& plan, const Report& report);
/// Every Morse function and method, beside the same made with stock libraries.
void run_methods(const Plan& plan, const Report& report);
/// What is built on the complex, beside plain versions.
void run_structures(const Plan& plan, const Report& report);
/// What reading and writing take of `morsel compare`.
void run_files(const Plan& plan, const Report& report);
/// How cost grows with size for inputs that are made to be costly (adversarial.h): seconds at n, 2n, 4n, 8n,
/// and exponents.
void run_adversarial(const Plan& plan, const Report& report);

}  // namespace morsel::benchmark
