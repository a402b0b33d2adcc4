// The connectivity of a triangle mesh from its triangles.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <stdexcept>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/mesh/mesh_defects.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/partition.h"
#include "morsel/core/parallel/union_find.h"

namespace morsel::core {
namespace {

/// Whether check(first, last) holds for all chunks of 0 … count − 1.
template <class Check>
bool holds(std::size_t count, std::size_t grain, const Check& check) {
  return parallel_reduce(0, count, grain, true, check, [](bool a, bool b) { return a && b; });
}

/// Triangles a chunk of the passes over all of them.
constexpr std::size_t kTriangles = 8 * kGrain;

}  // namespace

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
  bool is_closed() const { return 2 * data_.edge_halfedge.size() == halfedge_count(); }
  Index origin(Index h) const { return data_.triangles[h / 3][h % 3]; }
  Index target(Index h) const { return origin(next(h)); }

  bool check_elements() const {
    if (data_.triangles.empty()) return false;
    const Index n = vertex_count();
    return holds(data_.triangles.size(), kTriangles,
                 [&](std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) {
                     const auto [a, b, c] = data_.triangles[t];
                     if (a >= n || b >= n || c >= n || a == b || b == c || c == a) return false;
                   }
                   return true;
                 }) &&
           holds(positions_.size(), kTriangles, [&](std::size_t first, std::size_t last) {
             for (std::size_t v = first; v < last; ++v)
               if (!positions_[v].allFinite()) return false;
             return true;
           });
  }

  /// A half-edge with its vertices and direction: an edge's half-edges are those with one `start` whose `end`
  /// differs in the last bit at most.
  struct Entry {
    Index start;  ///< the smaller vertex
    Index end;    ///< 2 · larger vertex, and one if it is the origin: a vertex number has 31 bits at most
    Index halfedge;
  };

  /// Brings the half-edges into the lexicographic order of their edges and makes neighbours twins:
  /// distributes them to blocks of consecutive smaller vertices, small enough for a cache, and sorts these.
  bool link_halfedges() {
    const Index n = vertex_count();
    const int shift = std::max(0, static_cast<int>(std::bit_width(n)) - 8);
    const std::size_t blocks = ((n - 1) >> shift) + std::size_t{1};
    Partition<Entry> parts = partition<Entry>(
        data_.triangles.size(), blocks, kTriangles,
        [&](std::size_t first, std::size_t last, const auto& emit) {
          for (std::size_t t = first; t < last; ++t)
            for (std::size_t i = 0; i < 3; ++i) {
              const Index a = data_.triangles[t][i];
              const Index b = data_.triangles[t][i == 2 ? 0 : i + 1];
              emit(std::min(a, b) >> shift, Entry{std::min(a, b), 2 * std::max(a, b) + (a > b ? 1 : 0),
                                                  static_cast<Index>(3 * t + i)});
            }
        });
    const auto block = [&](std::size_t b) {
      return std::span(parts.items).subspan(parts.offset[b], parts.offset[b + 1] - parts.offset[b]);
    };
    data_.twin.resize(halfedge_count());
    data_.halfedge_edge.resize(halfedge_count());
    std::vector<Index> first_edge(blocks + 1, 0);
    const bool valid = holds(blocks, 1, [&](std::size_t b, std::size_t) {
      first_edge[b + 1] = link_block(block(b), static_cast<Index>(b << shift), Index{1} << shift);
      return first_edge[b + 1] != kNone;
    });
    if (!valid) return false;
    for (std::size_t b = 0; b < blocks; ++b) first_edge[b + 1] += first_edge[b];
    data_.edge_halfedge.resize(first_edge[blocks]);
    parallel_for(0, blocks, 1, [&](std::size_t b, std::size_t) {
      const std::span<const Entry> entries = block(b);
      for (Index e = first_edge[b]; e < first_edge[b + 1]; ++e)
        data_.edge_halfedge[e] = entries[e - first_edge[b]].halfedge;
    });
    parallel_for(0, data_.triangles.size(), kTriangles, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        const auto [a, b, c] = data_.triangles[t];
        data_.halfedge_edge[3 * t] += first_edge[std::min(a, b) >> shift];
        data_.halfedge_edge[3 * t + 1] += first_edge[std::min(b, c) >> shift];
        data_.halfedge_edge[3 * t + 2] += first_edge[std::min(c, a) >> shift];
      }
    });
    return true;
  }

  /// Makes the twins among the entries of the smaller vertices first, first + 1, …, numbers their edges from
  /// 0 on, and leaves a half-edge of each at the front. Returns the number of edges, or kNone if one has two
  /// half-edges of a direction.
  Index link_block(std::span<Entry> entries, Index first, Index vertices) {
    const std::vector<Entry> unsorted(entries.begin(), entries.end());
    std::vector<Index> offset(std::size_t{vertices} + 1, 0);
    for (const Entry& entry : unsorted) ++offset[entry.start - first + 1];
    for (Index v = 0; v < vertices; ++v) offset[v + 1] += offset[v];
    for (const Entry& entry : unsorted) entries[offset[entry.start - first]++] = entry;
    Index edges = 0;
    Index begin = 0;
    for (Index v = 0; v < vertices; ++v) {
      const auto group = entries.subspan(begin, offset[v] - begin);  // offset[v] is its end by now
      begin = offset[v];
      sort_group(group);
      for (std::size_t i = 0; i < group.size(); ++edges) {
        const Index end = group[i].end;
        const Index halfedge = group[i].halfedge;
        if (end == kNone) return kNone;
        const auto continues = [&](std::size_t k) { return k < group.size() && (group[k].end ^ end) <= 1; };
        if (continues(i + 1)) {
          const Entry other = group[i + 1];
          if (other.end == end || continues(i + 2)) return kNone;
          set_twins(halfedge, other.halfedge, edges);
          entries[edges].halfedge = std::min(halfedge, other.halfedge);  // read already: edges are fewer
          i += 2;
        } else {
          data_.twin[halfedge] = kNone;
          data_.halfedge_edge[halfedge] = edges;
          entries[edges].halfedge = halfedge;
          i += 1;
        }
      }
    }
    return edges;
  }

  void set_twins(Index a, Index b, Index edge) {
    data_.twin[a] = b;
    data_.twin[b] = a;
    data_.halfedge_edge[a] = edge;
    data_.halfedge_edge[b] = edge;
  }

  /// By `end`.
  static void sort_group(std::span<Entry> group) {
    constexpr std::size_t kFew = 8;
    if (group.size() > kFew) {
      const auto less = [](const Entry& a, const Entry& b) { return a.end < b.end; };
      std::sort(group.begin(), group.end(), interruptible(less));
      return;
    }
    // Most groups have about six entries: the position of each is the number of smaller ones, without a
    // branch to mispredict. Equal ones, which are an error, leave a position free.
    std::array<Entry, kFew> unsorted;
    std::array<Index, kFew> ends;
    ends.fill(kNone);
    for (std::size_t i = 0; i < group.size(); ++i) {
      unsorted[i] = group[i];
      ends[i] = unsorted[i].end;
      group[i].end = kNone;
    }
    for (std::size_t i = 0; i < group.size(); ++i) {
      Index place = 0;
      for (const Index end : ends) place += end < ends[i] ? 1 : 0;
      group[place] = unsorted[i];
    }
  }

  /// Chooses each vertex's first half-edge, and checks that the fans from there reach all corners and that no
  /// two triangles have the same vertices.
  bool link_vertices() {
    const Index n = vertex_count();
    data_.vertex_halfedge.resize(n);
    parallel_for_each(n, [&](std::size_t v) { data_.vertex_halfedge[v] = kNone; });
    const auto lower = [&](Index v, Index h) {  // to the smallest half-edge, in any order of threads
      const std::atomic_ref start(data_.vertex_halfedge[v]);
      Index now = start.load(std::memory_order_relaxed);
      while (h < now && !start.compare_exchange_weak(now, h, std::memory_order_relaxed)) {
      }
    };
    parallel_for(0, data_.triangles.size(), kTriangles, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        for (std::size_t i = 0; i < 3; ++i) lower(data_.triangles[t][i], static_cast<Index>(3 * t + i));
    });
    // At a boundary it is the half-edge there. (A vertex with two of them fails below, whichever it gets.)
    if (!is_closed())
      parallel_for(0, halfedge_count(), 4 * kTriangles, [&](std::size_t first, std::size_t last) {
        for (std::size_t h = first; h < last; ++h)
          if (data_.twin[h] == kNone)
            std::atomic_ref(data_.vertex_halfedge[origin(static_cast<Index>(h))])
                .store(static_cast<Index>(h), std::memory_order_relaxed);
      });
    // next_around() is injective, so that a fan returns to its start or ends at a boundary, and visits no
    // corner twice.
    constexpr std::size_t kBroken = ~std::size_t{0} / 2;
    const std::size_t corners = parallel_reduce(
        0, n, kGrain, std::size_t{0},
        [&](std::size_t first, std::size_t last) {
          std::size_t seen = 0;
          for (std::size_t v = first; v < last; ++v) {
            const Index start = data_.vertex_halfedge[v];
            if (start == kNone) return kBroken;
            const std::size_t before = seen;
            Index h = start;
            do {
              ++seen;
              h = data_.twin[previous(h)];
            } while (h != kNone && h != start);
            if (h == start && seen - before == 2) return kBroken;  // two triangles on the same three vertices
          }
          return seen;
        },
        [&](std::size_t a, std::size_t b) { return std::min(a + b, kBroken); });
    return corners == halfedge_count();
  }

  void find_loops() {
    data_.loop_offset.push_back(0);
    if (is_closed()) return;
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

  /// Components by their smallest vertex. Two edges a triangle join its vertices.
  void find_components() {
    const Index n = vertex_count();
    ConcurrentUnionFind sets(n);
    parallel_for(0, data_.triangles.size(), kTriangles, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        const auto [a, b, c] = data_.triangles[t];
        sets.unite(a, b);
        sets.unite(b, c);
      }
    });
    std::vector<Index> roots = parallel_reduce(
        0, n, kTriangles, std::vector<Index>(),
        [&](std::size_t first, std::size_t last) {
          std::vector<Index> found;
          for (std::size_t v = first; v < last; ++v)
            if (sets.find(static_cast<Index>(v)) == v) found.push_back(static_cast<Index>(v));
          return found;
        },
        [](std::vector<Index> a, const std::vector<Index>& b) {
          a.insert(a.end(), b.begin(), b.end());
          return a;
        });
    const std::size_t loops = data_.loop_offset.size() - 1;
    const auto vertices = static_cast<long>(n);
    const auto edges = static_cast<long>(data_.edge_halfedge.size());
    const auto triangles = static_cast<long>(data_.triangles.size());
    if (roots.size() == 1) {
      data_.component_euler = {vertices - edges + triangles};
      data_.component_loops = {static_cast<Index>(loops)};
      return;
    }
    data_.vertex_component.resize(n);
    parallel_for_each(n, [&](std::size_t v) {
      const Index root = sets.find(static_cast<Index>(v));
      data_.vertex_component[v] =
          static_cast<Index>(std::lower_bound(roots.begin(), roots.end(), root) - roots.begin());
    });
    const FlatArray<Index>& component = data_.vertex_component;
    data_.component_euler.assign(roots.size(), 0);
    data_.component_loops.assign(roots.size(), 0);
    for (const Index c : component) ++data_.component_euler[c];
    for (const Index h : data_.edge_halfedge) --data_.component_euler[component[origin(h)]];
    for (const Triangle& t : data_.triangles) ++data_.component_euler[component[t[0]]];
    for (std::size_t k = 0; k < loops; ++k)
      ++data_.component_loops[component[origin(data_.loop_halfedge[data_.loop_offset[k]])]];
  }

  std::span<const Point> positions_;
  Connectivity data_;
};

std::shared_ptr<const TriangleMesh::Connectivity> TriangleMesh::connect(std::span<const Point> positions,
                                                                        std::vector<Triangle> triangles) {
  return Builder(positions, std::move(triangles)).build();
}

}  // namespace morsel::core
