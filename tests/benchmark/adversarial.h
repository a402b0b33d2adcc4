#pragma once
/// Families of inputs that are made to be costly. The suite "adversarial" shows how their cost grows with
/// their size.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/suites.h"

namespace morsel::benchmark {

/// A new family is one row of one of the lists below and a function that makes its input.
struct Family {
  std::string name;
  std::size_t smallest = 0;  ///< n: it is measured at n, 2n, 4n and 8n; n should take some milliseconds
  /// Makes the input of a size, untimed; what it returns is timed, once or more. An input may be refused: a
  /// core::Error ends the work, and the row says so.
  std::function<std::function<void()>(const Plan& plan, std::size_t size)> make;
};

/// Readers, the building of meshes and what else core does.
std::vector<Family> reader_families();
/// What morse, mscomplex and the commands do.
std::vector<Family> algorithm_families();

}  // namespace morsel::benchmark
