#pragma once
/// The differences between two reports.

#include <string>
#include <vector>

#include "morsel/tools/report/report_document.h"

namespace morsel::tools {

struct Difference {
  std::string where;   ///< "methods[1] (salient): critical_points.total"
  std::string before;  ///< as JSON text; "absent" where it was not there
  std::string after;
};

/// All differences between two comparison reports except those in `timings` and the program's version. Whole
/// numbers, texts and structure must be equal. Real numbers may differ by 1e-9 of themselves or 1e-12 of the
/// report's largest field value (the last digits depend on the processor's exp), a bound far below any
/// change that would move a critical point.
std::vector<Difference> report_differences(const ReportDocument& before, const ReportDocument& after);

}  // namespace morsel::tools
