#include "morsel/tools/study/statistics.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace morsel::tools {
Estimate estimate(std::span<const double> values) {
  Estimate result{values.size(), 0, 0, {}};
  if (values.empty()) return result;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (n - 1));
  const boost::math::students_t_distribution<double> student(n - 1);
  result.half_width = boost::math::quantile(student, (1 + kConfidence) / 2) * result.deviation / std::sqrt(n);
  return result;
}

}  // namespace morsel::tools
