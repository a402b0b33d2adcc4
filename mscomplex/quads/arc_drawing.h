#pragma once
/// The complex on a LayoutMesh: the positions of its nodes, and its arcs, drawn node by node. Internal.

#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/quads/capped_surface.h"
#include "morsel/mscomplex/quads/spokes.h"

namespace morsel::mscomplex {

/// Draws the arcs of a complex as disjoint curves. Refers to the complex.
class ArcDrawing {
 public:
  explicit ArcDrawing(const MorseSmaleComplex& complex);
  ArcDrawing(const ArcDrawing&) = delete;
  ArcDrawing& operator=(const ArcDrawing&) = delete;

  /// How many triangles the first drawing may make of a surface of so many: 16 times these, or 4 million.
  static std::size_t most_at_first(std::size_t triangles);
  /// All arcs, nodes at their critical cells. Throws BadInput where they would cut the surface into more
  /// triangles than `most`.
  void draw_first(std::size_t most);
  /// Moves every node into the middle of the disc of the patches around it: maxima, minima, then saddles.
  /// Leaves those whose arcs would be drawn with too many triangles; so each call at most doubles these, or
  /// adds 65,536.
  void relax(const core::Progress& progress);

  /// The capped surface.
  const LayoutMesh& mesh() const { return mesh_; }
  const std::vector<core::Index>& node_vertex() const { return node_vertex_; }
  core::Index missed() const { return missed_; }
  /// How often a node was left where it was.
  core::Index left() const { return left_; }

  /// The half-edge with which an arc leaves its saddle, and the vertices of a drawn arc from there on: to its
  /// end, or to the rim of the cap that it ends in.
  core::Index start_of(core::Index arc) const;
  void follow(core::Index arc, std::vector<core::Index>& vertices) const;

 private:
  struct Erased {
    core::Index halfedge, arc;
  };
  struct Star {
    core::Index node = core::kNone;
    Disc disc;
    std::vector<Spoke> spokes;
    std::vector<Eigen::Vector2d> place;
    std::vector<Erased> erased;  // what its node's arcs were before
  };
  ArcDrawing(const MorseSmaleComplex& complex, const CappedSurface& capped);
  void put_saddles_on_edges();
  void mark_rims();
  void cut_along_descents();
  core::Index node_at(core::Index v) const { return v < node_at_.size() ? node_at_[v] : core::kNone; }
  bool is_on_rim(core::Index v) const { return v < on_rim_.size() && on_rim_[v]; }
  core::Index next_of_arc(core::Index h) const;
  void erase(core::Index arc, std::vector<Erased>& erased);
  std::string name(core::Index node) const;

  Star find_star(core::Index extremum, core::Index some_border);
  std::vector<Star> find_stars(const std::vector<core::Index>& extrema);
  void embed_all(std::vector<Star>& stars) const;
  void draw_stars(const std::vector<core::Index>& extrema);
  void redraw(core::Index extremum_begin, core::Index extremum_end);
  void redraw_saddle(core::Index saddle);
  void embed(Star& star) const;
  void draw(const Star& star);
  void draw_again(const Star& star);

  const MorseSmaleComplex& complex_;
  LayoutMesh mesh_;
  DiscFinder finder_;
  SpokeDrawer drawer_;
  std::vector<core::Index> node_vertex_;  // per node
  std::vector<core::Index> node_at_;      // per vertex, up to the last one with a node
  std::vector<bool> on_rim_;              // per vertex, up to the last one on a rim
  std::size_t most_triangles_ = 0;        // that the surface may be cut into, at present
  core::Index missed_ = 0;
  core::Index left_ = 0;
};

}  // namespace morsel::mscomplex
