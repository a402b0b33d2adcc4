#include "morsel/tools/drawing/pictures.h"

#include <string>

#include "morsel/core/error.h"

namespace morsel::tools::drawing {

void require_pictures(std::string_view what) {
  if (!has_pictures())
    throw core::InvalidArgument(
        "this morsel was built without pictures, which " + std::string(what) +
        " needs: build it with -DMORSEL_WITH_PICTURES=ON, for which the packages libembree-dev, libpng-dev, "
        "libfreetype-dev, libcairo2-dev and fonts-dejavu-core are needed");
}

}  // namespace morsel::tools::drawing
