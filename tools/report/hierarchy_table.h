#pragma once
/// The levels of a hierarchy as a short table for people.

#include <string>
#include <vector>

#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools {

/// Collects a row a level.
class HierarchyTable : public HierarchySink {
 public:
  /// Refers to `plan`.
  explicit HierarchyTable(const HierarchyPlan& plan) : plan_(plan) {}
  void begin(const HierarchyBasis& basis) override;
  void level(const Level& level) override;
  /// The table, with a line on the field above it, and below it where levels differ from the request.
  std::string text() const;

 private:
  const HierarchyPlan& plan_;
  std::string headline_;
  std::vector<std::vector<std::string>> rows_;
  std::string notes_;
};

}  // namespace morsel::tools
