#pragma once
/// Saying where an error came up.

#include <string>

#include "morsel/core/error.h"

namespace morsel::core {

/// Throws the error again, of the same kind, with where it came up before its sentence: "WHERE: …".
[[noreturn]] void rethrow_at(const Error& error, const std::string& where);

}  // namespace morsel::core
