#include "morsel/tools/commands/console.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "morsel/core/text/printable.h"

namespace morsel::tools {

namespace {

/// What a step that has run for some seconds will still take if it goes on as it did; "" if that cannot be
/// told.
std::string remaining_time(std::chrono::steady_clock::duration so_far, double fraction) {
  constexpr double kPatience = 2;
  constexpr double kLeast = 0.02;
  const double seconds = std::chrono::duration<double>(so_far).count();
  if (seconds < kPatience || fraction < kLeast || fraction >= 1) return "";
  const double left = seconds * (1 - fraction) / fraction;
  constexpr double kMinute = 60;
  return left < 2 * kMinute ? ", about " + std::to_string(std::lround(left)) + " s left"
                            : ", about " + std::to_string(std::lround(left / kMinute)) + " min left";
}

}  // namespace

Console::Console(bool quiet, std::stop_token stop)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), stop_(std::move(stop)) {}

Console::~Console() { clear(); }

core::Progress Console::progress() {
  core::Progress::Report report;
  if (terminal_ && !quiet_) report = [this](std::string_view step, double fraction) { draw(step, fraction); };
  return core::Progress(std::move(report), stop_);
}

void Console::message(std::string_view text) {
  if (quiet_) return;
  clear();
  std::cerr << core::printable(text) << '\n';
}

void Console::warning(std::string_view text) { message("morsel: warning: " + std::string(text)); }

void Console::enter(std::string_view context) { context_ = core::printable(context); }

void Console::draw(std::string_view step, double fraction) {
  constexpr auto kInterval = std::chrono::milliseconds(50);  // faster than the eye is only slower to print
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < kInterval) return;
  last_ = now;
  drawn_ = true;
  if (step != step_ || fraction < reached_) begun_ = now;  // another step, or the same one again
  step_ = step;
  reached_ = fraction;
  constexpr int kWidth = 30;
  const int filled = std::clamp(static_cast<int>(fraction * kWidth), 0, kWidth);
  std::cerr << "\r\033[K[" << std::string(static_cast<std::size_t>(filled), '#')
            << std::string(static_cast<std::size_t>(kWidth - filled), ' ') << "] "
            << static_cast<int>(100 * fraction) << " % " << (context_.empty() ? "" : context_ + ": ") << step
            << remaining_time(now - begun_, fraction) << std::flush;
}

void Console::clear() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace morsel::tools
