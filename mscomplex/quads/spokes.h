#pragma once
/// Drawing the arcs that meet in one node across the disc around it. Internal.

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

#include "morsel/mscomplex/quads/disc.h"

namespace morsel::mscomplex {

/// An arc to draw from a border vertex of a disc to a hub inside.
struct Spoke {
  core::Index at = core::kNone;   ///< border vertex
  core::Index arc = core::kNone;  ///< the label that its edges get
};

/// Draws spokes as straight lines in the plane, splitting the edges that they cross, so that none meets
/// another but in the hub. On which side of a line a vertex lies is decided once for each, ties by a rule,
/// and for a vertex on an earlier spoke by that spoke's start: so a line runs between two sets of
/// vertices and ends, whatever the rounding. Where it misses the hub, because triangles are too
/// small for double precision, the spoke follows the path through the fewest triangles instead, which
/// always exists.
class SpokeDrawer {
 public:
  /// Refers to the mesh.
  explicit SpokeDrawer(LayoutMesh& mesh) : mesh_(mesh) {}

  struct Drawn {
    core::Index hub = core::kNone;  ///< vertex; kNone if the spokes did not fit
    core::Index missed = 0;         ///< spokes whose straight line missed it
  };
  /// Draws all spokes of a disc (`place` is per disc vertex) to `hub`, a vertex inside; if that is kNone, to
  /// a new one, as near to the middle of the unit circle as the triangle there allows. If the mesh had more
  /// than `most_triangles` with them, they do not fit, and the mesh is left as it was. Throws Cancelled.
  Drawn draw(const Disc& disc, const std::vector<Eigen::Vector2d>& place, const std::vector<Spoke>& spokes,
             core::Index hub, std::size_t most_triangles);

 private:
  struct Way {
    bool found = false;
    core::Index first = core::kNone;  ///< half-edge to cross first, or, with no shares, the edge to the hub
    std::vector<double> shares;       ///< where each edge is crossed
    std::vector<bool> keeps_origin;   ///< whether the next edge to cross is at the origin of this one
  };
  void put_hub_into_the_middle(const Disc& disc, const std::vector<Eigen::Vector2d>& place);
  Way straight_way(core::Index start) const;
  Way shortest_way(core::Index start) const;
  void take(const Way& way, core::Index arc);
  void split(core::Index h, double share);
  bool fits(const Way& way, std::size_t most_triangles) const;
  void undo();
  void renumber(core::Index from, core::Index to);
  double offset(core::Index h, const Eigen::Vector2d& from) const;
  bool is_left(core::Index h, const Eigen::Vector2d& from) const;
  core::Index edge_to_hub(core::Index start) const;

  LayoutMesh& mesh_;
  std::vector<Eigen::Vector2d> place_;                     // per half-edge: of its origin
  std::unordered_map<core::Index, std::size_t> spoke_at_;  // by the border half-edge at its start
  std::vector<core::Index> start_;                         // per spoke: that half-edge
  std::vector<core::Index> labelled_;         // edges to a hub that were there, labelled by this draw()
  std::vector<core::Index> split_;            // half-edges split by this draw()
  core::Index split_triangle_ = core::kNone;  // the one that got the new hub
  core::Index hub_ = core::kNone;
  Eigen::Vector2d hub_place_ = Eigen::Vector2d::Zero();
  core::Index first_new_ = 0;                  // vertices from here on are on spokes …
  std::vector<Eigen::Vector2d> start_of_new_;  // … that start here
};

}  // namespace morsel::mscomplex
