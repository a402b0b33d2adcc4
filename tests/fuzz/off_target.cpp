#include "mesh_checks.h"
#include "morsel/core/io/mesh_formats.h"
#include "target.h"

void morsel::fuzz::off(std::string_view bytes) {
  check_mesh_format(bytes, core::MeshFormat::off);
  check_pieces(bytes, [](std::string_view text, std::size_t chunk) {
    return core::read_off(text, "fuzz", {}, chunk);
  });
}
