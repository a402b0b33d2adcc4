#pragma once
/// Adds to an error's message where it occurred.

#include <string>

#include "morsel/core/error.h"

namespace morsel::core {

/// Throws an error of the same kind whose message begins with where it occurred: "WHERE: …".
[[noreturn]] void rethrow_at(const Error& error, const std::string& where);

}  // namespace morsel::core
