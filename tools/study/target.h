#pragma once
/// Ending with a wanted number of critical points: as much smoothing as leaves enough of them, persistence
/// for the rest.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/diagram.h"

namespace morsel::tools {

/// How the wanted number came about.
struct TargetOutcome {
  std::size_t wanted = 0;
  std::size_t reached = 0;
  int iterations = 0;  ///< of the method (1 if it has none) that were made use of in full
  double blend =
      0;  ///< then this share of the way to the next iteration, which alone would have gone too far
  std::size_t before_cancelling = 0;                    ///< critical points left by that
  std::vector<persistence::PersistencePair> cancelled;  ///< in the order of persistence
  double largest_cancelled = 0;
  std::vector<core::Index>
      unfolded;                  ///< multiple saddles that were taken apart to make up for what is missing
  double largest_unfolding = 0;  ///< the largest change of a value by that
  std::string note;              ///< why another number was reached; empty if it was

  friend bool operator==(const TargetOutcome&, const TargetOutcome&) = default;
};

/// Throws InvalidArgument if a wanted number is given that no field can have.
void check_target(std::optional<std::size_t> target);

/// The way of a method, watched field by field. Fields count as long as they have at least the wanted number
/// of critical points. If the next one has fewer, the furthest point on the straight line to it is looked for
/// that has not (by halving, 12 times, the logarithm of what is left to it). What is left above the number is
/// cancelled in the order of persistence. Each pair takes two critical points away, unless its saddle is a
/// multiple one: if that leaves too few, multiple saddles are unfolded (morse::unfold_saddle()), those first
/// that need the least change of value.
class TargetSearch {
 public:
  /// `start`: the method's input. `blends`: whether something between two fields is a sensible field; if not,
  /// what goes too far is not made use of.
  TargetSearch(const core::ScalarField& start, std::size_t wanted, bool blends,
               const core::Progress& progress);

  /// The next field on the way; false if there is no use in going on.
  bool offer(const core::ScalarField& field);
  /// The method begins again from its input.
  void restart();
  /// The number of fields that count, and the last of them, not yet blended; the method's input before the
  /// first.
  int iterations() const { return iterations_; }
  const core::ScalarField& reached() const { return reached_; }
  bool wants_more() const { return !beyond_ && total_ > wanted_; }

  struct Result {
    core::ScalarField smoothed;  ///< before cancelling
    core::ScalarField field;
    TargetOutcome outcome;
  };
  Result finish() const;

 private:
  double furthest_blend() const;

  core::ScalarField start_;
  std::size_t wanted_;
  bool blends_;
  core::Progress progress_;
  core::ScalarField reached_;
  std::optional<core::ScalarField> beyond_;  // the first field with too few
  std::size_t total_ = 0;                    // of reached_
  int iterations_ = 0;
};

}  // namespace morsel::tools
