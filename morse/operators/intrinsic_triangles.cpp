#include "morsel/morse/operators/intrinsic_triangles.h"

#include <cmath>
#include <utility>

namespace morsel::morse {
namespace {

using core::Index;
using core::kNone;
using core::TriangleMesh;

/// Weights above this count as not negative, so that squares' diagonals stay as they are.
constexpr double kLeast = -1e-9;

/// Half-edge h = 3t + i is side i of triangle t, as in the mesh.
class Flipper {
 public:
  Flipper(const TriangleMesh& mesh, IntrinsicTriangles triangles)
      : twin_(mesh.twins().begin(), mesh.twins().end()),
        triangles_(std::move(triangles)),
        queued_(twin_.size(), true) {
    for (Index h = static_cast<Index>(twin_.size()); h-- > 0;) queue_.push_back(h);
  }

  IntrinsicTriangles run() {
    while (!queue_.empty()) {
      const Index h = queue_.back();
      queue_.pop_back();
      queued_[h] = false;
      if (twin_[h] != kNone && twin_[h] / 3 != h / 3 && weight(h) + weight(twin_[h]) < kLeast) flip(h);
    }
    return std::move(triangles_);
  }

 private:
  double side(Index h) const { return triangles_.sides[h / 3][h % 3]; }
  Index origin(Index h) const { return triangles_.corners[h / 3][h % 3]; }
  double weight(Index h) const { return half_cotangents(triangles_.sides[h / 3])[h % 3]; }

  /// Where the apex of h's triangle lies when h runs from the origin along the x axis.
  std::pair<double, double> apex(Index h) const {
    const double base = side(h);
    const double left = side(TriangleMesh::previous(h));
    const double right = side(TriangleMesh::next(h));
    return {(base + (left - right) * (left + right) / base) / 2,
            2 * triangle_area(triangles_.sides[h / 3]) / base};
  }

  void set(Index h, Index corner, double length, Index twin) {
    triangles_.corners[h / 3][h % 3] = corner;
    triangles_.sides[h / 3][h % 3] = length;
    twin_[h] = twin;
    if (twin != kNone) twin_[twin] = h;
  }

  void push(Index h) {
    if (queued_[h]) return;
    queued_[h] = true;
    queue_.push_back(h);
  }

  /// Triangles (a, b, c) and (b, a, d) beside h from a to b become (a, d, c) and (d, b, c).
  void flip(Index h) {
    const Index g = twin_[h];
    const Index a = origin(h), b = origin(g);
    const Index bc = TriangleMesh::next(h), ca = TriangleMesh::previous(h);
    const Index ad = TriangleMesh::next(g), db = TriangleMesh::previous(g);
    const Index c = origin(ca), d = origin(db);
    const auto [xc, yc] = apex(h);
    const auto [xd, yd] = apex(g);  // seen from b
    const double across = std::hypot(xc - (side(h) - xd), yc + yd);
    const std::array<double, 4> length = {side(ad), side(ca), side(db), side(bc)};
    // A side may be glued to another one of the four: its twin moves too.
    const std::array<Index, 4> old = {ad, ca, db, bc};
    const Index t = 3 * (h / 3);
    const Index s = 3 * (g / 3);
    const std::array<Index, 4> moved = {t, t + 2, s, s + 1};
    std::array<Index, 4> outside;
    for (int i = 0; i < 4; ++i) {
      outside[i] = twin_[old[i]];
      for (int j = 0; j < 4; ++j)
        if (outside[i] == old[j]) {
          outside[i] = moved[j];
          break;
        }
    }
    set(t, a, length[0], outside[0]);
    set(t + 1, d, across, s + 2);
    set(t + 2, c, length[1], outside[1]);
    set(s, d, length[2], outside[2]);
    set(s + 1, b, length[3], outside[3]);
    set(s + 2, c, across, t + 1);
    ++triangles_.flips;
    for (const Index next : moved) push(next);
  }

  std::vector<Index> twin_;
  IntrinsicTriangles triangles_;
  std::vector<bool> queued_;
  std::vector<Index> queue_;
};

}  // namespace

IntrinsicTriangles mesh_triangles(const TriangleMesh& mesh, const EdgeLengths& lengths) {
  IntrinsicTriangles result;
  result.corners.assign(mesh.triangles().begin(), mesh.triangles().end());
  result.sides.reserve(result.corners.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) result.sides.push_back(lengths.sides(mesh, t));
  return result;
}

IntrinsicTriangles delaunay_triangles(const TriangleMesh& mesh, const EdgeLengths& lengths) {
  return Flipper(mesh, mesh_triangles(mesh, lengths)).run();
}

SparseMatrix laplacian(const IntrinsicTriangles& triangles, Index vertices) {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(12 * triangles.corners.size());
  for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
    const std::array<double, 3> weight = half_cotangents(triangles.sides[t]);
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<int>(triangles.corners[t][i]);
      const auto b = static_cast<int>(triangles.corners[t][(i + 1) % 3]);
      entries.emplace_back(a, a, weight[i]);
      entries.emplace_back(b, b, weight[i]);
      entries.emplace_back(a, b, -weight[i]);
      entries.emplace_back(b, a, -weight[i]);
    }
  }
  SparseMatrix matrix(static_cast<int>(vertices), static_cast<int>(vertices));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<double> barycentric_areas(const IntrinsicTriangles& triangles, Index vertices) {
  std::vector<double> areas(vertices, 0.0);
  for (std::size_t t = 0; t < triangles.corners.size(); ++t)
    for (const Index v : triangles.corners[t]) areas[v] += triangle_area(triangles.sides[t]) / 3;
  return areas;
}

}  // namespace morsel::morse
