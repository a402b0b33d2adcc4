#include "morsel/core/parallel/exhaustion.h"

#include <cerrno>
#include <system_error>

#include "morsel/core/error.h"

namespace morsel::core {

void throw_if_exhausted(int error, const std::string& what) {
  if (error == EMFILE || error == ENFILE || error == ENOMEM || error == EAGAIN)
    throw std::system_error(error, std::generic_category(), what);
}

void fail_to_read(int error, const std::string& what) {
  throw_if_exhausted(error, what);
  throw BadInput(what + ": " + (error != 0 ? std::generic_category().message(error) : "reading failed"));
}

}  // namespace morsel::core
