// Cost against size for inputs that are made to be costly.

#include "benchmark/adversarial.h"

#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::benchmark {
namespace {

/// A size that takes longer is the family's last.
constexpr double kLongest = 20;

/// Measures a family at n, 2n, 4n, 8n. The growth of a row is the exponent p of seconds ∝ size^p between n
/// and its size.
void run_family(const Family& family, const Plan& plan, int threads, const Report& report) {
  double first = 0;
  for (std::size_t size = family.smallest; size <= 8 * family.smallest; size *= 2) {
    Row row;
    row.step = family.name;
    row.vertices = size;
    row.threads = threads;
    const std::function<void()> work = family.make(plan, size);
    row.cost = measured(
        [&] {
          try {
            work();
          } catch (const core::Error& error) {
            row.note = error.what();
          }
          return 0;
        },
        1, plan.quick ? 0 : 0.5);
    if (row.note.size() > 60) row.note = row.note.substr(0, 60) + " ...";
    if (size == family.smallest)
      first = row.cost.fastest;
    else
      row.growth = std::log(row.cost.fastest / first) /
                   std::log(static_cast<double>(size) / static_cast<double>(family.smallest));
    const bool is_last = row.cost.fastest > kLongest;
    report(std::move(row));
    if (is_last) break;
  }
}

}  // namespace

void run_adversarial(const Plan& plan, const Report& report) {
  const int threads = plan.threads.back();
  const core::ThreadLimit limit(threads);
  for (const std::vector<Family>& families : {reader_families(), algorithm_families()})
    for (const Family& family : families) run_family(family, plan, threads, report);
}

}  // namespace morsel::benchmark
