#pragma once
/// Seconds of others, taken elsewhere.

#include <optional>
#include <string>

namespace morsel::benchmark {

/// TTK, the Topology ToolKit (Tierny et al. 2018), as of March 2024, -O3 -march=native, its checks off, with
/// one or two threads, on refined_elephant cut in five with noise of 5 %: 1.11 million vertices. None for a
/// step or number of threads that was not taken.
std::optional<double> ttk_seconds(const std::string& step, const std::string& field, int threads);
/// Its peak memory in bytes on that mesh, all steps.
double ttk_peak_bytes(const std::string& field);

/// What the plain listing took, on the machine of those figures, for ten iterations on the bunny: the measure
/// of machines.
inline constexpr double kListingSecondsThere = 2.9;

}  // namespace morsel::benchmark
