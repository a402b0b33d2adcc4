// Entry point for libFuzzer: any bytes, read as every format, give a valid mesh or a BadInput.
//
// With clang: clang++ -std=c++20 -fsanitize=fuzzer,address … tests/fuzz/read_mesh_fuzzer.cpp, then run it on
// tests/corpus/meshes. The suite runs it over the same corpus and seeded mutations of it (replay_test.cpp).

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "morsel/core/error.h"
#include "morsel/core/mesh_io.h"

using namespace morsel::core;

namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

void check(const BuiltMesh& built) {
  const VertexNumbering& numbering = built.numbering;
  // validate() takes the slowest definitions; what it would tell of a large mesh it tells of a small one.
  if (built.mesh.triangle_count() < 1000) built.mesh.validate();
  require(numbering.to_input.empty() == numbering.from_input.empty(), "half a numbering");
  if (numbering.to_input.empty()) {
    require(numbering.input_count == built.mesh.vertex_count(), "no numbering though vertices changed");
    return;
  }
  require(numbering.to_input.size() == built.mesh.vertex_count(), "size of to_input");
  require(numbering.from_input.size() == numbering.input_count, "size of from_input");
  for (Index v = built.mesh.vertex_count(); v-- > 0;) {
    const Index input = numbering.to_input[v];
    require(input < numbering.input_count && numbering.from_input[input] <= v, "numbering");
    require(numbering.to_input[numbering.from_input[input]] == input, "numbering there and back");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl}) {
    try {
      const LoadedSoup loaded = parse_polygon_soup(bytes, format, "fuzz");
      for (const VertexProperty& p : loaded.properties)
        require(p.values.size() == loaded.soup.positions.size(), "size of a property");
      for (const bool repair : {false, true}) {
        try {
          check(build_mesh(loaded.soup, {.repair = repair}));
        } catch (const BadInput&) {
        }
      }
    } catch (const BadInput&) {
    }
  }
  return 0;
}
