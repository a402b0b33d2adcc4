#pragma once
/// What can be wrong with a set of triangles: found, counted and described.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// The rules of a TriangleMesh that a triangle soup can break.
enum class DefectKind {
  empty,                     ///< no triangle at all, or only ones that repair removes as degenerate
  non_finite_position,       ///< a vertex in use with an infinite or NaN coordinate (elements: vertices)
  index_out_of_range,        ///< a face that names a vertex that does not exist (elements: faces)
  degenerate_face,           ///< a face that names a vertex twice (elements: faces)
  duplicate_face,            ///< a face on the same three vertices as an earlier one (elements: faces)
  unreferenced_vertex,       ///< a vertex that no face uses (elements: vertices)
  non_manifold_edge,         ///< an edge of three or more faces (elements: pairs of vertices)
  inconsistent_orientation,  ///< an edge whose two faces run along it the same way, in a component that can
                             ///< be oriented (elements: pairs of vertices)
  non_orientable,      ///< a component with no consistent orientation, e.g. a Möbius band (elements: faces)
  non_manifold_vertex  ///< a vertex whose faces do not form one fan (elements: vertices)
};

/// One kind of defect: how many there are and the first few of them, smallest numbers first.
struct Defect {
  DefectKind kind;
  std::size_t count = 0;
  /// Vertex or face numbers, two vertices an edge, of at most kDefectExamples elements.
  std::vector<Index> first;
};
inline constexpr std::size_t kDefectExamples = 5;

/// The kind's name as reports write it: "non_manifold_edge".
std::string_view defect_name(DefectKind kind);

/// One clause: "3 non-manifold edges (the first: 4-7, 4-9, 5-9)".
std::string describe(const Defect& defect);

/// What repair does about this kind, as a clause ("splitting non-manifold edges"); empty where it does
/// nothing.
std::string_view repair_of(DefectKind kind);

/// Whether its elements are vertices or pairs of them; otherwise they are faces.
bool names_vertices(DefectKind kind);

/// All defects that keep these triangles from being a TriangleMesh, in the order of DefectKind; empty if
/// there are none. A face with one defect (out of range, degenerate, duplicate: the first that applies) does
/// not count towards others; a vertex that repair would remove, since no other face uses it, may have a
/// non-finite coordinate. If the triangles are parts of larger faces, `faces` has the face of each,
/// ascending, and faces are counted and named by those numbers. Time O(n log n), serial, deterministic.
std::vector<Defect> find_defects(std::span<const Point> positions, std::span<const Triangle> triangles,
                                 std::span<const Index> faces = {});

/// A mesh that is refused, with all its defects. The sentence names each with its first elements, its number
/// and the repair that would help.
class MeshError : public BadInput {
 public:
  /// `subject` begins the sentence. If repair was tried already, the sentence does not advise it.
  explicit MeshError(std::vector<Defect> defects, bool repair_tried = false,
                     std::string_view subject = "the mesh");

  const std::vector<Defect>& defects() const noexcept { return defects_; }
  /// The same error with another subject, such as the name of the mesh's file.
  MeshError about(std::string_view subject) const { return MeshError(defects_, repair_tried_, subject); }

 private:
  std::vector<Defect> defects_;
  bool repair_tried_;
};

}  // namespace morsel::core
