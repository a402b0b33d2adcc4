#pragma once
/// The target, a wanted number of critical points: as many iterations of a method as leave enough of them,
/// then cancellation by persistence.

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
  int iterations = 0;  ///< of the method that the field had (1 if it has none); 0 is a method's input
  /// Critical points after one more iteration, if that was too few: the method was not run to its end.
  std::optional<std::size_t> left_by_next = {};
  std::size_t before_cancelling = 0;                    ///< critical points of the method's field
  std::vector<persistence::PersistencePair> cancelled;  ///< in the order of persistence
  double largest_cancelled = 0;
  std::vector<core::Index>
      unfolded;  ///< multiple saddles that were unfolded to make up for missing critical points
  double largest_unfolding = 0;  ///< the largest change of a value by that
  std::string note;              ///< why another number was reached; empty if it was

  friend bool operator==(const TargetOutcome&, const TargetOutcome&) = default;
};

/// What an iterative method's next iteration would have left, in a sentence; empty if it was run to its end.
std::string early_end(const TargetOutcome& outcome);

/// Throws InvalidArgument if a wanted number is given that no field can have.
void check_target(std::optional<std::size_t> target);

/// Observes the fields of a method, one by one. The method's field is the first one with the wanted number of
/// critical points, or else the last one with more before one that has fewer; if none has as many, it is the
/// method's last, and the note says so. The method's input is not used, whatever its number: a method that
/// adds critical points is applied, too. Points of the field above the wanted number are cancelled in the
/// order of persistence. Each pair removes two critical points, unless its saddle is a multiple one: if that
/// leaves too few, multiple saddles are unfolded (morse::unfold_saddle()), those first that need the least
/// change of value, where there are enough of them.
class TargetSearch {
 public:
  /// `start`: the method's input. `cancels_pairs`: what cancels fewer pairs of it is the same method, so that
  /// the input counts as a field of the method.
  TargetSearch(const core::ScalarField& start, std::size_t wanted, bool cancels_pairs,
               const core::Progress& progress);

  /// The next field; returns false if no further ones are needed.
  bool offer(const core::ScalarField& field);
  /// The method starts again from its input.
  void restart();
  /// The last field that was offered and is not beyond the one to end with; the method's input before the
  /// first.
  const core::ScalarField& current() const { return current_; }
  /// Whether a field was offered that has too few, after one that had enough.
  bool is_beyond() const { return left_by_next_.has_value(); }

  struct Result {
    core::ScalarField smoothed;  ///< before cancelling
    core::ScalarField field;
    TargetOutcome outcome;
  };
  /// At least one field was offered.
  Result finish() const;

 private:
  bool wants_more() const { return !is_beyond() && total_ != wanted_; }
  std::string too_few() const;

  core::ScalarField start_;
  std::size_t start_total_;
  std::size_t wanted_;
  bool cancels_pairs_;
  core::Progress progress_;
  core::ScalarField current_;
  std::size_t total_ = 0;  // of current_
  std::size_t most_ = 0;   // of the fields up to current_
  int iterations_ = 0;     // fields up to current_
  std::optional<std::size_t> left_by_next_;
};

}  // namespace morsel::tools
