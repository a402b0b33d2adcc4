#pragma once
/// The comparison as a short table for people.

#include <string>
#include <vector>

#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// "mean-curvature: -1 to 1 on 8,356 vertices"
std::string field_line(const FieldOutcome& outcome);

/// Collects a row a method.
class ComparisonTable : public ComparisonSink {
 public:
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;
  /// The table, with a line on the field above it, the meaning of its columns and details of the runs below.
  std::string text() const;

 private:
  std::string headline_;
  std::vector<std::vector<std::string>> rows_;
  std::string foot_;
  std::string notes_;
};

}  // namespace morsel::tools
