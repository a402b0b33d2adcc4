#include "benchmark/workloads.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/height.h"
#include "support/refinement.h"

namespace morsel::benchmark {

Workload workload(const std::string& sample, int pieces) {
  const core::TriangleMesh original = core::read_mesh(test::sample(sample + ".off")).mesh;
  if (pieces == 1) return {sample, original};
  test::Soup soup = test::refined(original, pieces);
  test::add_noise(soup, 0.05, 1);
  return {sample + " / " + std::to_string(pieces), soup.mesh()};
}

core::ScalarField field_of(const core::TriangleMesh& mesh, const std::string& name) {
  return name == "height" ? morse::height(mesh) : morse::mean_curvature(mesh);
}

std::string write_mesh(const core::TriangleMesh& mesh, const std::string& folder,
                       const std::string& extension) {
  const std::string path = folder + "/mesh." + extension;
  if (extension == "off") {
    core::write_off(path, mesh);
  } else if (extension == "ply") {
    core::write_ply(path, mesh);
  } else {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) throw std::runtime_error("cannot write " + path);
    for (const core::Point& p : mesh.positions())
      std::fprintf(file, "v %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    for (const core::Triangle& t : mesh.triangles())
      std::fprintf(file, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
    std::fclose(file);
  }
  return path;
}

}  // namespace morsel::benchmark
