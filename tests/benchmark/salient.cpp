// Salient smoothing beside the plain listing.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "benchmark/suites.h"
#include "benchmark/workloads.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/salient_reference.h"

namespace morsel::benchmark {
namespace {

constexpr int kIterations = 10;

/// The listing on runs of consecutive vertices spread over the mesh, so that caches serve it as in a full
/// run.
struct Listing {
  double seconds = 0;  ///< for all iterations on all vertices
  std::size_t sampled = 0;
};

Listing time_listing(const core::ScalarField& field, double sigma, double sigma_s, std::size_t sampled) {
  const std::size_t n = field.values().size();
  test::SalientListing listing(field.mesh().positions(), {.sigma = sigma, .sigma_s = sigma_s});
  const std::size_t run = std::max<std::size_t>(1, std::min(sampled, n) / 16);
  std::size_t visited = 0;
  double sum = 0;
  const Stopwatch watch;
  for (std::size_t first = 0; first < n; first += std::max(run, n / 16))
    for (std::size_t v = first; v < std::min(n, first + run); ++v, ++visited)
      sum += listing.saliency(field.values(), static_cast<core::Index>(v));
  const double seconds = watch.seconds();
  if (!std::isfinite(sum)) throw std::runtime_error("the listing's sum is not finite");
  return {seconds * kIterations * static_cast<double>(n) / static_cast<double>(visited), visited};
}

double largest_difference(const core::ScalarField& a, const core::ScalarField& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.values().size(); ++v)
    most = std::max(most, std::abs(a.values()[v] - b.values()[v]));
  return most;
}

}  // namespace

double listing_seconds_on_bunny() {
  const Workload work = workload("bunny00", 1);
  const core::ScalarField field = field_of(work.mesh, "mean-curvature");
  const morse::SalientResult resolved = morse::salient(field, {.iterations = 1});
  return time_listing(field, resolved.sigma, resolved.sigma_s.value(), field.values().size()).seconds;
}

void run_salient(const Plan& plan, const Report& report) {
  for (const int pieces : plan.quick ? std::vector{1} : std::vector{1, 2, 4, 8}) {
    const Workload work = workload("bunny00", pieces);
    const core::ScalarField field = field_of(work.mesh, "mean-curvature");
    const double extent = field.max() - field.min();
    const morse::SalientResult resolved = morse::salient(field, {.iterations = 0});
    const Listing listing = time_listing(field, resolved.sigma, resolved.sigma_s.value(), 40000);
    std::optional<core::ScalarField> exact;
    const auto run = [&](const std::string& name, int threads, const morse::SalientOptions& options) {
      const core::ThreadLimit limit(threads);
      std::optional<morse::SalientResult> result;
      Row row;
      row.step = name;
      row.mesh = work.mesh_name;
      row.vertices = field.values().size();
      row.field = "mean-curvature";
      row.threads = threads;
      row.cost = measured(
          [&] {
            result = morse::salient(field, options);
            return 0;
          },
          1, 0.5);
      row.pairs = static_cast<double>(result->pairs) * kIterations;
      row.baselines = {{"listing", listing.seconds}};
      if (!exact) exact = result->field;
      row.error = largest_difference(result->field, *exact) / extent;
      row.note = std::to_string(morse::classify(result->field).total()) + " critical points";
      if (options.accuracy > 0 && result->algorithm == morse::SalientAlgorithm::exact)
        row.note += ", exact: " + result->reason;
      if (listing.sampled < field.values().size())
        row.note += ", listing on " + std::to_string(listing.sampled) + " vertices";
      report(row);
    };
    if (pieces == 1) {
      const std::vector<double> values = test::salient_reference(
          work.mesh.positions(), {field.values().begin(), field.values().end()},
          {.iterations = kIterations, .sigma = resolved.sigma, .support = 2, .sigma_s = resolved.sigma_s});
      exact = core::ScalarField(work.mesh, values);
    }
    for (const int threads : plan.threads) {
      const bool large = pieces > 2;  // more than one run would take minutes
      if (large && threads != plan.threads.back()) continue;
      for (const morse::Precision precision : {morse::Precision::float64, morse::Precision::float32})
        for (const morse::InstructionSet set : morse::instruction_sets()) {
          if (set != morse::best_instruction_set() && (pieces > 2 || threads != plan.threads.back()))
            continue;
          if (precision == morse::Precision::float32 && pieces > 4) continue;  // minutes
          morse::SalientOptions options;
          options.precision = precision;
          options.instructions = set;
          run("salient " + std::string(precision == morse::Precision::float64 ? "double" : "single") + ' ' +
                  std::string(to_string(set)),
              threads, options);
        }
      if (pieces < 4) continue;
      morse::SalientOptions options;
      options.accuracy = 1e-4;
      options.always_near_linear = true;
      run("salient accuracy=1e-4", threads, options);
    }
  }
}

}  // namespace morsel::benchmark
