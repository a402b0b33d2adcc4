#pragma once
/// The part GEOTIFF of the library: terrain from GeoTIFF files, by GDAL. Internal.

#include <string>
#include <string_view>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// The first band of a GeoTIFF as a terrain (elevation_grid.h). Cells that its mask leaves out, or that have
/// its value for "no data", have no data; scale and offset are applied. Without a georeference cells are
/// squares of side 1. A rotated one is taken as it is. Refuses pictures, bands of complex numbers and more
/// cells than the file can hold. In a library without the part it throws InvalidArgument, saying how to have
/// it (MORSEL_WITH_GEOTIFF).
LoadedSoup read_geotiff(std::string_view bytes, const std::string& file, const Progress& progress);

}  // namespace morsel::core
