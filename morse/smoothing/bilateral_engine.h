#pragma once
/// The interface of the algorithms of a BilateralFilter.

#include <cstdint>
#include <optional>
#include <span>

#include "morsel/morse/smoothing/bilateral.h"

namespace morsel::morse {

/// One algorithm for the sums; see BilateralFilter for what the functions do.
class BilateralEngine {
 public:
  virtual ~BilateralEngine() = default;
  virtual void apply(std::span<const double> values, std::optional<double> sigma_s, std::span<double> result,
                     const BilateralFilter::Report& report) = 0;
  virtual std::optional<double> gain(std::span<const double> values, double sigma_s) const = 0;
  virtual double error() const = 0;
  virtual std::uint64_t pairs() const = 0;
};

}  // namespace morsel::morse
