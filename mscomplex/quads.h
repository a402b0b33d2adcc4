#pragma once
/// Quadrangulation: from the Morse-Smale complex to an all-quad mesh of the surface.

#include <array>
#include <cstddef>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// A cancellation that a layout requires: an extremum with a single arc, and the saddle
/// at the arc's start. Both sides of that arc are in one quad of the complex, which would be folded along it.
struct DanglingRepair {
  NodeKind kind = NodeKind::minimum;  ///< minimum or maximum
  core::Index vertex = core::kNone;   ///< of the extremum
  core::Index saddle_vertex = core::kNone;
  double persistence = 0;  ///< |f(saddle) − f(extremum)|
};

/// A complex none of whose arcs dangles.
struct RepairedComplex {
  MorseSmaleComplex complex;
  std::vector<DanglingRepair> repairs;  ///< in their order
};

/// Cancels each extremum that has a single arc with the saddle there, by reversing the V-path between them
/// (Forman 1998), the ones of least persistence first, until none is left: cancelling one may leave another
/// with one arc. Throws BadInput if no saddle is left in some component: a layout then needs a field with
/// more critical points. O(n) a round.
RepairedComplex repair_dangling(const core::ScalarField& field, MorseSmaleComplex complex,
                                const core::Progress& progress = {});

struct LayoutOptions {
  /// How often all nodes are moved to the middle of the patches around them, and their arcs drawn again. 0
  /// leaves minima and maxima at their critical vertices, and saddles at the midpoints of their critical
  /// edges. Each time edges are split along the new arcs: time and triangles grow by a third or so. At most
  /// as many triangles as there are, or 65,536, are added each time; nodes whose arcs need more are left.
  int relaxation = 2;
};

/// A layout of patches on a surface: the complex with its arcs as curves that meet in nodes alone. Patches
/// have four sides, their arcs; where one arrives at a boundary loop it has five, a piece of the loop between
/// the ends of two arcs.
struct QuadLayout {
  core::TriangleMesh input;  ///< that of the complex
  /// The input with edges split where arcs cross them, and each boundary loop closed by a fan of triangles,
  /// its cap. At boundaries vertices are moved inwards a little to make room for a collar.
  core::TriangleMesh surface;
  /// Per node of the complex: vertex of `surface`. Caps, the last nodes, are in the middles of their fans.
  std::vector<core::Index> node_vertex;
  /// Per arc: vertices of `surface`, neighbours each, from the saddle's to its end's, or to one of the loop.
  std::vector<std::vector<core::Index>> arcs;
  std::vector<Quad> patches;                   ///< the complex's quads
  std::vector<core::Index> patch_of_triangle;  ///< per triangle of `surface`; kNone in fans
  /// Arcs drawn through the fewest triangles, where triangles are too small for a straight line in double
  /// precision.
  core::Index missed = 0;
  /// How often a relaxation left a node where it was, for its arcs would have cut the surface into too many
  /// triangles. It happens where dozens of arcs meet on a few triangles.
  core::Index left = 0;

  core::Index cap_count() const { return input.boundary_loop_count(); }
  bool is_cap(core::Index node) const { return node + cap_count() >= node_vertex.size(); }

  /// Checks everything that a layout must be, for tests: arcs along edges from node to node, disjoint but for
  /// nodes, in the complex's cyclic order; patches that are discs between their four arcs. Throws
  /// std::logic_error.
  void validate(const MorseSmaleComplex& complex) const;
};

/// Embeds the complex as a layout (after Dong, Bremer, Garland, Pascucci, Hart 2006, "Spectral surface
/// quadrangulation").
///
/// Arcs of the discrete complex merge, so they cannot border patches as they are. Here each is drawn as a
/// curve of its own: the region of each maximum, cut along the V-paths that border it, is a disc; laid out
/// in the plane within a circle (Floater 2003, mean-value weights), its ascending arcs are straight rays from
/// the saddles on the circle to the maximum. The region of each minimum between these arcs is a disc too, in
/// which the descending arcs are drawn likewise. Saddles are put at the midpoints of their critical edges, so
/// that those of a multiple saddle are separate. Then each relaxation moves every node, and draws its arcs
/// again, in the disc of the patches around it.
///
/// Boundary loops are nodes above all others, their caps; the arcs to them, and the patches there, end at the
/// loop. No arc of a minimum or maximum may dangle (repair_dangling()) and no
/// component be without a saddle; throws BadInput otherwise, and where arcs that meet in a node cut the
/// surface into 4 million triangles and 16 times its own. A sparse system is solved for each region;
/// parallel in part, the same bits for every number of threads.
QuadLayout embed_layout(const MorseSmaleComplex& complex, const LayoutOptions& options = {},
                        const core::Progress& progress = {});

/// An all-quad mesh.
struct QuadMesh {
  std::vector<core::Point> positions;
  std::vector<std::array<core::Index, 4>> quads;  ///< counter-clockwise seen from outside
  std::vector<core::Index> patch;                 ///< per quad: of the layout
  core::Index resolution = 0;                     ///< quads along a patch's side
};

/// Parametrises each patch over the unit square, its sides by arc length and its inside with mean-value
/// coordinates (Floater 2003), iterated for less stretch (Yoshizawa, Belyaev, Seidel 2004), and samples it
/// on a grid of resolution × resolution quads. A patch with a side on a boundary loop goes over a regular
/// pentagon, which is cut into five at its middle. Samples on arcs and nodes are shared by the patches there,
/// so that the mesh is as watertight as the surface.
///
/// Vertices: nodes but caps first (in the complex's order), then arc by arc from its saddle, then those on
/// loops, then patch by patch; all lie on the input. Quads come patch by patch. Throws InvalidArgument for a
/// resolution below 2 (valence-two nodes would make two quads of the same four corners) or, with boundary
/// loops, one that is odd or below 4, and BadInput where a patch is too thin to be parametrised in double
/// precision. Parallel, the same bits for every number of threads.
QuadMesh sample(const QuadLayout& layout, core::Index resolution, const core::Progress& progress = {});

/// The shapes of the quads of one patch.
struct PatchQuality {
  double area = 0;        ///< of all its quads
  double angle_mean = 0;  ///< of |angle − 90°|
  double scaled_jacobian_min = 0;
};

/// Quality measures of a quad mesh. Angles in degrees, lengths in the mesh's unit.
///
/// A quad is measured along the normal of its two diagonals: its area is half the length of their cross
/// product, an angle of more than 180° is one that points inwards there, and its scaled Jacobian is the least
/// sine of its four angles: 1 for a rectangle, negative if an angle points inwards.
struct QuadQuality {
  std::vector<std::size_t> valence;  ///< number of vertices with so many edges
  std::size_t extraordinary = 0;     ///< vertices of a valence other than 4, 3 on the boundary
  double angle_mean = 0;             ///< of |angle − 90°| over all corners
  double angle_max = 0;
  double scaled_jacobian_mean = 0;
  double scaled_jacobian_min = 0;
  std::size_t concave = 0;    ///< quads of a negative scaled Jacobian
  double area_mean = 0;       ///< of a quad
  double area_deviation = 0;  ///< standard deviation of quad areas, as a share of the mean
  double area_min = 0;        ///< the least and the largest area as a share of the mean
  double area_max = 0;
  double distance_max = 0;   ///< largest distance to the input, from vertices, edge midpoints and centres
  double distance_mean = 0;  ///< over quad centres
  /// Largest distance of an input vertex to the quads, cut into two triangles each.
  double distance_from_input = 0;
  std::vector<PatchQuality> patches;
};

/// Measures `quads` against the surface they were made of. O(n log n), parallel, the same bits for every
/// number of threads.
QuadQuality measure(const QuadMesh& quads, const core::TriangleMesh& input,
                    const core::Progress& progress = {});

/// Checks that it is a manifold with consistently oriented quads, of this Euler characteristic and with so
/// many boundary loops (none: watertight); throws std::logic_error otherwise. O(n log n).
void validate(const QuadMesh& quads, long euler_characteristic, core::Index boundary_loops = 0);

}  // namespace morsel::mscomplex
