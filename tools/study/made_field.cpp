#include "morsel/tools/study/made_field.h"

#include <utility>

namespace morsel::tools {

FieldPlan prepare(const FieldRequest& request, const Registry& registry) {
  check_target(request.target);
  return {registry.make_function(request.field), registry.make_method(request.method), request.target};
}

MadeField make_field(const FieldPlan& plan, const core::LoadedMesh& loaded, const core::Progress& progress) {
  FieldOutcome input = evaluate_field(loaded, plan.function, progress);
  const Stopwatch watch;
  ChainOutcome outcome =
      apply_chain(plan.chain, loaded, plan.function, input.field, {.target = plan.target}, progress);
  return {std::move(input), std::move(outcome), watch.seconds()};
}

}  // namespace morsel::tools
