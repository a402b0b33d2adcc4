// critical_points MESH: the critical points that salient smoothing leaves of the mean curvature, as CSV.

#include <cstdio>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField field = morse::salient(morse::mean_curvature(mesh), {.iterations = 10}).field;
  std::puts("vertex,type,multiplicity,x,y,z,value");
  for (const morse::CriticalPoint& point : morse::classify(field).points) {
    const core::Point& place = mesh.position(point.vertex);
    std::printf("%u,%s,%u,%g,%g,%g,%g\n", point.vertex, to_string(point.type).data(), point.multiplicity,
                place.x(), place.y(), place.z(), field.value(point.vertex));
  }
}
