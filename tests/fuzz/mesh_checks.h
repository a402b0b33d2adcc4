#pragma once
/// Checks of the targets of the mesh formats.

#include <functional>
#include <string_view>

#include "morsel/core/io/mesh_io.h"

namespace morsel::fuzz {

/// Checks the result of parse_polygon_soup(): it is a valid soup, is equal when written and read again, and
/// gives meshes that keep their rules. Does nothing if the bytes are refused.
void check_mesh_format(std::string_view bytes, core::MeshFormat format);

/// Reads the bytes by `read`, once in pieces of each size and once as a whole: both must give the same soup
/// or the same error.
void check_pieces(std::string_view bytes,
                  const std::function<core::LoadedSoup(std::string_view bytes, std::size_t chunk)>& read);

}  // namespace morsel::fuzz
