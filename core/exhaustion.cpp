#include "morsel/core/exhaustion.h"

#include <cerrno>
#include <system_error>

namespace morsel::core {

void throw_if_exhausted(int error, const std::string& what) {
  if (error == EMFILE || error == ENFILE || error == ENOMEM || error == EAGAIN)
    throw std::system_error(error, std::generic_category(), what);
}

}  // namespace morsel::core
