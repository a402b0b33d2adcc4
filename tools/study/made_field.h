#pragma once
/// One field of one mesh, made from a request: the start of everything that is built on a single field.

#include <cstddef>
#include <optional>
#include <string>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// A field in the syntax of the command line.
struct FieldRequest {
  std::string field = "mean-curvature";
  std::string method = "conventional";  ///< or a chain
  std::optional<std::size_t> target;    ///< critical points that the method is to end with
};

/// A request whose names have been looked up.
struct FieldPlan {
  NamedFunction function;
  MethodChain chain;
  std::optional<std::size_t> target;
};

/// Throws InvalidArgument on unknown names and keys, bad values and a target of 0. Touches no file.
FieldPlan prepare(const FieldRequest& request, const Registry& registry = Registry::standard());

/// The field before the method and after it.
struct MadeField {
  FieldOutcome input;
  ChainOutcome outcome;
  double method_seconds = 0;

  const core::ScalarField& field() const { return outcome.field; }
  PointsField for_points() const { return {input.name, outcome.field, outcome.steps}; }
};

/// Evaluates the function and applies the chain. Throws what functions and methods throw.
MadeField make_field(const FieldPlan& plan, const core::LoadedMesh& loaded,
                     const core::Progress& progress = {});

}  // namespace morsel::tools
