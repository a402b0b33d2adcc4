#pragma once
/// Where the critical points of a smoothed field came from.

#include <memory>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/critical_points.h"

namespace morsel::morse {

/// Follows critical points back through a sequence of fields on one mesh (the iterations of a method, the
/// steps of a chain) to those of the first field, the input. From one field to the one before it a critical
/// point goes
///
///   – to itself, if that vertex had the same type there;
///   – else, a maximum, up the hill that it stood on there: along highest neighbours to a maximum; a minimum
///   likewise
///     down. The way is lost where it ends at a boundary that is no extremum (the virtual maximum of a
///     boundary loop), and if the end is further than `reach` away: then it is a new one on the side of a
///     large hill;
///   – else, a saddle, to the nearest saddle along the mesh's edges, of equally near ones the one of smaller
///   number; it
///     is lost if there is none within `reach`.
///
/// So every critical point has at most one origin, of its own type; several may share one, if it came apart
/// or new ones appeared on the same hill. A value type; copies are independent and share the field.
class CriticalPointTracker {
 public:
  /// `reach` is a length, not negative. Keeps a copy of the input, or shares it.
  CriticalPointTracker(const core::ScalarField& input, double reach, const core::Progress& progress = {});
  CriticalPointTracker(std::shared_ptr<const core::ScalarField> input, double reach,
                       const core::Progress& progress = {});

  /// The next field on the same mesh. O(n) and what the ways take; parallel, the same for every number of
  /// threads.
  void advance(const core::ScalarField& next);

  /// The last field.
  const core::ScalarField& field() const { return *field_; }
  /// Its critical points.
  const CriticalPoints& points() const { return points_; }
  /// For each of points(), the vertex of the input's critical point that it came from; kNone if the way was
  /// lost.
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
