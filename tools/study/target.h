#pragma once
/// The target, a wanted number of critical points: as much smoothing as leaves enough of them, then
/// cancellation by persistence.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/diagram.h"

namespace morsel::tools {

/// How the wanted number was reached.
struct TargetOutcome {
  std::size_t wanted = 0;
  std::size_t reached = 0;
  int iterations = 0;  ///< of the method (1 if it has none) that were used in full
  double blend = 0;  ///< then this share of the step to the next iteration, which has too few critical points
  std::size_t before_cancelling = 0;                    ///< critical points left by that
  std::vector<persistence::PersistencePair> cancelled;  ///< in the order of persistence
  double largest_cancelled = 0;
  std::vector<core::Index>
      unfolded;  ///< multiple saddles that were unfolded to make up for missing critical points
  double largest_unfolding = 0;  ///< the largest change of a value by that
  std::string note;              ///< why another number was reached; empty if it was

  friend bool operator==(const TargetOutcome&, const TargetOutcome&) = default;
};

/// Throws InvalidArgument if a wanted number is given that no field can have.
void check_target(std::optional<std::size_t> target);

/// Observes the fields of a method, one by one. Fields are used as long as they have at least the wanted
/// number of critical points. If the next one has fewer, the furthest field on the straight line to it that
/// has enough is sought (by halving, 12 times, the logarithm of the remaining share). Points above the number
/// are cancelled in the order of persistence. Each pair removes two critical points, unless its saddle is a
/// multiple one: if that leaves too few, multiple saddles are unfolded (morse::unfold_saddle()), those first
/// that need the least change of value.
class TargetSearch {
 public:
  /// `start`: the method's input. `blends`: whether a blend of two fields is a sensible field; if not, a
  /// field with too few critical points is not used at all.
  TargetSearch(const core::ScalarField& start, std::size_t wanted, bool blends,
               const core::Progress& progress);

  /// The next field; returns false if no further ones are needed.
  bool offer(const core::ScalarField& field);
  /// The method starts again from its input.
  void restart();
  /// The number of fields used, and the last of them, not yet blended; the method's input before the first.
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
