#pragma once
/// A hierarchy of critical points and Morse-Smale complexes, by iteration of a smoothing method or by
/// persistence.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/persistence/threshold.h"
#include "morsel/tools/study/level.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

enum class HierarchyKind : std::uint8_t { iteration, persistence };
/// "iteration", "persistence".
std::string_view to_string(HierarchyKind kind);

/// A hierarchy in the syntax of the command line.
struct HierarchyRequest {
  FieldRequest field{.method = "",
                     .target = {}};  ///< no method: salient by iteration, conventional by persistence
  HierarchyKind kind = HierarchyKind::iteration;
  std::string levels;  ///< iterations or thresholds, separated by commas
  std::string counts;  ///< critical cells, in place of thresholds
};

/// A request whose names and numbers have been looked up.
struct HierarchyPlan {
  FieldPlan field;
  HierarchyKind kind = HierarchyKind::iteration;
  std::vector<int> iterations;  ///< ascending
  std::vector<persistence::Threshold> thresholds;
  std::vector<std::size_t> counts;
};

/// Fills in the method and levels where a request leaves them out: salient, levels 1,5,10 (the paper's Figure
/// 4) by iteration; conventional, levels 0.1%,1%,5% by persistence.
HierarchyRequest with_defaults(HierarchyRequest request);

/// Throws InvalidArgument on unknown names and keys, bad values, a level that is given twice, options
/// that exclude each other, and a method that has no iterations or fewer than the levels need. Levels may
/// come in any order. Touches no file.
HierarchyPlan prepare(const HierarchyRequest& request, const Registry& registry = Registry::standard());

/// The data that levels are made from.
struct HierarchyBasis {
  const MadeField& made;                             ///< by iteration, the last level's field
  const mscomplex::PersistenceHierarchy* hierarchy;  ///< null by iteration
  double hierarchy_seconds;
};

/// Receives the levels of a hierarchy as they are made, the finest first, so that no more than two need be in
/// memory.
class HierarchySink {
 public:
  virtual ~HierarchySink() = default;
  virtual void begin(const HierarchyBasis& basis) = 0;
  virtual void level(const Level& level) = 0;
  /// What run_hierarchy() calls: for sinks that keep levels without copying them.
  virtual void keep_level(const std::shared_ptr<const Level>& kept) { level(*kept); }
};

/// Makes the field, then the hierarchy level by level. Throws what functions, methods, sinks and
/// iteration_levels() throw.
void run_hierarchy(const core::LoadedMesh& loaded, const HierarchyPlan& plan,
                   const std::vector<HierarchySink*>& sinks, const core::Progress& progress = {});

}  // namespace morsel::tools
