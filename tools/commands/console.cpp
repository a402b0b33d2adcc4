#include "morsel/tools/commands/console.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "morsel/core/printable.h"

namespace morsel::tools {

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
  constexpr int kWidth = 30;
  const int filled = std::clamp(static_cast<int>(fraction * kWidth), 0, kWidth);
  std::cerr << "\r\033[K[" << std::string(static_cast<std::size_t>(filled), '#')
            << std::string(static_cast<std::size_t>(kWidth - filled), ' ') << "] "
            << static_cast<int>(100 * fraction) << " % " << (context_.empty() ? "" : context_ + ": ") << step
            << std::flush;
}

void Console::clear() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace morsel::tools
