#include "mesh_checks.h"
#include "morsel/core/io/mesh_formats.h"
#include "target.h"

void morsel::fuzz::asc(std::string_view bytes) {
  check_mesh_format(bytes, core::MeshFormat::asc);
  check_pieces(bytes, [](std::string_view text, std::size_t chunk) {
    return core::read_asc(text, "fuzz", {}, chunk);
  });
}
