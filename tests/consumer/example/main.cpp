#include <cstdio>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/persistence/pairing.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField curvature = morse::mean_curvature(mesh);
  const core::ScalarField smoothed = morse::salient(curvature, {.iterations = 10}).field;
  for (const core::ScalarField& field : {curvature, smoothed}) {
    const morse::CriticalPoints points = morse::classify(field);
    const persistence::Diagram diagram = persistence::pair_extrema(field);
    const mscomplex::MorseSmaleComplex complex(field);
    std::printf("%zu critical points, largest finite persistence %.3g, %u arcs\n", points.total(),
                diagram.largest(), complex.arc_count());
  }
}
