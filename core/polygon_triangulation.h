#pragma once
/// Cutting polygons into triangles. Internal to build_mesh().

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::core {

/// The edges that a mesh has so far, as unordered pairs of different vertices: a hash table.
class EdgeSet {
 public:
  EdgeSet();
  void insert(Index a, Index b);
  bool contains(Index a, Index b) const;

 private:
  std::size_t slot(std::uint64_t key) const;
  std::vector<std::uint64_t> table_;
  std::size_t size_ = 0;
};

/// Cuts one polygon at a time by diagonals, keeping its orientation.
///
/// Polygons need be neither convex nor quite flat: they are seen along the normal of their best plane
/// (Newell's). A quad gets the diagonal whose worse triangle is the better shaped one, the first corner's in
/// a tie; a larger polygon loses the best shaped ear again and again (Meisters 1975), or, above 64 corners,
/// the next ear in turn. An edge that the mesh already has is avoided as a diagonal as long as there is
/// another: two faces on the same four corners, say, would otherwise share it. A polygon whose sides cross,
/// or without an area, is cut in some way that names each corner's vertex.
///
/// Deterministic. O(n) to O(n²) tests a polygon of n corners, more than that only if it is very intricate.
class PolygonTriangulator {
 public:
  /// `edges` holds the sides of all polygons and receives the diagonals; both must outlive this. Work ends
  /// with an error after `most_tests` tests and a thousand for each corner: some seconds.
  PolygonTriangulator(std::span<const Point> positions, EdgeSet& edges,
                      std::uint64_t most_tests = 300'000'000)
      : positions_(positions), edges_(edges), tests_left_(most_tests) {}

  /// Appends the n − 2 triangles of a polygon of n ≥ 3 corners, all vertices of which exist and none of which
  /// follows itself. Throws BadInput (`face` is for the message) where polygons would take minutes.
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
  Ear find_ear(std::span<const Index> polygon, std::size_t start, bool best_of_all);
  bool is_empty(std::size_t a, std::size_t b, std::size_t c);
  bool is_reflex(std::size_t i) const;
  bool is_gone(std::size_t i) const { return previous_[i] == i; }

  std::span<const Point> positions_;
  EdgeSet& edges_;
  std::vector<Point> local_;                  // the polygon's corners, scaled to unit size
  Point normal_ = Point::Zero();              // of its best plane, unit length or zero
  std::vector<std::size_t> previous_, next_;  // the ring of corners not clipped yet
  std::vector<std::size_t> reflex_;           // those that may lie in an ear
  std::size_t face_ = 0;
  std::uint64_t tests_left_;
};

}  // namespace morsel::core
