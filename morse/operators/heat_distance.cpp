#include "morsel/morse/operators/heat_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/operators/cholesky.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/intrinsic_triangles.h"

namespace morsel::morse {

/// Each triangle's part of the Laplacian: ½ cot of the angles facing its sides, and its area.
struct HeatElement {
  core::Triangle corner;
  std::array<double, 3> weight;
  double area;
};

namespace {

using core::Index;
using core::TriangleMesh;

/// exp(−500) and the products it is in are far from the end of double precision, 1e-308.
constexpr double kMostDecay = 500;

std::vector<HeatElement> elements_of(const IntrinsicTriangles& triangles) {
  std::vector<HeatElement> elements(triangles.corners.size());
  core::parallel_for_each(elements.size(), [&](std::size_t t) {
    elements[t] = {triangles.corners[t], half_cotangents(triangles.sides[t]),
                   triangle_area(triangles.sides[t])};
  });
  return elements;
}

/// heat_matrix(), with boundary values held at 0 if the boundary is cold.
SparseMatrix heat_matrix_of(const TriangleMesh& mesh, const SparseMatrix& laplacian,
                            std::span<const double> areas, double time, bool boundary_is_cold) {
  SparseMatrix matrix = laplacian;
  const auto is_cold = [&](int v) {
    return boundary_is_cold && mesh.is_boundary_vertex(static_cast<Index>(v));
  };
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (int k = matrix.outerIndexPtr()[column]; k < matrix.outerIndexPtr()[column + 1]; ++k) {
      const int row = matrix.innerIndexPtr()[k];
      const double mass = row == column ? areas[column] : 0;
      const double flow = is_cold(column) || is_cold(row) ? 0 : time * matrix.valuePtr()[k];
      matrix.valuePtr()[k] = mass + flow;
    }
  return matrix;
}

/// Fixes φ at one vertex of each component. As right sides sum to 0 there, φ becomes 0 at it, and nothing
/// else changes.
SparseMatrix poisson_matrix(const TriangleMesh& mesh, const SparseMatrix& laplacian) {
  SparseMatrix matrix = laplacian;
  std::vector<bool> fixed(mesh.component_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (fixed[mesh.component_of_vertex(v)]) continue;
    fixed[mesh.component_of_vertex(v)] = true;
    matrix.coeffRef(v, v) *= 2;
  }
  return matrix;
}

/// The straight distance to the nearest source of the same component, for these vertices (ascending).
void put_at_straight_distance(const TriangleMesh& mesh, std::span<const Index> sources,
                              std::vector<Index> vertices, std::vector<double>& distance) {
  const auto by_component = [&](Index a, Index b) {
    return mesh.component_of_vertex(a) < mesh.component_of_vertex(b);
  };
  std::vector<Index> sorted(sources.begin(), sources.end());
  std::sort(sorted.begin(), sorted.end());
  std::erase_if(vertices, [&](Index v) { return std::binary_search(sorted.begin(), sorted.end(), v); });
  std::stable_sort(sorted.begin(), sorted.end(), by_component);
  std::stable_sort(vertices.begin(), vertices.end(), by_component);
  for (auto first = vertices.begin(); first != vertices.end();) {
    const auto last = std::upper_bound(first, vertices.end(), *first, by_component);
    const auto [begin, end] = std::equal_range(sorted.begin(), sorted.end(), *first, by_component);
    std::vector<core::Point> places;
    for (auto s = begin; s != end; ++s) places.push_back(mesh.position(*s));
    const core::PointSearch search(places);
    for (; first != last; ++first) distance[*first] = search.reach(mesh.position(*first), 1);
  }
}

}  // namespace

struct HeatDistance::Operators {
  TriangleMesh mesh;
  HeatBoundary boundary;
  double unit;
  double time;  // in the mesh's unit
  std::vector<HeatElement> elements;
  std::optional<Cholesky> free, cold;  // heat with Neumann and with Dirichlet conditions
  std::optional<Cholesky> poisson;

  void check(std::span<const Index> sources) const;
  std::vector<double> heat(std::span<const Index> sources) const;
  std::vector<double> divergence(const std::vector<double>& heat) const;
};

/// Throws if a component receives no heat.
void HeatDistance::Operators::check(std::span<const Index> sources) const {
  std::vector<bool> reached(mesh.component_count());
  std::vector<bool> lost(mesh.component_count());
  for (const Index s : sources) {
    const bool is_lost = boundary == HeatBoundary::dirichlet && mesh.is_boundary_vertex(s);
    (is_lost ? lost : reached)[mesh.component_of_vertex(s)] = true;
  }
  const auto missing = std::count(reached.begin(), reached.end(), false);
  if (missing == 0) return;
  if (std::find(lost.begin(), lost.end(), true) != lost.end())
    throw core::BadInput("with boundary=dirichlet a source on the boundary emits no heat, and " +
                         std::to_string(missing) + " of " + std::to_string(mesh.component_count()) +
                         " components have no other source: use boundary=average or boundary=neumann");
  throw core::BadInput("geodesic distance is not defined on " + std::to_string(missing) + " of " +
                       std::to_string(mesh.component_count()) +
                       " components, which have no source: each needs one of its own");
}

std::vector<double> HeatDistance::Operators::heat(std::span<const Index> sources) const {
  std::vector<double> start(mesh.vertex_count(), 0.0);
  for (const Index s : sources) start[s] = 1;
  if (!cold) return free->solve(start);
  std::vector<double> u = free ? free->solve(start) : std::vector<double>(start.size(), 0.0);
  for (const Index s : sources)
    if (mesh.is_boundary_vertex(s)) start[s] = 0;
  const std::vector<double> other = cold->solve(start);
  for (std::size_t v = 0; v < u.size(); ++v) u[v] += other[v];
  return u;
}

/// Σ over v's triangles of area · X·∇(hat function of v). With the triangle's part S of the Laplacian,
/// ∇u·∇hat_i · area is (S u)_i and ‖∇u‖² · area is uᵀ S u.
std::vector<double> HeatDistance::Operators::divergence(const std::vector<double>& heat) const {
  std::vector<double> result(heat.size(), 0.0);
  for (const auto& [corner, weight, area] : elements) {
    std::array<double, 3> u = {heat[corner[0]], heat[corner[1]], heat[corner[2]]};
    const double largest = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
    if (largest == 0) continue;
    std::array<double, 3> flow;  // along the sides
    double energy = 0;
    for (int i = 0; i < 3; ++i) {
      const double difference = (u[i] - u[(i + 1) % 3]) / largest;
      flow[i] = weight[i] * difference;
      energy += flow[i] * difference;
    }
    if (!(energy > 0)) continue;
    const double scale = std::sqrt(area / energy);
    for (int i = 0; i < 3; ++i) {
      result[corner[i]] -= scale * flow[i];
      result[corner[(i + 1) % 3]] += scale * flow[i];
    }
  }
  return result;
}

HeatDistance::HeatDistance(const TriangleMesh& mesh, const HeatOptions& options,
                           const core::Progress& progress) {
  if (!(options.time > 0) || !std::isfinite(options.time))
    throw core::InvalidArgument("the time that heat flows must be positive, not " +
                                core::shortest(options.time));
  const EdgeLengths lengths = edge_lengths(mesh);
  const double reach = options.reach / lengths.unit;
  const double time =
      std::max(options.time * lengths.mean * lengths.mean, reach * reach / (kMostDecay * kMostDecay));
  const IntrinsicTriangles triangles =
      options.delaunay ? delaunay_triangles(mesh, lengths) : mesh_triangles(mesh, lengths);
  auto made = std::make_unique<Operators>(Operators{mesh,
                                                    options.boundary,
                                                    lengths.unit,
                                                    time * lengths.unit * lengths.unit,
                                                    elements_of(triangles),
                                                    {},
                                                    {},
                                                    {}});
  const SparseMatrix matrix = laplacian(triangles, mesh.vertex_count());
  const std::vector<double> areas = barycentric_areas(triangles, mesh.vertex_count());
  const bool bounded = !mesh.is_closed();
  if (!bounded || options.boundary != HeatBoundary::dirichlet)
    made->free.emplace(heat_matrix_of(mesh, matrix, areas, time, false), "heat", progress);
  if (bounded && options.boundary != HeatBoundary::neumann)
    made->cold.emplace(heat_matrix_of(mesh, matrix, areas, time, true), "heat", progress);
  made->poisson.emplace(poisson_matrix(mesh, matrix), "distance", progress);
  operators_ = std::move(made);
}

HeatDistance::~HeatDistance() = default;

double HeatDistance::time() const { return operators_->time; }

std::vector<double> HeatDistance::from(std::span<const Index> sources) const {
  const TriangleMesh& mesh = operators_->mesh;
  operators_->check(sources);
  std::vector<double> phi = operators_->poisson->solve(operators_->divergence(operators_->heat(sources)));
  std::vector<double> offset(mesh.component_count(), 0.0);
  std::vector<double> count(mesh.component_count(), 0.0);
  for (const Index s : sources) {
    offset[mesh.component_of_vertex(s)] += phi[s];
    ++count[mesh.component_of_vertex(s)];
  }
  for (std::size_t c = 0; c < offset.size(); ++c) offset[c] /= count[c];
  std::vector<Index> lost;  // no farther than the sources, as computed
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    phi[v] = (phi[v] - offset[mesh.component_of_vertex(v)]) * operators_->unit;
    if (!(phi[v] > 0)) lost.push_back(v);
  }
  put_at_straight_distance(mesh, sources, std::move(lost), phi);
  for (const Index s : sources) phi[s] = 0;
  return phi;
}

}  // namespace morsel::morse
