#pragma once
/// Perturbed surfaces: with noise, with fewer vertices, with more.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

enum class PerturbationKind : std::uint8_t { noise, decimation, subdivision };
/// "noise", "decimation", "subdivision".
std::string_view to_string(PerturbationKind kind);

enum class NoiseKind : std::uint8_t {
  normal,    ///< along the vertex's normal
  isotropic  ///< in x, y and z independently
};
/// "normal", "isotropic".
std::string_view to_string(NoiseKind kind);

/// A perturbation of a surface, and its amount:
/// - noise: each vertex is moved by Gaussian noise whose standard deviation (isotropic: of each coordinate)
///   is `amount` mean edge lengths, the mean taken over the edges;
/// - decimation: edges are collapsed, the vertices that stay where they were, until the share `amount` of the
///   vertices is left (decimation.h);
/// - subdivision: each edge is cut into `amount` equal pieces; the surface stays the same.
struct Perturbation {
  PerturbationKind kind = PerturbationKind::noise;
  double amount = 0;
  NoiseKind direction = NoiseKind::normal;  ///< of noise

  /// Whether trials differ from each other.
  bool is_random() const { return kind != PerturbationKind::subdivision; }
};
/// "noise 0.05".
std::string to_string(const Perturbation& perturbation);

/// Throws InvalidArgument if the amount is out of range: noise ≥ 0, decimation in (0, 1], subdivision whole
/// and in 1 … 16.
void check(const Perturbation& perturbation);

/// A perturbed surface. `source` has the file's vertex numbers, as far as vertices are the file's.
struct PerturbedMesh {
  core::LoadedMesh loaded;
  std::vector<core::Point> places;  ///< where each vertex lies on the surface that was not perturbed
};

/// The perturbed surface of one trial: it depends on mesh, perturbation, seed and trial alone, and trial t
/// moves each vertex by multiples of the same random numbers at all amounts of noise. O(n), decimation O(n
/// log n). Throws what check() throws.
PerturbedMesh perturb(const core::LoadedMesh& clean, const Perturbation& perturbation, std::uint64_t seed,
                      std::uint64_t trial);

}  // namespace morsel::tools
