#pragma once
/// Stop conditions of iterative methods, and records of their iterations.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/text/parameters.h"

namespace morsel::morse {

/// Conditions to stop; the first that holds ends the iterations. Those on counts apply to the input too.
struct StopCriteria {
  int iterations = 10;                          ///< at most; 0 returns the input as it is
  std::optional<std::size_t> until_count = {};  ///< until at most so many critical points are left
  std::optional<int> until_stable = {};  ///< until so many successive fields have the same counts; at least 2
  std::optional<double> until_change =
      {};  ///< until no value changes by more than this share of the input's extent
};

/// Declares and reads the keys iterations, until-count, until-stable and until-change. `iterations` is
/// the default of the first, but 1,000 where one of the others is given.
StopCriteria read_stop_criteria(core::ParameterReader& reader, int iterations);

/// As a report shows them; conditions that were not set are left out.
core::Parameters to_parameters(const StopCriteria& criteria);

/// Where an iterative method starts: at its input, or at a field made from it, which is then reported as
/// iteration 0.
enum class Start : std::uint8_t { given, made };

/// Counts and compares the fields that a method passes through, and says when to stop:
///
///   IterationControl control(input, criteria, context);
///   while (control.more()) control.record(one iteration made of control.field());
///   return control.result(parameters, details);
///
/// Not thread-safe. Recording is O(n log n), parallel, the same for every number of threads.
class IterationControl {
 public:
  /// Refers to `context`. Throws InvalidArgument on criteria out of range.
  IterationControl(const core::ScalarField& input, const StopCriteria& criteria,
                   const core::MethodContext& context, Start start = Start::given);

  /// Whether another iteration is to be run.
  bool more() const { return stopped_by_.empty(); }
  /// The next iteration's values, per vertex. Equal values keep the order of the input.
  void record(std::vector<double> values);
  /// Whether the next iteration's field is evaluated: for a criterion, for the counts of all iterations, for
  /// MethodContext::on_iteration, or as the last one.
  bool needs_field() const;
  /// In place of record() where the next iteration's values are not needed; field() does not change.
  void skip() { ++iteration_; }
  /// The method starts again from the input.
  void restart();

  /// The field of the last recorded iteration; before the first one the input.
  const core::ScalarField& field() const { return field_; }
  int iterations_run() const { return iteration_; }
  /// "iterations", "until-count", "until-stable", "until-change", or "caller" if only the context ended it;
  /// empty while more().
  std::string_view stopped_by() const { return stopped_by_; }

  /// field() with the records and the end of the iterations, which `details` gains, too. The parameters
  /// are those of the criteria followed by `parameters`.
  core::MethodResult result(core::Parameters parameters, core::Parameters details = {}) const;

 private:
  bool counted() const;
  void count(double change);
  void decide(double change);
  void tell();

  core::ScalarField input_;
  StopCriteria criteria_;
  const core::MethodContext& context_;
  Start start_;
  core::ScalarField field_;
  int iteration_ = 0;
  std::string_view stopped_by_;
  std::vector<core::IterationRecord> records_;
};

}  // namespace morsel::morse
