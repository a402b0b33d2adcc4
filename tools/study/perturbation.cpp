#include "morsel/tools/study/perturbation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/subdivision.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/tools/study/decimation.h"
#include "morsel/tools/study/random_stream.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

constexpr int kMostPieces = 16;

std::vector<Point> positions_of(const TriangleMesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

PerturbedMesh with_noise(const core::LoadedMesh& clean, double deviation, NoiseKind direction,
                         std::uint64_t seed, std::uint64_t trial) {
  const std::vector<Point> normals = direction == NoiseKind::normal
                                         ? morse::vertex_normals(morse::unit_sized(clean.mesh).mesh)
                                         : std::vector<Point>();
  const RandomUse use = direction == NoiseKind::normal ? RandomUse::normal_noise : RandomUse::isotropic_noise;
  std::vector<Point> positions = positions_of(clean.mesh);
  core::parallel_for_each(positions.size(), [&](std::size_t v) {
    RandomStream random(seed, use, {trial, v});
    if (direction == NoiseKind::normal) {
      positions[v] += deviation * random.normal() * normals[v];
    } else {
      for (int axis = 0; axis < 3; ++axis) positions[v][axis] += deviation * random.normal();
    }
  });
  return {{clean.mesh.with_positions(std::move(positions)), clean.source}, positions_of(clean.mesh)};
}

PerturbedMesh subdivided(const core::LoadedMesh& clean, int pieces) {
  TriangleMesh mesh = core::subdivided(clean.mesh, pieces);
  core::MeshSource source{clean.source.numbering, {}, clean.source.repairs, clean.source.warnings};
  core::VertexNumbering& numbering = source.numbering;
  if (numbering.to_input.empty()) {
    numbering.input_count = mesh.vertex_count();
  } else {  // new vertices are numbered after the file's
    for (Index v = clean.mesh.vertex_count(); v < mesh.vertex_count(); ++v) {
      numbering.to_input.push_back(static_cast<Index>(numbering.input_count++));
      numbering.from_input.push_back(v);
    }
  }
  std::vector<Point> places = positions_of(mesh);
  return {{std::move(mesh), std::move(source)}, std::move(places)};
}

}  // namespace

std::string_view to_string(PerturbationKind kind) {
  switch (kind) {
    case PerturbationKind::noise:
      return "noise";
    case PerturbationKind::decimation:
      return "decimation";
    case PerturbationKind::subdivision:
      return "subdivision";
  }
  return "";
}

std::string_view to_string(NoiseKind kind) { return kind == NoiseKind::normal ? "normal" : "isotropic"; }

std::string to_string(const Perturbation& perturbation) {
  return std::string(to_string(perturbation.kind)) + " " + core::shortest(perturbation.amount);
}

void check(const Perturbation& perturbation) {
  const double amount = perturbation.amount;
  switch (perturbation.kind) {
    case PerturbationKind::noise:
      if (!(amount >= 0 && std::isfinite(amount)))
        throw core::InvalidArgument("noise of " + core::shortest(amount) +
                                    " mean edge lengths is not possible: it must be 0 or more");
      return;
    case PerturbationKind::decimation:
      if (!(amount > 0 && amount <= 1))
        throw core::InvalidArgument("decimation to " + core::shortest(amount) +
                                    " of the vertices is not possible: it must be above 0 and at most 1");
      return;
    case PerturbationKind::subdivision:
      if (!(amount >= 1 && amount <= kMostPieces && amount == std::floor(amount)))
        throw core::InvalidArgument("edges cannot be cut into " + core::shortest(amount) +
                                    " pieces: it must be a whole number from 1 to " +
                                    std::to_string(kMostPieces));
      return;
  }
}

PerturbedMesh perturb(const core::LoadedMesh& clean, const Perturbation& perturbation, std::uint64_t seed,
                      std::uint64_t trial) {
  check(perturbation);
  switch (perturbation.kind) {
    case PerturbationKind::noise:
      return with_noise(clean, perturbation.amount * core::mean_edge_length(clean.mesh),
                        perturbation.direction, seed, trial);
    case PerturbationKind::decimation: {
      core::LoadedMesh mesh = decimated(clean, perturbation.amount, seed, trial);
      std::vector<Point> places = positions_of(mesh.mesh);
      return {std::move(mesh), std::move(places)};
    }
    case PerturbationKind::subdivision:
      return subdivided(clean, static_cast<int>(perturbation.amount));
  }
  return {clean, positions_of(clean.mesh)};
}

}  // namespace morsel::tools
