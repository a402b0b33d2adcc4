#pragma once
/// A surface with its colours, critical points and arcs as one GLB file, for slides, web pages and Blender.

#include <deque>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/tools/color/color.h"
#include "morsel/tools/formats/glb_writer.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// A critical point as it is shown.
struct SceneMark {
  core::Index vertex;  ///< at whose position
  morse::CriticalType type;
};

std::vector<SceneMark> marks_of(const morse::CriticalPoints& points,
                                std::span<const core::Index> places = {});
std::vector<SceneMark> marks_of(const MadePoints& made);

/// The parts "surface", "minima", "saddles", "maxima", "descending arcs" and "ascending arcs", in the colours
/// and sizes of pictures.
class GlbScene {
 public:
  /// Refers to the mesh.
  explicit GlbScene(const core::TriangleMesh& mesh);

  /// With a colour for each vertex.
  void add_surface(std::vector<Color> colors);
  /// With a colour for each triangle, sharp at its edges: vertices between triangles of different labels are
  /// there once for each of these.
  void add_segments(std::span<const core::Index> labels, std::span<const Color> palette);
  /// Spheres, the smaller and the coarser the more there are.
  void add_marks(std::span<const SceneMark> marks);
  /// Tubes; what arcs share is there once. `marks`: as many as there are, on which their radius depends.
  void add_arcs(const mscomplex::MorseSmaleComplex& complex, std::size_t marks);

  /// Throws as write_glb().
  void write(const core::FileTarget& target, const Provenance& provenance,
             core::Sync sync = core::Sync::when_replacing) const;

 private:
  struct Part {
    const char* name;
    std::vector<core::Point> positions;
    std::vector<core::Point> normals;
    std::vector<core::Triangle> triangles;
    std::vector<Color> colors;
    Color color;
  };

  const core::TriangleMesh& mesh_;
  std::vector<core::Point> normals_;
  std::vector<core::Triangle> triangles_;  // counter-clockwise seen from where the normals point
  double diagonal_;
  double area_;  // in squared diagonals
  std::deque<Part> parts_;
};

}  // namespace morsel::tools
