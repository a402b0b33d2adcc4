#include "morsel/core/parallel/stop.h"

#include <utility>

#include "morsel/core/error.h"

namespace morsel::core {

const std::stop_token*& detail::current_stop() {
  thread_local const std::stop_token* current = nullptr;
  return current;
}

StopScope::StopScope(std::stop_token token)
    : token_(std::move(token)), before_(std::exchange(detail::current_stop(), &token_)) {}

StopScope::~StopScope() { detail::current_stop() = before_; }

void throw_if_stopped() {
  const std::stop_token* const stop = detail::current_stop();
  if (stop != nullptr && stop->stop_requested()) throw Cancelled();
}

}  // namespace morsel::core
