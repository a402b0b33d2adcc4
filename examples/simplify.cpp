// simplify MESH OUT.ply: the curvature simplified by persistence to 100 critical points, on the surface.

#include <cstdio>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/persistence/cancellation.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField curvature = morse::mean_curvature(mesh);
  const persistence::CancellationResult result =
      persistence::cancel(curvature, {.threshold = {}, .count = 100});
  std::printf("%zu critical points before, %zu after; no value changed by more than %g\n",
              morse::classify(curvature).total(), morse::classify(result.field).total(),
              result.largest_cancelled);
  const auto values = result.field.values();
  core::write_ply(arguments[2], mesh,
                  std::vector<core::VertexProperty>{{"curvature", {values.begin(), values.end()}}});
}
