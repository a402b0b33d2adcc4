// Of a library that has the part FORMATS.

#include "morsel/core/io/file_formats.h"

namespace morsel::core {

void require_formats(std::string_view) {}

}  // namespace morsel::core
