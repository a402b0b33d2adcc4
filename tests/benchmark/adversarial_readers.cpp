// Costly inputs for the readers and for the building of meshes.

#include <memory>
#include <utility>

#include "benchmark/adversarial.h"
#include "morsel/core/mesh_io.h"
#include "support/adversarial.h"

namespace morsel::benchmark {
namespace {

using core::MeshFormat;
namespace adversarial = test::adversarial;

/// Reads a file of these bytes.
std::function<void()> reading(std::string bytes, MeshFormat format) {
  return [bytes = std::move(bytes), format] { core::parse_polygon_soup(bytes, format, "adversarial"); };
}

}  // namespace

std::vector<Family> reader_families() {
  using Size = std::size_t;
  return {
      {"PLY header of many properties", 20'000,
       [](const Plan&, Size n) { return reading(adversarial::ply_with_properties(n), MeshFormat::ply); }},
      {"PLY header of many elements", 20'000,
       [](const Plan&, Size n) { return reading(adversarial::ply_with_elements(n), MeshFormat::ply); }},
      {"ASCII STL of colliding points", 15'000,
       [](const Plan&, Size n) {
         return reading(adversarial::ascii_stl(adversarial::colliding_points(n)), MeshFormat::stl);
       }},
  };
}

}  // namespace morsel::benchmark
