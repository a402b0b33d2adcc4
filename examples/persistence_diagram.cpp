// persistence_diagram MESH: how many extremum-saddle pairs of the height stand out, and the ten that do most.

#include <algorithm>
#include <cstdio>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/functions/height.h"
#include "morsel/persistence/pairing.h"

using namespace morsel;

int main(int, char** arguments) {
  const core::TriangleMesh mesh = core::read_mesh(arguments[1]).mesh;
  const core::ScalarField height = morse::height(mesh);
  const persistence::Diagram diagram = persistence::pair_extrema(height);
  for (const double percent : {0.1, 1.0, 5.0})
    std::printf("%zu of %zu pairs exceed %g %% of the range\n",
                diagram.count_above(percent / 100 * height.extent()), diagram.finite_count, percent);
  const auto pairs = diagram.finite_pairs();  // by increasing persistence
  for (std::size_t i = pairs.size(); i > pairs.size() - std::min<std::size_t>(10, pairs.size()); --i)
    std::printf("%s %u, saddle %u: %g\n",
                pairs[i - 1].kind == persistence::PairKind::minimum_saddle ? "minimum" : "maximum",
                pairs[i - 1].extremum, pairs[i - 1].saddle, pairs[i - 1].persistence());
}
