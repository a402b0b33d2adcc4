#pragma once
/// The segments of a field, made from a request.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/segments.h"
#include "morsel/persistence/threshold.h"

namespace morsel::tools {

struct SegmentRequest {
  mscomplex::SegmentKind kind = mscomplex::SegmentKind::descending;
  /// Merge by persistence until there are at most so many segments.
  std::optional<std::size_t> segments;
  /// Or: merge all of at most this persistence. Neither: merge nothing.
  std::optional<persistence::Threshold> persistence;
};

struct MadeSegments {
  mscomplex::PersistenceHierarchy hierarchy;
  mscomplex::Segments segments = {};
  core::Index unmerged = 0;         ///< segments before merging
  std::size_t cancelled_pairs = 0;  ///< of the extrema whose segments the kind has
  double largest_persistence = 0;   ///< of those; 0 if there is none
  std::string note = {};            ///< why there are more than requested; empty if there are not

  /// Smallest, middle (of two the lower) and largest area.
  struct Areas {
    double smallest, median, largest;
  };
  Areas areas() const;
};

/// Throws InvalidArgument for a request of 0 segments, of both ways at once, or a bad threshold. Needs no
/// field.
void check(const SegmentRequest& request);

/// Builds complex, hierarchy and segments. The level is the first one of the hierarchy that meets the
/// request.
MadeSegments make_segments(const core::ScalarField& field, const SegmentRequest& request,
                           const core::Progress& progress = {});

}  // namespace morsel::tools
