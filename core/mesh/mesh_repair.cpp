#include "morsel/core/mesh/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "morsel/core/mesh/edge_sides.h"
#include "morsel/core/mesh/nesting.h"
#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/parallel/union_find.h"

namespace morsel::core {
namespace {

Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// Joins the corners of triangles to fans around their vertices, across edges of two faces only: each fan is
/// a path or a cycle then. `origin(h)` is the vertex at corner h; `on_many(h)` is called for edges of more
/// faces.
template <class Origin, class OnMany>
UnionFind joined_fans(Index corner_count, const std::vector<EdgeSide>& sides, const Origin& origin,
                      const OnMany& on_many) {
  UnionFind fans(corner_count);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first > 2) on_many(sides[first].halfedge);
    if (last - first != 2) return;
    const Index a = sides[first].halfedge;
    const Index b = sides[first + 1].halfedge;
    const bool same_way = origin(a) == origin(b);
    fans.unite(a, same_way ? b : next(b));
    fans.unite(next(a), same_way ? next(b) : b);
  });
  return fans;
}

/// Gives each fan but the first of a vertex that `may_split` a new vertex, numbered from `vertex_count` on,
/// and returns of each the vertex that it was split from. `corner(c)` refers to the vertex at corner c. Adds
/// the vertices that were split to `count`.
template <class Corner, class MaySplit>
std::vector<Index> separate_fans(UnionFind& fans, Index corner_count, std::size_t vertex_count,
                                 const Corner& corner, const MaySplit& may_split, std::size_t& count) {
  std::vector<Index> split_from;
  // Roots are the smallest corners of their fans, so they come before the others.
  std::vector<Index> fans_of(vertex_count, 0);
  std::vector<Index> vertex_of_fan(corner_count, kNone);
  for (Index c = 0; c < corner_count; ++c) {
    const Index root = fans.find(c);
    Index& vertex = corner(c);
    if (root == c) {
      vertex_of_fan[c] = vertex;
      const Index fan = may_split(vertex) ? fans_of[vertex]++ : 0;
      if (fan == 1) ++count;
      if (fan > 0) {
        vertex_of_fan[c] = static_cast<Index>(vertex_count + split_from.size());
        split_from.push_back(vertex);
      }
    }
    vertex = vertex_of_fan[root];
  }
  return split_from;
}

/// Counts the faces that triangles belong to, which must come in ascending order.
class FaceCounter {
 public:
  explicit FaceCounter(const TriangleSoup& soup) : soup_(soup) {}
  void add(std::size_t triangle) {
    const Index face = soup_.face(triangle);
    if (count_ == 0 || face != last_) ++count_;
    last_ = face;
  }
  std::size_t count() const { return count_; }

 private:
  const TriangleSoup& soup_;
  Index last_ = kNone;
  std::size_t count_ = 0;
};

class Repairer {
 public:
  Repairer(TriangleSoup& soup, RepairCounts& counts) : soup_(soup), counts_(counts) {}

  VertexNumbering run() {
    const std::size_t input_count = soup_.positions.size();
    remove_degenerate();
    remove_duplicates();
    sort_halfedges();
    if (split()) sort_halfedges();
    orient();
    VertexNumbering numbering = remove_unreferenced();
    numbering.input_count = input_count;
    return numbering;
  }

 private:
  Index origin(Index h) const { return soup_.triangles[h / 3][h % 3]; }

  void remove(const std::vector<bool>& drop, std::size_t& count) {
    FaceCounter faces(soup_);
    std::size_t kept = 0;
    if (soup_.faces.empty()) {  // from here on triangles and faces differ
      soup_.faces.resize(drop.size());
      for (std::size_t t = 0; t < drop.size(); ++t) soup_.faces[t] = static_cast<Index>(t);
    }
    for (std::size_t t = 0; t < drop.size(); ++t)
      if (drop[t]) faces.add(t);
    for (std::size_t t = 0; t < drop.size(); ++t) {
      if (drop[t]) continue;
      soup_.triangles[kept] = soup_.triangles[t];
      soup_.faces[kept++] = soup_.faces[t];
    }
    soup_.triangles.resize(kept);
    soup_.faces.resize(kept);
    count += faces.count();
  }

  void remove_degenerate() {
    std::vector<bool> drop(soup_.triangles.size());
    bool any = false;
    for (std::size_t t = 0; t < drop.size(); ++t) {
      const auto& [a, b, c] = soup_.triangles[t];
      drop[t] = a == b || b == c || c == a;
      any = any || drop[t];
    }
    if (any) remove(drop, counts_.removed_degenerate_faces);
  }

  void remove_duplicates() {
    std::vector<std::pair<Triangle, Index>> sorted;
    sorted.reserve(soup_.triangles.size());
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      sorted.emplace_back(soup_.triangles[t], static_cast<Index>(t));
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end(), interruptible());
    std::vector<bool> drop(soup_.triangles.size(), false);
    bool any = false;
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first) any = drop[sorted[i].second] = true;
    if (any) remove(drop, counts_.removed_duplicate_faces);
  }

  void sort_halfedges() {
    halfedges_.clear();
    halfedges_.reserve(3 * soup_.triangles.size());
    for (Index h = 0; h < 3 * soup_.triangles.size(); ++h)
      halfedges_.push_back(edge_side(origin(h), origin(next(h)), h));
    std::sort(halfedges_.begin(), halfedges_.end(), interruptible());
  }

  /// Gives each fan of faces around a vertex a vertex of its own, so that at most two faces remain at any
  /// edge and one fan at any vertex. Returns whether anything was split.
  bool split() {
    const auto corners = static_cast<Index>(3 * soup_.triangles.size());
    UnionFind fans = joined_fans(
        corners, halfedges_, [&](Index h) { return origin(h); },
        [&](Index) { ++counts_.split_non_manifold_edges; });
    split_from_ = separate_fans(
        fans, corners, soup_.positions.size(),
        [&](Index c) -> Index& { return soup_.triangles[c / 3][c % 3]; }, [](Index) { return true; },
        counts_.split_non_manifold_vertices);
    for (const Index v : split_from_) soup_.positions.push_back(Point(soup_.positions[v]));
    return !split_from_.empty();
  }

  void orient() {
    const auto count = static_cast<Index>(soup_.triangles.size());
    UnionFind components(count);
    ParityUnionFind parity(count);
    std::vector<Index> contradictions;
    std::vector<Index> open;  // faces with a boundary edge
    for_each_edge(halfedges_, [&](std::size_t first, std::size_t last) {
      const Index a = halfedges_[first].halfedge;
      if (last - first == 1) open.push_back(a / 3);
      if (last - first != 2) return;
      const Index b = halfedges_[first + 1].halfedge;
      components.unite(a / 3, b / 3);
      if (!parity.unite(a / 3, b / 3, origin(a) == origin(b))) contradictions.push_back(a / 3);
    });
    struct Component {
      Index same = 0, opposite = 0;  // faces, by parity relative to the first one
      bool is_closed = true;
      bool is_orientable = true;
      double volume = 0, terms = 0;  // as the first face is oriented
      bool is_wall = false;          // of a cavity: lies within an odd number of closed components

      bool to_turn() const { return opposite > 0 && is_orientable; }
      bool outward_known() const { return is_closed && std::abs(volume) > 1e-9 * terms; }
    };
    std::vector<Component> of_root(count);
    for (const Index t : contradictions) of_root[components.find(t)].is_orientable = false;
    for (const Index t : open) of_root[components.find(t)].is_closed = false;
    for (Index t = 0; t < count; ++t) {
      const Index root = components.find(t);
      Component& c = of_root[root];
      const bool odd = parity.find(t).second != parity.find(root).second;
      ++(odd ? c.opposite : c.same);
      const Point& base = soup_.positions[soup_.triangles[root][0]];
      const auto corner = [&](int i) -> Point { return soup_.positions[soup_.triangles[t][i]] - base; };
      const double term = corner(0).dot(corner(1).cross(corner(2)));
      c.volume += odd ? -term : term;
      c.terms += std::abs(term);
    }
    find_walls(components, of_root);
    FaceCounter faces(soup_);
    for (Index t = 0; t < count; ++t) {
      const Index root = components.find(t);
      const Component& c = of_root[root];
      if (!c.to_turn()) continue;
      const bool keep_first = c.outward_known() ? (c.volume > 0) != c.is_wall : c.same >= c.opposite;
      const bool odd = parity.find(t).second != parity.find(root).second;
      if (odd != keep_first) continue;
      std::swap(soup_.triangles[t][1], soup_.triangles[t][2]);
      faces.add(t);
    }
    counts_.reoriented_faces += faces.count();
  }

  /// Marks the components that are to be turned and are walls of cavities.
  template <class Component>
  void find_walls(UnionFind& components, std::vector<Component>& of_root) const {
    std::vector<Index> number(of_root.size(), kNone);
    std::vector<Index> closed;  // their roots
    bool needed = false;
    for (Index root = 0; root < of_root.size(); ++root) {
      const Component& c = of_root[root];
      if (components.find(root) != root || !c.is_closed || !c.is_orientable) continue;
      number[root] = static_cast<Index>(closed.size());
      closed.push_back(root);
      needed |= c.to_turn();
    }
    if (!needed || closed.size() < 2) return;
    std::vector<Index> shell(of_root.size());
    for (Index t = 0; t < shell.size(); ++t) shell[t] = number[components.find(t)];
    const Nesting nesting(soup_.positions, soup_.triangles, shell, static_cast<Index>(closed.size()));
    for (const Index root : closed)
      if (of_root[root].to_turn()) of_root[root].is_wall = nesting.depth(number[root]) % 2 != 0;
  }

  VertexNumbering remove_unreferenced() {
    const std::size_t total = soup_.positions.size();
    const std::size_t input_count = total - split_from_.size();
    std::vector<Index> number(total, kNone);
    for (const Triangle& t : soup_.triangles)
      for (const Index v : t) number[v] = 0;
    VertexNumbering numbering;
    Index kept = 0;
    for (std::size_t v = 0; v < total; ++v) {
      if (number[v] == kNone) continue;
      number[v] = kept;
      soup_.positions[kept++] = soup_.positions[v];
      numbering.to_input.push_back(v < input_count ? static_cast<Index>(v) : split_from_[v - input_count]);
    }
    counts_.removed_unreferenced_vertices += total - kept;
    if (kept == input_count && split_from_.empty()) return {};
    soup_.positions.resize(kept);
    for (Triangle& t : soup_.triangles)
      for (Index& v : t) v = number[v];
    // The fan that kept its vertex's number is the one with the smallest.
    numbering.from_input.assign(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(input_count));
    return numbering;
  }

  TriangleSoup& soup_;
  RepairCounts& counts_;
  std::vector<EdgeSide> halfedges_;
  std::vector<Index> split_from_;  // per vertex that splitting added: the one it was split from
};

}  // namespace

std::vector<Repair> RepairCounts::listed() const {
  std::vector<Repair> result;
  const auto add = [&](const char* action, std::size_t count) {
    if (count > 0) result.push_back({action, count});
  };
  add("left_out_vertices", left_out_vertices);
  add("left_out_faces", left_out_faces);
  add("split_left_out_rims", split_left_out_rims);
  add("welded_vertices", welded_vertices);
  add("removed_collapsed_faces", removed_collapsed_faces);
  add("merged_repeated_corners", merged_repeated_corners);
  add("removed_degenerate_faces", removed_degenerate_faces);
  add("removed_duplicate_faces", removed_duplicate_faces);
  add("split_non_manifold_edges", split_non_manifold_edges);
  add("split_non_manifold_vertices", split_non_manifold_vertices);
  add("reoriented_faces", reoriented_faces);
  add("removed_unreferenced_vertices", removed_unreferenced_vertices);
  return result;
}

VertexNumbering repair_triangles(TriangleSoup& soup, RepairCounts& counts) {
  return Repairer(soup, counts).run();
}

VertexNumbering split_rims(TriangleSoup& soup, std::vector<bool> may_split, RepairCounts& counts) {
  const std::size_t count = soup.positions.size();
  VertexNumbering numbering;
  numbering.input_count = count;
  std::vector<Index>
      triangles;  // at vertices that may be split: corner c of triangle i here is number 3i + c
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& corners = soup.triangles[t];
    if (std::ranges::none_of(corners, [&](Index v) { return may_split[v]; })) continue;
    triangles.push_back(t);
  }
  const auto corner = [&](Index c) -> Index& { return soup.triangles[triangles[c / 3]][c % 3]; };
  const auto corner_count = static_cast<Index>(3 * triangles.size());
  std::vector<EdgeSide> sides;
  for (Index h = 0; h < corner_count; ++h) {
    const Index a = corner(h), b = corner(next(h));
    if (a == b) may_split[a] = false;
    if (may_split[a] || may_split[b]) sides.push_back(edge_side(a, b, h));
  }
  std::sort(sides.begin(), sides.end(), interruptible());
  UnionFind fans = joined_fans(corner_count, sides, corner,
                               [&](Index h) { may_split[corner(h)] = may_split[corner(next(h))] = false; });
  const std::vector<Index> split_from = separate_fans(
      fans, corner_count, count, corner, [&](Index v) { return may_split[v]; }, counts.split_left_out_rims);
  if (split_from.empty()) return numbering;
  numbering.to_input.resize(count);
  std::iota(numbering.to_input.begin(), numbering.to_input.end(), Index{0});
  numbering.from_input = numbering.to_input;
  for (const Index v : split_from) {
    soup.positions.push_back(Point(soup.positions[v]));
    numbering.to_input.push_back(v);
  }
  return numbering;
}

}  // namespace morsel::core
