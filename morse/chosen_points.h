#pragma once
/// A wanted number of critical points that stand out and lie apart.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/operators/surface_distance.h"

namespace morsel::morse {

enum class PointKind : std::uint8_t { extrema, maxima, minima, saddles, all };
inline constexpr std::array kPointKinds = {PointKind::extrema, PointKind::maxima, PointKind::minima,
                                           PointKind::saddles, PointKind::all};
enum class PointRank : std::uint8_t {
  persistence,
  salience  ///< persistence times mesh_salience()
};
inline constexpr std::array kPointRanks = {PointRank::persistence, PointRank::salience};

std::string_view to_string(PointKind kind);
std::string_view to_string(PointRank rank);

struct PointCandidate {
  CriticalPoint point;
  double value = 0;
  double persistence = 0;  ///< infinite for essential classes and what is paired with a cap
  double rank = 0;         ///< in the field's unit, above 0
};

/// The critical points of a kind, best first. The rank of a point is its persistence (a multiple saddle's the
/// largest), where that is infinite the extent of the field on its component, times `weight` at its vertex (a
/// factor of at least 0 per vertex; empty: 1). Points of rank 0 are left out: those of persistence 0 exist by
/// the order of equal values only. Of equal rank maxima come first, the highest of them first, then minima,
/// the lowest first, then saddles, the highest first. O(n), and O(s log s) in the number of critical points;
/// parallel, the same result for every number of threads.
std::vector<PointCandidate> point_candidates(const core::ScalarField& field, PointKind kind,
                                             std::span<const double> weight = {},
                                             const core::Progress& progress = {});

struct ChosenPoint {
  PointCandidate candidate;
  std::size_t source = 0;  ///< the list of candidates that it is from
  double distance = 0;     ///< along the surface to the nearest other one; infinite if its component has none
};

struct ChosenPoints {
  std::vector<ChosenPoint> points;    ///< in the order in which they were chosen
  double spacing = 0;                 ///< in the mesh's unit
  std::vector<std::size_t> too_near;  ///< of each list: candidates nearer than that to a point chosen before
};

/// The greedy choice: takes candidates in the order of their list, each that is not nearer than `spacing`
/// along the surface (SurfaceDistances) to a point taken before, until there are `count`. A vertex is taken
/// once. O(m log m) for each point with m vertices within the spacing; serial.
class PointChooser {
 public:
  /// `spacing` is at least 0, in the mesh's unit; throws InvalidArgument otherwise. O(edges), parallel.
  PointChooser(const core::TriangleMesh& mesh, std::size_t count, double spacing);
  PointChooser(const PointChooser&) = delete;
  PointChooser& operator=(const PointChooser&) = delete;

  /// Takes from one more list, of vertices of the mesh, which fills up what those before left.
  void add(std::span<const PointCandidate> candidates, const core::Progress& progress = {});
  std::size_t missing() const { return count_ - chosen_.points.size(); }
  /// With the distances between the points, O(n log n), which are taken now. To be called once.
  ChosenPoints finish();

 private:
  SurfaceDistances distances_;
  SpacedVertices taken_;
  std::size_t count_;
  ChosenPoints chosen_;
};

/// All of that with the lists in their order.
ChosenPoints choose_points(const core::TriangleMesh& mesh,
                           std::span<const std::vector<PointCandidate>> candidates, std::size_t count,
                           double spacing, const core::Progress& progress = {});

/// Mesh saliency as a weight of ranks, at any number of scales.
class MeshSalience {
 public:
  /// Time of saliency(); throws BadInput if its scales are 0 on the mesh.
  explicit MeshSalience(const core::TriangleMesh& mesh, const core::Progress& progress = {});

  /// How salient the surface is around each vertex, 1 on average over its area; no unit: mesh saliency
  /// (saliency.h: Lee, Varshney, Jacobs 2005) of the mean curvature, with neighbours counted by their areas,
  /// averaged by the Gaussian of σ = `scale`, again by areas. All 1 if the saliency is 0 everywhere, or the
  /// surface has no area. Time of gaussian(); throws InvalidArgument if the scale is not above 0 and finite,
  /// BadInput if it is 0 on the mesh.
  std::vector<double> at(core::Length scale, const core::Progress& progress = {}) const;

 private:
  core::ScalarField map_;
};

/// The same at one scale.
std::vector<double> mesh_salience(const core::TriangleMesh& mesh,
                                  core::Length scale = core::Length::epsilons(8),
                                  const core::Progress& progress = {});

}  // namespace morsel::morse
