// comparison MESH: several methods side by side as the program compares them, with a table of one's own.

#include <cstdio>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/study/comparison.h"

using namespace morsel;

/// Prints each method's result when it is ready; none is kept.
class Table : public tools::ComparisonSink {
 public:
  void field(const tools::FieldOutcome& outcome) override {
    std::printf("%s from %g to %g\n", outcome.name.c_str(), outcome.field.min(), outcome.field.max());
  }
  void method(const tools::MethodOutcome& outcome) override {
    std::printf("%-40s %6zu points %6zu pairs %6u arcs\n", outcome.specification.c_str(),
                outcome.measurement.critical_points.total(), outcome.measurement.diagram.finite_count,
                outcome.measurement.complex.arc_count());
  }
};

int main(int, char** arguments) {
  const core::LoadedMesh loaded = core::read_mesh(arguments[1]);
  const tools::ComparisonPlan comparison = tools::prepare(
      {.field = "mean-curvature",
       .methods = {"conventional", "salient", "salient:iterations=5+tps:count=150", "gaussian:sigma=4eps"},
       .target = {}});
  Table table;
  tools::run_comparison(loaded, comparison, {&table});
}
