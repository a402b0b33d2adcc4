#include "morsel/core/rethrow.h"

namespace morsel::core {

void rethrow_at(const Error& error, const std::string& where) {
  const std::string message = where + ": " + error.what();
  switch (error.kind()) {
    case ErrorKind::invalid_argument:
      throw InvalidArgument(message);
    case ErrorKind::bad_input:
      throw BadInput(message);
    case ErrorKind::write_failed:
      throw WriteFailed(message);
    case ErrorKind::cancelled:
      break;
  }
  throw Cancelled();
}

}  // namespace morsel::core
