// morse_smale_complex MESH: the cells of the complex of a smoothed curvature, and the length of its arcs.

#include <cstdio>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/mscomplex/complex.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField field = morse::salient(morse::mean_curvature(mesh), {.iterations = 10}).field;
  const mscomplex::MorseSmaleComplex complex(field);
  std::printf("%u minima, %u saddles, %u maxima, %u caps; %u arcs, %u quads\n", complex.minimum_count(),
              complex.saddle_count(), complex.maximum_count(), complex.cap_count(), complex.arc_count(),
              complex.quad_count());
  double length = 0;
  std::vector<core::Point> points;
  for (core::Index arc = 0; arc < complex.arc_count(); ++arc) {
    complex.trace(arc, points);  // from the saddle downwards or upwards
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  }
  std::printf("all arcs together are %.3g diagonals of the bounding box long\n",
              length / mesh.bounding_box().diagonal());
}
