// segments MESH OUT.ply: the surface cut into the 30 most persistent bumps of its smoothed curvature, as
// labels.

#include <cstdio>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/segments.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField field = morse::salient(morse::mean_curvature(mesh), {.iterations = 5}).field;
  const mscomplex::PersistenceHierarchy hierarchy(field);
  const mscomplex::Segmenter segmenter(field, hierarchy, mscomplex::SegmentKind::descending);
  const mscomplex::Segments segments = segmenter.segments(segmenter.level_with(30));
  std::printf("%u segments of %u\n", segments.count(), segmenter.count(0));
  core::write_ply(
      arguments[2], mesh,
      std::vector<core::VertexProperty>{{"segment", {segments.vertex.begin(), segments.vertex.end()}}});
}
