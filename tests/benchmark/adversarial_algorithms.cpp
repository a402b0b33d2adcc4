// Costly inputs for what is computed on meshes.

#include "benchmark/adversarial.h"

namespace morsel::benchmark {

std::vector<Family> algorithm_families() { return {}; }

}  // namespace morsel::benchmark
