#pragma once
/// The checks of the validate() functions.

#include <stdexcept>
#include <string>

#include "morsel/core/types.h"

namespace morsel::core {

/// require(holds, what, where) throws std::logic_error "CHECK: WHAT WHERE" if `holds` is false: for
/// contradictions within the library, which no input may cause.
class Require {
 public:
  /// `check` names the function that checks; it must outlive this.
  explicit constexpr Require(const char* check) : check_(check) {}

  void operator()(bool holds, const char* what) const {
    if (!holds) throw std::logic_error(std::string(check_) + ": " + what);
  }
  /// `where` is the number of the vertex, edge, … at which it must hold.
  void operator()(bool holds, const char* what, Index where) const {
    if (!holds) throw std::logic_error(std::string(check_) + ": " + what + " " + std::to_string(where));
  }

 private:
  const char* check_;
};

}  // namespace morsel::core
