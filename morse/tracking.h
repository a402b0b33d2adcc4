#pragma once
/// The origins of critical points of a smoothed field among those of the input.

#include <memory>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/critical_points.h"

namespace morsel::morse {

/// Follows critical points back through a sequence of fields on one mesh (the iterations of a method, the
/// steps of a chain) to those of the first field, the input. In the field before, a critical point comes from
///
/// - itself, if that vertex has the same type there;
/// - else, for a maximum, the maximum that is reached there along highest neighbours, and for a minimum
///   likewise along lowest ones. It has no origin if the path ends at a boundary vertex that is no extremum
///   (the virtual maximum of a boundary loop) or further than `reach` away: then it is a new extremum on the
///   slope of a large hill;
/// - else, for a saddle, the nearest saddle along the mesh's edges, of equally near ones that of smaller
///   number. It has no origin if there is none within `reach`.
///
/// So every critical point has at most one origin, of its own type; several may share one, if it split or new
/// ones appeared on the same hill. A value type; copies are independent and share the field.
class CriticalPointTracker {
 public:
  /// `reach` is a length, not negative. Keeps a copy of the input, or shares it.
  CriticalPointTracker(const core::ScalarField& input, double reach, const core::Progress& progress = {});
  CriticalPointTracker(std::shared_ptr<const core::ScalarField> input, double reach,
                       const core::Progress& progress = {});

  /// The next field on the same mesh. O(n) and the lengths of the paths; parallel, the same for every number
  /// of threads.
  void advance(const core::ScalarField& next);

  /// The last field.
  const core::ScalarField& field() const { return *field_; }
  /// Its critical points.
  const CriticalPoints& points() const { return points_; }
  /// For each of points(), the vertex of the input's critical point that it came from; kNone if it has no
  /// origin.
  std::span<const core::Index> origins() const { return origins_; }

 private:
  core::Index previous(const CriticalPoint& point, std::span<const CriticalType> types) const;

  std::shared_ptr<const core::ScalarField> field_;
  double reach_;
  core::Progress progress_;
  CriticalPoints points_;
  std::vector<core::Index> origins_;
};

}  // namespace morsel::morse
