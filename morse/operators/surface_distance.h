#pragma once
/// Distances along a surface between near vertices.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/operators/shortest_paths.h"

namespace morsel::morse {

/// The length of the shortest path between vertices of those that run along edges and straight across two
/// neighbouring triangles, from the corner of one to that of the other (Dijkstra 1959). Each is a path on the
/// surface, so distances are never shorter than geodesic ones. Where triangles are equilateral they are at
/// most 3.6 % longer (paths along edges alone: 15.5 %); where they are long and thin, more, up to what paths
/// along edges have. Symmetric up to rounding; infinite between components; scales exactly by powers of two.
///
/// Immutable; keeps a number an edge. May be read from any number of threads, each of which needs a Search.
class SurfaceDistances {
 public:
  /// O(edges), parallel.
  explicit SurfaceDistances(const core::TriangleMesh& mesh);

  /// The distance of each of some vertices, all different, to the nearest other one of them; infinite where
  /// its component has no other. O(n log n).
  std::vector<double> to_nearest_other(std::span<const core::Index> vertices) const;

  /// Farthest point sampling (Gonzalez 1985, "Clustering to minimize the maximum intercluster distance"; on
  /// surfaces Moenning, Dodgson 2003): `count` vertices, fewer if the mesh has fewer at different places. The
  /// first is the farthest from `start` on its component, each of the others the farthest from all before it,
  /// first those of components without one; the smallest number where several are as far. O(count n log n)
  /// at worst, serial; each search covers only what comes nearer.
  std::vector<core::Index> farthest_points(core::Index start, std::size_t count) const;

  core::Index vertex_count() const { return mesh_.vertex_count(); }

  struct Reached {
    core::Index vertex;
    double distance;
  };

  /// A search and its buffers, 8 bytes a vertex: make one for many sources. Not thread-safe.
  class Search {
   public:
    explicit Search(const SurfaceDistances& distances);

    /// The vertices nearer to v than `radius`, v first, by ascending distance; valid until the next call.
    /// O(k log k) for k found.
    const std::vector<Reached>& within(core::Index v, double radius);

   private:
    const SurfaceDistances& distances_;
    ShortestPaths paths_;  // no distances between searches
    std::vector<Reached> reached_;
  };

 private:
  /// Calls visit(u, length) for each straight path that leaves v.
  template <class Visit>
  void for_each_path(core::Index v, const Visit& visit) const;

  core::TriangleMesh mesh_;     // of unit size
  int exponent_;                // lengths are divided by 2^exponent
  std::vector<double> across_;  // per edge: from apex to apex; infinite if that does not cross the edge
};

/// Vertices that lie apart along the surface, taken one by one. Not thread-safe.
class SpacedVertices {
 public:
  /// `spacing` is in the mesh's unit, at least 0. Refers to `distances`.
  SpacedVertices(const SurfaceDistances& distances, double spacing)
      : search_(distances), spacing_(spacing), is_near_(distances.vertex_count(), false) {}

  /// Takes v, unless it was taken before or is nearer than the spacing to one that was: then returns false.
  /// O(m log m) for m vertices within the spacing.
  bool take(core::Index v);

 private:
  SurfaceDistances::Search search_;
  double spacing_;
  std::vector<bool> is_near_;  // per vertex: to one that was taken
};

}  // namespace morsel::morse
