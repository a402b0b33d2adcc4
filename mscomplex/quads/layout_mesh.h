#pragma once
/// A closed triangle surface whose edges can be split, and some of whose edges carry labels. Internal.

#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::mscomplex {

/// Half-edges as in core::TriangleMesh: h = 3t + i runs from corner i of triangle t to corner i + 1.
/// Splitting keeps the surface in space as it is. A labelled edge is one that the arcs run along: regions end
/// there. Splitting an edge without a label makes edges without labels; both halves of a labelled edge get
/// its label.
class LayoutMesh {
 public:
  /// Labels on edges: an arc of the complex, or one of these.
  static constexpr core::Index kFree = core::kNone;
  static constexpr core::Index kCut = core::kNone - 1;  ///< on the V-path of some arc, without saying which
  static constexpr core::Index kRim = core::kNone - 2;  ///< where the surface ends and a cap begins

  /// A copy of a closed mesh, without labels.
  explicit LayoutMesh(const core::TriangleMesh& mesh);

  core::Index vertex_count() const { return static_cast<core::Index>(position_.size()); }
  core::Index triangle_count() const { return static_cast<core::Index>(origin_.size() / 3); }
  core::Index halfedge_count() const { return static_cast<core::Index>(origin_.size()); }
  const core::Point& position(core::Index v) const { return position_[v]; }
  const std::vector<core::Point>& positions() const { return position_; }

  static core::Index next(core::Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static core::Index previous(core::Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  core::Index origin(core::Index h) const { return origin_[h]; }
  core::Index target(core::Index h) const { return origin_[next(h)]; }
  core::Index apex(core::Index h) const { return origin_[previous(h)]; }
  core::Index twin(core::Index h) const { return twin_[h]; }
  /// A half-edge that leaves v.
  core::Index leaving(core::Index v) const { return leaving_[v]; }
  /// The next half-edge that leaves the same vertex, counter-clockwise.
  core::Index next_around(core::Index h) const { return twin_[previous(h)]; }

  core::Index label(core::Index h) const { return label_[h]; }
  bool is_free(core::Index h) const { return label_[h] == kFree; }
  void set_label(core::Index h, core::Index label) { label_[h] = label_[twin_[h]] = label; }
  /// The half-edge from one vertex to another; kNone if there is none.
  core::Index leaving_for(core::Index from, core::Index to) const;
  /// The half-edge that leaves v with this label, the first counter-clockwise from leaving(v); kNone if there
  /// is none.
  core::Index leaving_with_label(core::Index v, core::Index label) const;

  /// Splits the edge of h = a → b, with triangles (a, b, c) and (b, a, d), at a + share · (b − a), and
  /// returns the new vertex m. Afterwards h = a → m in (a, m, c), next(h) = m → c, and twin(h) = m → a in (m,
  /// a, d). Half-edges c → a and a → d keep their numbers; b → c and d → b get new ones.
  core::Index split_edge(core::Index h, double share);
  // Right after split_edge(h), across h: d → m, and the far sides a → d and d → b of the triangles there.
  core::Index back_to_split(core::Index h) const { return previous(twin_[h]); }
  core::Index far_side_at_origin(core::Index h) const { return next(twin_[h]); }
  core::Index far_side_at_target(core::Index h) const { return next(twin_[back_to_split(h)]); }

  /// Inserts a vertex into triangle t and joins it to the corners; `weights` are its barycentric coordinates.
  core::Index split_triangle(core::Index t, const std::array<double, 3>& weights);

  /// Takes back the last split of all, split_edge(h). Labels are as before but for that of h's own edge,
  /// which stays as it is; leaving() of the ends may be another half-edge than before.
  void undo_split_edge(core::Index h);
  /// Takes back the last split of all, split_triangle(t); leaving() of the corners may be another than
  /// before.
  void undo_split_triangle(core::Index t);

  /// As an immutable mesh with the same triangles and half-edges.
  core::TriangleMesh mesh() const;

 private:
  void pair(core::Index g, core::Index h) {
    twin_[g] = h;
    twin_[h] = g;
  }
  core::Index add_triangle(core::Index a, core::Index b, core::Index c);
  void remove_last_split();
  /// h leaves v, where the half-edge that did is gone.
  void leave_by(core::Index v, core::Index h);

  std::vector<core::Point> position_;
  std::vector<core::Index> leaving_;  // per vertex
  std::vector<core::Index> origin_;   // per half-edge
  std::vector<core::Index> twin_;     // per half-edge
  std::vector<core::Index> label_;    // per half-edge
};

}  // namespace morsel::mscomplex
