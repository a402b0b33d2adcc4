#pragma once
/// The common interface: Morse functions make a field from a mesh, methods make a field from a field.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "morsel/core/parameters.h"
#include "morsel/core/progress.h"
#include "morsel/core/scalar_field.h"

namespace morsel::core {

struct MeshSource;  // mesh_io.h: what the mesh's file said besides the mesh

/// A field and every parameter as it was resolved on this mesh (a σ of 8ε in the mesh's unit, say).
struct FunctionResult {
  ScalarField field;
  Parameters parameters;
};

/// Where a Morse function is evaluated.
struct FunctionContext {
  const MeshSource* source =
      nullptr;  ///< the file's vertex numbers and properties; null for a mesh made in memory
  Progress progress;
};

/// A Morse function: a way to make a scalar field from a mesh alone (and its file's vertex data). Immutable,
/// may be evaluated from several threads at once.
class MorseFunction {
 public:
  virtual ~MorseFunction() = default;
  virtual FunctionResult evaluate(const TriangleMesh& mesh, const FunctionContext& context) const = 0;
};

/// A field, what the parameters came to on this mesh, and what a method has to tell besides
/// ("iterations_run": 7).
struct MethodResult {
  ScalarField field;
  Parameters parameters;
  Parameters details;
};

/// What a method may need besides the field.
struct MethodContext {
  /// Takes the field's Morse function again on another surface with the same triangles; empty if there is
  /// none.
  std::function<ScalarField(const TriangleMesh&)> morse_function;
  Progress progress;
};

/// A method: a function from a scalar field to a scalar field on the same mesh. It never measures, and what
/// measures never knows the method. Immutable, may be applied from several threads at once.
class Method {
 public:
  virtual ~Method() = default;
  virtual MethodResult apply(const ScalarField& input, const MethodContext& context) const = 0;
};

}  // namespace morsel::core
