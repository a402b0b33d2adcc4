#pragma once
/// What a person sees on standard error while a command runs.

#include <chrono>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "morsel/core/parallel/progress.h"

namespace morsel::tools {

/// Progress as a bar (on a terminal only), after some seconds with what the step will still take, and
/// messages, both on standard error and both silenced by `quiet`.
class Console {
 public:
  Console(bool quiet, std::stop_token stop);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// A hook that draws the bar and carries the stop token; refers to this console.
  core::Progress progress();
  const std::stop_token& stop_token() const { return stop_; }
  /// A line. What a terminal would take for more than text is escaped (printable.h), here and in what
  /// follows.
  void message(std::string_view text);
  /// A line about what was guessed, left out or passed over.
  void warning(std::string_view text);
  /// What may be the cause if the input is refused by a later step: set_action() adds it to the error. None
  /// if empty.
  void set_cause(std::string sentence) { cause_ = std::move(sentence); }
  const std::string& cause() const { return cause_; }
  /// Names what the steps are part of ("salient"), shown before the step.
  void enter(std::string_view context);

 private:
  void draw(std::string_view step, double fraction);
  void clear();

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::stop_token stop_;
  std::string context_;
  std::string cause_;
  std::chrono::steady_clock::time_point last_;
  std::string step_;                             // that is drawn
  double reached_ = 0;                           // of it
  std::chrono::steady_clock::time_point begun_;  // when it began
};

}  // namespace morsel::tools
