#pragma once
/// Persistence cancellation: the field without its short-lived critical points (the paper's "TPS").

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"
#include "morsel/persistence/diagram.h"
#include "morsel/persistence/threshold.h"

namespace morsel::persistence {

struct CancellationOptions {
  /// Pairs of at most this persistence are cancelled. The paper's choice.
  Threshold threshold = Threshold::percent(0.1);
  /// If set, the threshold is ignored, and as many pairs are cancelled, in the order of Diagram::pairs, as
  /// bring the critical points of the field (minima + saddle vertices + maxima) down to this number, or else
  /// to the nearest below it.
  std::optional<std::size_t> count;
};

struct CancellationResult {
  core::ScalarField field;
  std::size_t cancelled_pairs = 0;
  double largest_cancelled = 0;   ///< the largest persistence of a cancelled pair; 0 if there is none
  std::size_t reached_count = 0;  ///< critical points of `field`, as classification counts them
  std::string note;               ///< with `count`: why another number was reached; empty if it was
  std::vector<PersistencePair> pairs = {};  ///< with `count`: the cancelled pairs in the order of persistence
};

/// Returns a field g on the mesh of f, with an order of its own. With t the largest cancelled persistence:
/// 1. |g − f|, computed in double, is at most t everywhere.
/// 2. The extrema of g are the essential ones and those of the pairs that stay, at the same vertices and with
///    the same values; survivors of equal value keep f's order. Saddles follow from the Euler identity.
/// 3. With a threshold, g has as many pairs of non-zero persistence as f has above it. (They may end below it
///    because their saddles move by up to t: cancelling again may cancel more.)
/// Caps are never cancelled. If nothing is to be cancelled, f itself is returned.
///
/// Algorithm: from the minima that stay, the basins of the others are flooded to where they overflow; on the
/// result, the maxima that do not stay are carved down likewise; last, each plateau that this leaves is
/// ordered so that all its vertices have a lower and a higher neighbour. Simpler than Edelsbrunner, Morozov,
/// Pascucci 2006 ("Persistence-sensitive simplification of functions on 2-manifolds"), which keeps the points
/// of the diagram that stay where they are; here they may move by t.
///
/// `count` is reached if some number of cancelled pairs leaves it. Each pair removes an extremum and one of a
/// saddle's multiplicity, so without multiple saddles the number of critical points falls by two a pair
/// and keeps its parity; it cannot fall below the essential classes and the saddles paired with caps.
/// Otherwise the nearest number below is taken, or above if there is none, and the note says so. Which
/// multiple saddles remain is known only after cancelling, so numbers of pairs around an estimate are tried,
/// 2²² / n but at least 12: where multiple saddles abound on a large mesh, a better one may be missed.
///
/// Throws InvalidArgument for a negative or non-finite threshold or a count of 0. O(n) and O(s log s) in the
/// number of saddles; with `count`, times the tries. The same result for every number of threads.
CancellationResult cancel(const core::ScalarField& f, const CancellationOptions& options = {},
                          const core::Progress& progress = {});

/// The method "tps" with the keys `threshold` ("0.1%" of the range, or a number in the field's unit) and
/// `count`, of which one may be given. Its details: cancelled_pairs, largest_cancelled, reached_count and,
/// with a count that was not reached, note. Throws InvalidArgument on bad values.
std::unique_ptr<core::Method> make_tps(core::ParameterReader& reader);

}  // namespace morsel::persistence
