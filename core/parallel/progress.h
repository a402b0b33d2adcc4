#pragma once
/// Progress and cancellation of a computation.

#include <functional>
#include <stop_token>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::core {

/// A hook for progress and cancellation, passed by reference to everything that may take long. The default
/// one reports nothing and never stops. Copies share hook and token.
class Progress {
 public:
  /// Called with the step's name and the fraction of it that is done, in [0, 1].
  using Report = std::function<void(std::string_view step, double fraction)>;

  Progress() = default;
  explicit Progress(Report report, std::stop_token stop = {})
      : report_(std::move(report)), stop_(std::move(stop)) {}

  /// Reports, then throws Cancelled if a stop was requested. Called by the thread that called the library
  /// only.
  void update(std::string_view step, double fraction) const {
    if (report_) report_(step, fraction);
    throw_if_cancelled();
  }

  /// The same stop token without reports: for the parts of a step that reports its own progress, which theirs
  /// would hide, and for other threads than the caller's.
  Progress unreported() const { return Progress({}, stop_); }

  /// Tells one computation from another. May be called from any thread, as throw_if_cancelled().
  const std::stop_token& stop_token() const { return stop_; }

  /// Throws Cancelled if a stop was requested.
  void throw_if_cancelled() const {
    if (stop_.stop_requested()) throw Cancelled();
  }

 private:
  Report report_;
  std::stop_token stop_;
};

}  // namespace morsel::core
