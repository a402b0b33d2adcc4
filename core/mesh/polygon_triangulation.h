#pragma once
/// Cutting polygons into triangles. Internal to build_mesh().

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/parallel/hash_index.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// The edges that a mesh has so far, as unordered pairs of different vertices: a hash table.
class EdgeSet {
 public:
  void insert(Index a, Index b) { edges_.insert(key_of(a, b)); }
  bool contains(Index a, Index b) const { return edges_.find(key_of(a, b)) != Keys::kFree; }

 private:
  struct Keys {
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};
    static std::size_t hash(std::uint64_t key) { return key * 0x9E37'79B9'7F4A'7C15u >> 20; }
    static std::uint64_t key(std::uint64_t entry) { return entry; }
    static bool equal(std::uint64_t a, std::uint64_t b) { return a == b; }
    static bool less(std::uint64_t a, std::uint64_t b) { return a < b; }
  };
  static std::uint64_t key_of(Index a, Index b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::uint64_t{std::max(a, b)};
  }
  HashIndex<std::uint64_t, Keys> edges_;
};

/// Cuts one polygon at a time by diagonals, keeping its orientation.
///
/// Polygons need be neither convex nor quite flat: they are projected along the normal of their best plane
/// (Newell's). A quad gets the diagonal whose worse triangle is the better shaped one, the first corner's in
/// a tie; larger polygons are triangulated by ear clipping (Meisters 1975), the best shaped ear first or,
/// above 64 corners, the next ear in turn (large_polygon.h). An edge that the mesh already has is avoided as
/// a diagonal as long as there is another: two faces on the same four corners, say, would otherwise share it.
/// A polygon with crossing sides or without area is cut in some way that uses each corner.
///
/// Deterministic. Usually O(n log n) tests for a polygon of n corners, and O(n^1.5) for an adversarial one.
class PolygonTriangulator {
 public:
  /// The largest number of tests for all polygons of more than 64 corners together, `tests` and more for each
  /// corner. The default takes some seconds.
  struct Limits {
    std::uint64_t tests = 300'000'000;
    std::uint64_t tests_per_corner = 200;
  };

  /// `edges` holds the sides of all polygons and receives the diagonals; all but the limits must outlive
  /// this.
  PolygonTriangulator(std::span<const Point> positions, EdgeSet& edges, const Progress& progress)
      : PolygonTriangulator(positions, edges, progress, Limits()) {}
  PolygonTriangulator(std::span<const Point> positions, EdgeSet& edges, const Progress& progress,
                      Limits limits)
      : positions_(positions),
        edges_(edges),
        progress_(progress),
        tests_left_(limits.tests),
        tests_per_corner_(limits.tests_per_corner) {}

  /// Appends the n − 2 triangles of a polygon of n ≥ 3 corners, whose vertices exist and differ between
  /// consecutive corners. Throws BadInput (`face` is for the message) where the limits are exceeded,
  /// Cancelled if a stop was requested.
  void triangulate(std::span<const Index> polygon, std::size_t face, std::vector<Triangle>& triangles);

 private:
  /// A corner that might be clipped; the higher its rank, the better.
  struct Ear {
    enum Rank { none, degenerate, taken, crossing, proper };
    std::size_t corner = 0;
    Rank rank = none;
    double shape = 0;
  };

  void place(std::span<const Index> polygon);
  double shape(std::size_t a, std::size_t b, std::size_t c) const;
  void cut_quad(std::span<const Index> polygon, std::vector<Triangle>& triangles);
  void clip_ears(std::span<const Index> polygon, std::vector<Triangle>& triangles);
  Ear best_ear(std::span<const Index> polygon, std::size_t start) const;
  bool is_empty(std::size_t a, std::size_t b, std::size_t c) const;
  bool is_reflex(std::size_t i) const;
  bool is_gone(std::size_t i) const { return previous_[i] == i; }

  std::span<const Point> positions_;
  EdgeSet& edges_;
  const Progress& progress_;
  std::vector<Point> local_;                  // the polygon's corners, scaled to unit size
  Point normal_ = Point::Zero();              // of its best plane, unit length or zero
  std::vector<std::size_t> previous_, next_;  // the ring of corners not clipped yet
  std::vector<std::size_t> reflex_;           // those that may lie in an ear
  std::uint64_t tests_left_;
  std::uint64_t tests_per_corner_;
};

}  // namespace morsel::core
