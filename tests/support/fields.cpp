#include "support/fields.h"

#include <cmath>
#include <random>
#include <utility>

namespace morsel::test {

std::vector<double> random_values(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> values(count);
  for (double& value : values) value = (random() + random() / 4294967296.0) / 4294967296.0;
  return values;
}

std::vector<double> tied_values(std::size_t count, int levels, unsigned seed) {
  std::vector<double> values = random_values(count, seed);
  for (double& value : values) value = std::floor(value * levels);
  return values;
}

std::vector<double> smooth_values(const core::TriangleMesh& mesh, int rounds, unsigned seed) {
  std::vector<double> values = random_values(mesh.vertex_count(), seed);
  std::vector<core::Index> ring;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> next(values.size());
    for (core::Index v = 0; v < mesh.vertex_count(); ++v) {
      mesh.neighbors(v, ring);
      double sum = values[v];
      for (const core::Index u : ring) sum += values[u];
      next[v] = sum / static_cast<double>(ring.size() + 1);
    }
    values = std::move(next);
  }
  return values;
}

std::vector<double> plateau_values(const core::TriangleMesh& mesh, int levels, unsigned seed) {
  std::vector<double> values = smooth_values(mesh, 2, seed);
  for (double& value : values) value = std::floor(value * levels);
  return values;
}

std::vector<NamedField> field_zoo(const core::TriangleMesh& mesh, unsigned seed) {
  const std::size_t n = mesh.vertex_count();
  std::vector<NamedField> zoo;
  zoo.push_back({"random", {mesh, random_values(n, seed)}});
  zoo.push_back({"two levels", {mesh, tied_values(n, 2, seed + 1)}});
  zoo.push_back({"five levels", {mesh, tied_values(n, 5, seed + 2)}});
  zoo.push_back({"plateaus", {mesh, plateau_values(mesh, 12, seed + 3)}});
  zoo.push_back({"smooth", {mesh, smooth_values(mesh, 4, seed + 4)}});
  zoo.push_back({"constant", {mesh, std::vector<double>(n, 1.5)}});
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values(n);
    for (core::Index v = 0; v < n; ++v) values[v] = mesh.position(v)[axis];
    zoo.push_back({std::string("height ") + "xyz" [axis], { mesh, std::move(values) }});
  }
  return zoo;
}

}  // namespace morsel::test
