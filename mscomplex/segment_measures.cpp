#include "morsel/mscomplex/segment_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/partition.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::TriangleMesh;

namespace {

double length(const TriangleMesh& mesh, Index edge) {
  const auto [a, b] = mesh.edge_vertices(edge);
  return (mesh.position(a) - mesh.position(b)).norm();
}

void add_triangles(const TriangleMesh& mesh, Segments& result) {
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& [a, b, c] = mesh.triangle(t);
    const core::Point& origin = mesh.position(a);
    Segment& segment = result.segments[result.triangle[t]];
    ++segment.triangles;
    segment.area += 0.5 * (mesh.position(b) - origin).cross(mesh.position(c) - origin).norm();
  }
}

void add_vertices_and_mesh_boundary(const TriangleMesh& mesh, Segments& result) {
  for (const Index s : result.vertex) ++result.segments[s].vertices;
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    for (const Index h : mesh.boundary_loop(k))
      result.segments[result.triangle[TriangleMesh::triangle_of(h)]].mesh_boundary_length +=
          length(mesh, mesh.edge(h));
}

/// The edges between segments, by segment, each as (neighbour, edge) in one number.
struct Borders {
  std::vector<std::size_t> offset;
  std::vector<std::uint64_t> edge;
};

Borders borders(const TriangleMesh& mesh, const Segments& segments) {
  const auto sides = [&](Index e) {
    const Index h = mesh.edge_halfedge(e);
    const Index across = mesh.twin(h);
    const Index here = segments.triangle[TriangleMesh::triangle_of(h)];
    return std::array{here, across == kNone ? here : segments.triangle[TriangleMesh::triangle_of(across)]};
  };
  const auto between = core::partition<Index>(mesh.edge_count(), 1, 16384,
                                              [&](std::size_t first, std::size_t last, auto&& emit) {
                                                for (auto e = static_cast<Index>(first); e < last; ++e)
                                                  if (const auto [a, b] = sides(e); a != b) emit(0, e);
                                              });
  Borders result;
  result.offset.assign(segments.segments.size() + 1, 0);
  for (const Index e : between.items)
    for (const Index s : sides(e)) ++result.offset[s + 1];
  for (std::size_t s = 0; s < segments.segments.size(); ++s) result.offset[s + 1] += result.offset[s];
  result.edge.resize(result.offset.back());
  std::vector<std::size_t> place(result.offset.begin(), result.offset.end() - 1);
  for (const Index e : between.items) {
    const auto [a, b] = sides(e);
    result.edge[place[a]++] = std::uint64_t{b} << 32 | e;
    result.edge[place[b]++] = std::uint64_t{a} << 32 | e;
  }
  return result;
}

void add_neighbours(const TriangleMesh& mesh, Segments& result) {
  constexpr std::size_t kSegments = 256;  // at a time
  Borders border = borders(mesh, result);
  const std::size_t count = result.segments.size();
  result.neighbour_offset.assign(count + 1, 0);
  const auto neighbour_of = [](std::uint64_t entry) { return static_cast<Index>(entry >> 32); };
  core::parallel_for(0, count, kSegments, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const auto begin = border.edge.begin() + static_cast<std::ptrdiff_t>(border.offset[s]);
      const auto end = border.edge.begin() + static_cast<std::ptrdiff_t>(border.offset[s + 1]);
      std::sort(begin, end);
      Index neighbours = 0;
      for (auto i = begin; i != end; ++i)
        neighbours += i == begin || neighbour_of(*i) != neighbour_of(*(i - 1)) ? 1 : 0;
      result.neighbour_offset[s + 1] = neighbours;
    }
  });
  for (std::size_t s = 0; s < count; ++s) result.neighbour_offset[s + 1] += result.neighbour_offset[s];
  result.neighbour.resize(result.neighbour_offset.back());
  core::parallel_for(0, count, kSegments, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      std::size_t place = result.neighbour_offset[s];
      Segment& segment = result.segments[s];
      segment.boundary_length = segment.mesh_boundary_length;
      for (std::size_t i = border.offset[s]; i < border.offset[s + 1];) {
        SegmentNeighbour& neighbour = result.neighbour[place++];
        neighbour.segment = neighbour_of(border.edge[i]);
        for (; i < border.offset[s + 1] && neighbour_of(border.edge[i]) == neighbour.segment; ++i) {
          ++neighbour.edges;
          neighbour.length += length(mesh, static_cast<Index>(border.edge[i]));  // by edge, from either side
        }
        segment.boundary_length += neighbour.length;
      }
    }
  });
}

}  // namespace

void measure_segments(const TriangleMesh& mesh, Segments& result) {
  // Sums over triangles run in their order, for the same bits at any number of threads: one thread
  // each.
  const std::array<std::function<void()>, 2> sums = {[&] { add_triangles(mesh, result); },
                                                     [&] { add_vertices_and_mesh_boundary(mesh, result); }};
  core::parallel_for(0, sums.size(), 1, [&](std::size_t i, std::size_t) { sums[i](); });
  add_neighbours(mesh, result);
}

}  // namespace morsel::mscomplex
