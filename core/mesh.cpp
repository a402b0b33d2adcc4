#include "morsel/core/mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh_defects.h"
#include "morsel/core/parallel.h"

namespace morsel::core {

/// Builds the tables step by step; each step returns false where the triangles break a rule, and
/// find_defects() then says which.
class TriangleMesh::Builder {
 public:
  Builder(std::span<const Point> positions, std::vector<Triangle> triangles) : positions_(positions) {
    data_.triangles = std::move(triangles);
  }

  std::shared_ptr<const Connectivity> build() {
    constexpr std::size_t kMost = (kNone - 1) / 3;
    if (data_.triangles.size() > kMost || positions_.size() > kMost)
      throw BadInput("the mesh is too large: " + std::to_string(positions_.size()) + " vertices and " +
                     std::to_string(data_.triangles.size()) + " triangles, of at most " +
                     std::to_string(kMost));
    if (!(check_elements() && link_halfedges() && link_vertices())) {
      std::vector<Defect> defects = find_defects(positions_, data_.triangles);
      if (defects.empty()) throw std::logic_error("TriangleMesh refused triangles that have no defect");
      throw MeshError(std::move(defects));
    }
    find_loops();
    find_components();
    return std::make_shared<const Connectivity>(std::move(data_));
  }

 private:
  Index vertex_count() const { return static_cast<Index>(positions_.size()); }
  Index halfedge_count() const { return static_cast<Index>(3 * data_.triangles.size()); }
  Index origin(Index h) const { return data_.triangles[h / 3][h % 3]; }
  Index target(Index h) const { return origin(next(h)); }
  Index apex(Index h) const { return origin(previous(h)); }

  bool check_elements() const {
    if (data_.triangles.empty()) return false;
    const Index n = vertex_count();
    for (const Triangle& t : data_.triangles) {
      if (t[0] >= n || t[1] >= n || t[2] >= n) return false;
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    }
    return std::all_of(positions_.begin(), positions_.end(), [](const Point& p) { return p.allFinite(); });
  }

  /// Groups the half-edges by their smaller vertex (a counting sort), sorts each group by the larger one, and
  /// joins neighbours: linear but for the sorts of single groups, and edges come out in lexicographic order.
  bool link_halfedges() {
    const Index n = vertex_count();
    const Index m = halfedge_count();
    std::vector<Index> offset(std::size_t{n} + 1, 0);
    for (Index h = 0; h < m; ++h) ++offset[std::min(origin(h), target(h)) + 1];
    for (Index v = 0; v < n; ++v) offset[v + 1] += offset[v];
    struct Entry {
      Index larger;
      Index halfedge;
    };
    std::vector<Entry> entries(m);
    {
      std::vector<Index> cursor(offset.begin(), offset.end() - 1);
      for (Index h = 0; h < m; ++h) {
        const auto [smaller, larger] = std::minmax({origin(h), target(h)});
        entries[cursor[smaller]++] = {larger, h};
      }
    }
    std::vector<Index> edges_before(std::size_t{n} + 1, 0);
    parallel_for_each(n, [&](std::size_t v) {
      std::sort(entries.begin() + offset[v], entries.begin() + offset[v + 1],
                [](const Entry& a, const Entry& b) {
                  return a.larger < b.larger || (a.larger == b.larger && a.halfedge < b.halfedge);
                });
      Index edges = 0;
      for (Index i = offset[v]; i < offset[v + 1]; ++i)
        if (i == offset[v] || entries[i].larger != entries[i - 1].larger) ++edges;
      edges_before[v + 1] = edges;
    });
    for (Index v = 0; v < n; ++v) edges_before[v + 1] += edges_before[v];

    data_.twin.assign(m, kNone);
    data_.halfedge_edge.resize(m);
    data_.edge_halfedge.resize(edges_before[n]);
    return parallel_reduce(
        0, n, kGrain, true,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t v = first; v < last; ++v)
            if (!join_group(std::span(entries).subspan(offset[v], offset[v + 1] - offset[v]),
                            edges_before[v]))
              return false;
          return true;
        },
        [](bool a, bool b) { return a && b; });
  }

  template <class Entry>
  bool join_group(std::span<const Entry> group, Index edge) {
    for (std::size_t i = 0; i < group.size(); ++edge) {
      std::size_t end = i + 1;
      while (end < group.size() && group[end].larger == group[i].larger) ++end;
      const Index a = group[i].halfedge;
      data_.edge_halfedge[edge] = a;
      data_.halfedge_edge[a] = edge;
      if (end - i > 2) return false;
      if (end - i == 2) {
        const Index b = group[i + 1].halfedge;
        if (origin(a) == origin(b) || apex(a) == apex(b)) return false;
        data_.halfedge_edge[b] = edge;
        data_.twin[a] = b;
        data_.twin[b] = a;
      }
      i = end;
    }
    return true;
  }

  template <class Entry>
  bool join_group(std::span<Entry> group, Index edge) {
    return join_group(std::span<const Entry>(group), edge);
  }

  /// Chooses each vertex's first half-edge and checks that its fan reaches all its triangles.
  bool link_vertices() {
    const Index n = vertex_count();
    std::vector<Index> corners(n, 0);
    data_.vertex_halfedge.assign(n, kNone);
    for (Index h = 0; h < halfedge_count(); ++h) {
      const Index v = origin(h);
      ++corners[v];
      Index& start = data_.vertex_halfedge[v];
      if (start == kNone || (data_.twin[h] == kNone && data_.twin[start] != kNone)) start = h;
    }
    return parallel_reduce(
        0, n, kGrain, true,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t v = first; v < last; ++v) {
            if (corners[v] == 0) return false;
            const Index start = data_.vertex_halfedge[v];
            Index h = start;
            Index seen = 0;
            do {
              ++seen;
              h = data_.twin[previous(h)];
            } while (h != kNone && h != start && seen < corners[v]);
            if (seen != corners[v] || (h != kNone && h != start)) return false;
          }
          return true;
        },
        [](bool a, bool b) { return a && b; });
  }

  void find_loops() {
    data_.loop_offset.push_back(0);
    for (Index v = 0; v < vertex_count(); ++v) {
      if (data_.twin[data_.vertex_halfedge[v]] != kNone) continue;
      if (data_.vertex_loop.empty()) data_.vertex_loop.assign(vertex_count(), kNone);
      if (data_.vertex_loop[v] != kNone) continue;
      const auto loop = static_cast<Index>(data_.loop_offset.size() - 1);
      for (Index u = v; data_.vertex_loop[u] == kNone; u = target(data_.loop_halfedge.back())) {
        data_.vertex_loop[u] = loop;
        data_.loop_halfedge.push_back(data_.vertex_halfedge[u]);
      }
      data_.loop_offset.push_back(static_cast<Index>(data_.loop_halfedge.size()));
    }
  }

  void find_components() {
    const Index n = vertex_count();
    std::vector<Index> component(n, kNone);
    std::vector<Index> stack;
    Index count = 0;
    for (Index seed = 0; seed < n; ++seed) {
      if (component[seed] != kNone) continue;
      component[seed] = count;
      stack.push_back(seed);
      while (!stack.empty()) {
        const Index v = stack.back();
        stack.pop_back();
        const auto reach = [&](Index u) {
          if (component[u] == kNone) {
            component[u] = count;
            stack.push_back(u);
          }
        };
        const Index start = data_.vertex_halfedge[v];
        Index h = start;
        do {
          reach(target(h));
          reach(apex(h));
          h = data_.twin[previous(h)];
        } while (h != start && h != kNone);
      }
      ++count;
    }
    data_.component_euler.assign(count, 0);
    data_.component_loops.assign(count, 0);
    for (const Index c : component) ++data_.component_euler[c];
    for (const Index h : data_.edge_halfedge) --data_.component_euler[component[origin(h)]];
    for (const Triangle& t : data_.triangles) ++data_.component_euler[component[t[0]]];
    for (std::size_t k = 0; k + 1 < data_.loop_offset.size(); ++k)
      ++data_.component_loops[component[origin(data_.loop_halfedge[data_.loop_offset[k]])]];
    if (count > 1) data_.vertex_component = std::move(component);
  }

  std::span<const Point> positions_;
  Connectivity data_;
};

TriangleMesh::TriangleMesh(std::vector<Point> positions, std::vector<Triangle> triangles)
    : connectivity_(Builder(positions, std::move(triangles)).build()),
      geometry_(std::make_shared<const Geometry>(std::move(positions))) {}

TriangleMesh::Geometry::Geometry(std::vector<Point> points) : positions(std::move(points)) {
  box = {positions.front(), positions.front()};
  for (const Point& p : positions) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  if (!std::isfinite(box.diagonal()))
    throw BadInput("the mesh is too large in space: the diagonal of its bounding box overflows");
}

void TriangleMesh::neighbors(Index v, std::vector<Index>& ring) const {
  ring.clear();
  Index last = kNone;
  for_each_outgoing(v, [&](Index h) {
    ring.push_back(target(h));
    last = h;
  });
  if (is_boundary_vertex(v)) ring.push_back(apex(last));
}

long TriangleMesh::euler_characteristic() const {
  return static_cast<long>(vertex_count()) - static_cast<long>(edge_count()) +
         static_cast<long>(triangle_count());
}

Index TriangleMesh::genus(Index component) const {
  return static_cast<Index>(
      (2 - connectivity_->component_euler[component] - long{connectivity_->component_loops[component]}) / 2);
}

Index TriangleMesh::genus() const {
  Index sum = 0;
  for (Index c = 0; c < component_count(); ++c) sum += genus(c);
  return sum;
}

TriangleMesh TriangleMesh::with_positions(std::vector<Point> positions) const {
  if (positions.size() != vertex_count())
    throw InvalidArgument("this mesh needs " + std::to_string(vertex_count()) + " positions, not " +
                          std::to_string(positions.size()));
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (!positions[v].allFinite())
      throw BadInput("vertex " + std::to_string(v) + " has a non-finite position");
  return {connectivity_, std::make_shared<const Geometry>(std::move(positions))};
}

}  // namespace morsel::core
