#include "morsel/tools/study/made_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"

namespace morsel::tools {

using mscomplex::NodeKind;
using mscomplex::PersistenceHierarchy;
using mscomplex::Segmenter;
using mscomplex::SegmentKind;

namespace {

core::Index level_for(const Segmenter& segmenter, const SegmentRequest& request,
                      const core::ScalarField& field) {
  if (request.persistence) return segmenter.hierarchy().level_above(request.persistence->on(field));
  if (!request.segments) return 0;
  return segmenter.level_with(
      static_cast<core::Index>(std::min<std::size_t>(*request.segments, core::kNone - 1)));
}

/// Counts the cancellations that joined segments of this kind.
void count_cancelled(MadeSegments& made) {
  for (const mscomplex::Cancellation& c : made.hierarchy.cancellations().first(made.segments.level)) {
    const bool of_minimum = made.hierarchy.complex().kind(c.extremum) == NodeKind::minimum;
    if (made.segments.kind != SegmentKind::morse_smale &&
        of_minimum != (made.segments.kind == SegmentKind::ascending))
      continue;
    ++made.cancelled_pairs;
    made.largest_persistence = c.persistence;  // in ascending order
  }
}

std::string why_more(SegmentKind kind) {
  switch (kind) {
    case SegmentKind::ascending:
      return "each component has a minimum";
    case SegmentKind::descending:
      return "each component has a maximum, or the pieces of what flows out through its boundary loops";
    case SegmentKind::morse_smale:
      return "each component has the quads of its handles and boundary loops, or else one segment";
  }
  return {};
}

}  // namespace

void check(const SegmentRequest& request) {
  if (request.segments && request.persistence)
    throw core::InvalidArgument(
        "a number of segments and a persistence both say how far to merge: give one of them");
  if (request.segments && *request.segments == 0)
    throw core::InvalidArgument("the number of segments to merge to must be at least 1, not 0");
  if (request.persistence && !(std::isfinite(request.persistence->value) && request.persistence->value >= 0))
    throw core::InvalidArgument("a persistence to merge by must be a finite number of at least 0, not " +
                                persistence::to_string(*request.persistence));
}

MadeSegments make_segments(const core::ScalarField& field, const SegmentRequest& request,
                           const core::Progress& progress) {
  check(request);
  MadeSegments made{PersistenceHierarchy(field, progress)};
  const Segmenter segmenter(field, made.hierarchy, request.kind, progress);
  made.unmerged = segmenter.count(0);
  made.segments = segmenter.segments(level_for(segmenter, request, field), progress);
  count_cancelled(made);
  if (request.segments && made.segments.count() > *request.segments)
    made.note = "merging ends with " + core::grouped(made.segments.count()) + " segments, more than the " +
                core::grouped(*request.segments) + " asked for: no pair is left to cancel; " +
                why_more(request.kind);
  return made;
}

MadeSegments::Areas MadeSegments::areas() const {
  std::vector<double> sorted;
  sorted.reserve(segments.count());
  for (const mscomplex::Segment& segment : segments.segments) sorted.push_back(segment.area);
  std::sort(sorted.begin(), sorted.end());
  return {sorted.front(), sorted[(sorted.size() - 1) / 2], sorted.back()};
}

}  // namespace morsel::tools
