// In place of the reading of GeoTIFF, in a library without GDAL.

#include "morsel/core/error.h"
#include "morsel/core/io/geotiff.h"

namespace morsel::core {

LoadedSoup read_geotiff(std::string_view, const std::string& file, const Progress&) {
  throw InvalidArgument(
      "cannot read \"" + file +
      "\": this morsel was built without GeoTIFF: build it with "
      "-DMORSEL_WITH_GEOTIFF=ON, for which the package libgdal-dev is needed, or convert the "
      "file to an ESRI ASCII grid (gdal_translate -of AAIGrid)");
}

}  // namespace morsel::core
