#pragma once
/// When an iterative method ends, and what is known of each of its iterations.

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

/// Several conditions to stop; the first that holds counts. Those of counts are asked of the input too.
struct StopCriteria {
  int iterations = 10;                          ///< at most; 0 returns the input as it is
  std::optional<std::size_t> until_count = {};  ///< until at most so many critical points are left
  std::optional<int> until_stable = {};  ///< until so many fields running have the same counts; at least 2
  std::optional<double> until_change =
      {};  ///< until no value changes by more than this share of the input's extent
};

/// Declares and reads the keys iterations, until-count, until-stable and until-change. With one of the latter
/// and without `iterations` there may be 1,000 of them, else `iterations`.
StopCriteria read_stop_criteria(core::ParameterReader& reader, int iterations);

/// As a report shows them; conditions that were not set are left out.
core::Parameters to_parameters(const StopCriteria& criteria);

/// Where an iterative method begins: at the field that it was given, or at one that it made of it, which
/// listeners are then told as iteration 0.
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
  /// Whether the next iteration's field is looked at: by a criterion, by who counts all of them, by
  /// MethodContext::on_iteration, or as the last one.
  bool needs_field() const;
  /// In place of record() where the next iteration's values are not needed; field() stays what it is.
  void skip() { ++iteration_; }
  /// The method begins again from the input.
  void restart();

  /// After the last iteration that was recorded, the input before the first.
  const core::ScalarField& field() const { return field_; }
  int iterations_run() const { return iteration_; }
  /// "iterations", "until-count", "until-stable", "until-change", or "caller" if only the context ended it;
  /// empty while more().
  std::string_view stopped_by() const { return stopped_by_; }

  /// field() with the curve of counts; `details` gains iterations_run and stopped_by. `parameters` are those
  /// of the criteria followed by the ones given.
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
