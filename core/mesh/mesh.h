#pragma once
/// The triangle mesh that everything is computed on.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// A smallest axis-aligned box.
struct BoundingBox {
  Point min = Point::Zero();
  Point max = Point::Zero();
  double diagonal() const { return (max - min).norm(); }
};

/// An orientable triangle surface, closed or bounded, of one or several components: edge- and vertex-manifold
/// (no vertex on two boundary loops), no two faces on the same three vertices, all vertices used,
/// consistently oriented, positions finite. The constructor refuses anything else.
///
/// Immutable; copies share the data and cost nothing, so fields and results keep their mesh by value. All
/// accessors may be called from any number of threads.
///
/// Connectivity is by half-edges: half-edge h = 3t + i runs from corner i of triangle t to corner i + 1 (mod
/// 3). Memory: about 110 bytes a vertex.
class TriangleMesh {
 public:
  /// Checks and builds; O(n) time, parallel. Throws MeshError (all defects, counted) or BadInput if there are
  /// more than about 1.4 billion triangles. The box diagonal may be zero only if all vertices coincide.
  TriangleMesh(std::vector<Point> positions, std::vector<Triangle> triangles);

  Index vertex_count() const { return static_cast<Index>(geometry_->positions.size()); }
  Index edge_count() const { return static_cast<Index>(connectivity_->edge_halfedge.size()); }
  Index triangle_count() const { return static_cast<Index>(connectivity_->triangles.size()); }
  Index halfedge_count() const { return 3 * triangle_count(); }

  std::span<const Point> positions() const { return geometry_->positions; }
  const Point& position(Index v) const { return geometry_->positions[v]; }
  std::span<const Triangle> triangles() const { return connectivity_->triangles; }
  const Triangle& triangle(Index t) const { return connectivity_->triangles[t]; }

  // Half-edges.
  static Index triangle_of(Index h) { return h / 3; }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index origin(Index h) const {
    static_assert(sizeof(Triangle) == 3 * sizeof(Index));  // so corner h % 3 of triangle h / 3 is number h
    return reinterpret_cast<const Index*>(connectivity_->triangles.data())[h];
  }
  Index target(Index h) const { return origin(next(h)); }
  /// The vertex of h's triangle that is not on h.
  Index apex(Index h) const { return origin(previous(h)); }
  /// The same edge seen from the neighbouring triangle; kNone at a boundary.
  Index twin(Index h) const { return connectivity_->twin[h]; }
  std::span<const Index> twins() const { return connectivity_->twin; }

  // Edges, numbered lexicographically by (smaller vertex, larger vertex).
  Index edge(Index h) const { return connectivity_->halfedge_edge[h]; }
  std::span<const Index> halfedge_edges() const { return connectivity_->halfedge_edge; }
  /// A half-edge of edge e: the smaller-numbered one.
  Index edge_halfedge(Index e) const { return connectivity_->edge_halfedge[e]; }
  std::array<Index, 2> edge_vertices(Index e) const {
    const Index h = edge_halfedge(e);
    return {origin(h), target(h)};
  }
  bool is_boundary_edge(Index e) const { return twin(edge_halfedge(e)) == kNone; }

  // Vertices.
  /// A half-edge that leaves v: the boundary one if v is on a boundary, so that turning counter-clockwise
  /// with next_around() from here visits every triangle of v.
  Index vertex_halfedge(Index v) const { return connectivity_->vertex_halfedge[v]; }
  /// The half-edge leaving the same vertex that follows h counter-clockwise; kNone past the last at a
  /// boundary.
  Index next_around(Index h) const { return twin(previous(h)); }
  bool is_boundary_vertex(Index v) const { return twin(vertex_halfedge(v)) == kNone; }
  /// Calls visit(h) for each half-edge leaving v, counter-clockwise from vertex_halfedge(v).
  template <class Visit>
  void for_each_outgoing(Index v, Visit&& visit) const {
    const Index start = vertex_halfedge(v);
    Index h = start;
    do {
      visit(h);
      h = next_around(h);
    } while (h != start && h != kNone);
  }
  /// Replaces `ring` by the neighbours of v, counter-clockwise: a cycle, or from one boundary neighbour to
  /// the other.
  void neighbors(Index v, std::vector<Index>& ring) const;

  // Boundary loops, ordered by their smallest vertex.
  Index boundary_loop_count() const { return static_cast<Index>(connectivity_->loop_offset.size() - 1); }
  /// The half-edges of loop k as the triangles run along them, from the loop's smallest vertex on.
  std::span<const Index> boundary_loop(Index k) const {
    return std::span<const Index>(connectivity_->loop_halfedge)
        .subspan(connectivity_->loop_offset[k],
                 connectivity_->loop_offset[k + 1] - connectivity_->loop_offset[k]);
  }
  /// The loop that v lies on, kNone for an inner vertex.
  Index boundary_loop_of_vertex(Index v) const {
    return connectivity_->vertex_loop.empty() ? kNone : connectivity_->vertex_loop[v];
  }

  // Components, ordered by their smallest vertex.
  Index component_count() const { return static_cast<Index>(connectivity_->component_euler.size()); }
  Index component_of_vertex(Index v) const {
    return connectivity_->vertex_component.empty() ? 0 : connectivity_->vertex_component[v];
  }
  Index component_of_loop(Index k) const { return component_of_vertex(origin(boundary_loop(k).front())); }

  // Topology. χ = vertices − edges + triangles; a component of genus g with b loops has χ = 2 − 2g − b.
  long euler_characteristic() const;
  long euler_characteristic(Index component) const { return connectivity_->component_euler[component]; }
  Index boundary_loop_count(Index component) const { return connectivity_->component_loops[component]; }
  /// Sum over the components.
  Index genus() const;
  Index genus(Index component) const;
  bool is_closed() const { return boundary_loop_count() == 0; }

  const BoundingBox& bounding_box() const { return geometry_->box; }
  /// ε, the paper's unit of length: 0.3 % of the bounding box's diagonal.
  double epsilon() const { return 0.003 * geometry_->box.diagonal(); }

  /// The same triangles with other positions (as many, finite; throws otherwise), sharing the connectivity;
  /// O(n).
  TriangleMesh with_positions(std::vector<Point> positions) const;

  /// Whether both are handles of the same data.
  bool is_same(const TriangleMesh& other) const {
    return connectivity_ == other.connectivity_ && geometry_ == other.geometry_;
  }

  /// Checks every rule and every table by brute force, for tests; throws std::logic_error that names the
  /// first contradiction.
  void validate() const;

 private:
  struct Geometry {
    explicit Geometry(std::vector<Point> points);
    std::vector<Point> positions;
    BoundingBox box;
  };
  struct Connectivity {
    std::vector<Triangle> triangles;
    FlatArray<Index> twin;              // per half-edge
    FlatArray<Index> halfedge_edge;     // per half-edge
    FlatArray<Index> edge_halfedge;     // per edge
    FlatArray<Index> vertex_halfedge;   // per vertex
    std::vector<Index> vertex_loop;     // per vertex; empty if closed
    FlatArray<Index> vertex_component;  // per vertex; empty if connected
    std::vector<Index> loop_offset;     // per loop + 1
    std::vector<Index> loop_halfedge;
    std::vector<long> component_euler;
    std::vector<Index> component_loops;
  };
  class Builder;  // in mesh_connectivity.cpp
  static std::shared_ptr<const Connectivity> connect(std::span<const Point> positions,
                                                     std::vector<Triangle> triangles);
  TriangleMesh(std::shared_ptr<const Connectivity> connectivity, std::shared_ptr<const Geometry> geometry)
      : connectivity_(std::move(connectivity)), geometry_(std::move(geometry)) {}

  std::shared_ptr<const Connectivity> connectivity_;
  std::shared_ptr<const Geometry> geometry_;
};

}  // namespace morsel::core
