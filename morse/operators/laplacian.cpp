#include "morsel/morse/operators/laplacian.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/edge_lengths.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

/// Of the angle at the apex of half-edge h, which the edge faces; the triangle has an area.
double facing_cotangent(const TriangleMesh& mesh, Index h) {
  const Point& apex = mesh.position(mesh.apex(h));
  const Point a = mesh.position(mesh.origin(h)) - apex;
  const Point b = mesh.position(mesh.target(h)) - apex;
  return a.dot(b) / a.cross(b).norm();
}

/// What the triangle of half-edge h gives to the vertex that h leaves.
double corner_area(const TriangleMesh& mesh, Index h, VertexArea kind) {
  const Point& p = mesh.position(mesh.origin(h));
  const Point a = mesh.position(mesh.target(h)) - p;
  const Point b = mesh.position(mesh.apex(h)) - p;
  const double area = a.cross(b).norm() / 2;
  if (kind == VertexArea::barycentric || area == 0) return area / 3;
  if (a.dot(b) < 0) return area / 2;                          // obtuse here
  if (a.dot(a - b) < 0 || b.dot(b - a) < 0) return area / 4;  // obtuse at another corner
  // Each half of a side belongs to the circumcentre's kite: the cotangent of the angle that faces the side.
  return (b.squaredNorm() * facing_cotangent(mesh, TriangleMesh::previous(h)) +
          a.squaredNorm() * facing_cotangent(mesh, h)) /
         8;
}

}  // namespace

std::string_view to_string(EdgeWeights weights) {
  switch (weights) {
    case EdgeWeights::clamped:
      return "clamped";
    case EdgeWeights::uniform:
      return "uniform";
    case EdgeWeights::cotangent:
      break;
  }
  return "cotangent";
}

EdgeWeights read_edge_weights(core::ParameterReader& reader, EdgeWeights default_weights) {
  const std::string name =
      reader.choice("weights", to_string(default_weights), {"uniform", "cotangent", "clamped"},
                    "edge weights: 1, cotangents, or cotangents of at least " + core::shortest(kLeastWeight));
  for (const EdgeWeights weights : {EdgeWeights::uniform, EdgeWeights::clamped})
    if (name == to_string(weights)) return weights;
  return EdgeWeights::cotangent;
}

std::vector<double> edge_weights(const TriangleMesh& mesh, EdgeWeights weights) {
  if (weights == EdgeWeights::uniform) return std::vector<double>(mesh.edge_count(), 1.0);
  std::vector<double> result = cotangent_weights(mesh, edge_lengths(mesh));
  if (weights == EdgeWeights::clamped)
    for (double& weight : result) weight = std::max(weight, kLeastWeight);
  return result;
}

SparseMatrix laplacian(const TriangleMesh& mesh, std::span<const double> edge_weights) {
  const Index n = mesh.vertex_count();
  SparseMatrix matrix(n, n);
  std::vector<int> start(n + 1, 0);
  for (Index e = 0; e < mesh.edge_count(); ++e)
    for (const Index v : mesh.edge_vertices(e)) ++start[v + 1];
  for (Index v = 0; v < n; ++v) start[v + 1] += start[v] + 1;
  matrix.resizeNonZeros(start[n]);
  std::copy(start.begin(), start.end(), matrix.outerIndexPtr());
  core::parallel_for(0, n, core::kGrain, [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<Index, double>> row;
    for (std::size_t i = first; i < last; ++i) {
      const auto v = static_cast<Index>(i);
      row.clear();
      const auto add = [&](Index h, Index other) { row.emplace_back(other, -edge_weights[mesh.edge(h)]); };
      Index end = core::kNone;
      mesh.for_each_outgoing(v, [&](Index h) {
        add(h, mesh.target(h));
        end = TriangleMesh::previous(h);
      });
      if (mesh.is_boundary_vertex(v)) add(end, mesh.origin(end));
      std::sort(row.begin(), row.end());
      double diagonal = 0;
      for (const auto& [other, weight] : row) diagonal -= weight;
      row.insert(std::lower_bound(row.begin(), row.end(), std::pair<Index, double>(v, -HUGE_VAL)),
                 {v, diagonal});
      for (std::size_t k = 0; k < row.size(); ++k) {
        const std::size_t at = static_cast<std::size_t>(start[v]) + k;
        matrix.innerIndexPtr()[at] = static_cast<int>(row[k].first);
        matrix.valuePtr()[at] = row[k].second;
      }
    }
  });
  return matrix;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh, VertexArea kind) {
  std::vector<double> area(mesh.vertex_count(), 0.0);
  core::parallel_for_each(area.size(), [&](std::size_t v) {
    mesh.for_each_outgoing(static_cast<Index>(v), [&](Index h) { area[v] += corner_area(mesh, h, kind); });
  });
  return area;
}

SparseMatrix heat_matrix(const SparseMatrix& laplacian, std::span<const double> areas, double time) {
  SparseMatrix matrix = time * laplacian;
  for (std::size_t v = 0; v < areas.size(); ++v)
    matrix.coeffRef(static_cast<int>(v), static_cast<int>(v)) += areas[v];
  return matrix;
}

}  // namespace morsel::morse
