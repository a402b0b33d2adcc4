#include "morsel/morse/smoothing/salient_iterations.h"

namespace morsel::morse {

SalientResult run_salient(const core::ScalarField& input, SalientOptions options,
                          const StopCriteria& criteria, IterationControl& control,
                          const core::Progress& progress) {
  options.iterations = control.more() ? criteria.iterations : 0;
  options.on_iteration = [&](const SalientIteration& iteration) {
    if (iteration.number <= control.iterations_run()) control.restart();
    if (!control.needs_field()) {
      control.skip();
      return true;
    }
    control.record({iteration.values.begin(), iteration.values.end()});
    return control.more();
  };
  return salient(input, options, progress);
}

}  // namespace morsel::morse
