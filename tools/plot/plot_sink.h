#pragma once
/// The plots of `morsel compare --figures`.

#include <string>
#include <vector>

#include "morsel/tools/plot/comparison_plots.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/file_names.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// Writes into one folder, each as .svg and as .png of 300 pixels an inch:
///   NAME.diagram  the method's persistence diagram
///   diagrams      those of all methods, with the same axes
///   persistence   the number of pairs against persistence, a line a method
///   iterations    critical points against iteration, a line for each method that iterates; if any does
/// NAME is the method's; a second method of the same name gets "-2", and so on. Keeps 24 bytes a pair and
/// method.
class PlotSink : public ComparisonSink {
 public:
  /// Refers to `folder`.
  PlotSink(ResultFolder& folder, Provenance provenance);
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;
  /// Writes the plots of all methods together. To be called once, at the end.
  void finish();

 private:
  ResultFolder& folder_;
  Provenance provenance_;  // without methods
  Provenance all_;         // with all methods
  std::string field_;
  FileNames names_;
  std::vector<plot::MethodCurves> methods_;
};

}  // namespace morsel::tools
