#pragma once
/// The common interface: Morse functions make a field from a mesh, methods make a field from a field.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"

namespace morsel::core {

struct MeshSource;  // mesh_io.h: what the mesh's file said besides the mesh

/// A field and every parameter as it was resolved on this mesh (a σ of 8ε in the mesh's unit, say).
struct FunctionResult {
  ScalarField field;
  Parameters parameters;
  std::vector<std::string> warnings = {};  ///< what the values do not mean on this mesh, a sentence each
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

/// The critical points of one of the fields that an iterative method passes through (the field's `total` is
/// minima + saddles + maxima), and how far it is from the one before.
struct IterationRecord {
  std::int64_t iteration = 0;  ///< 0 is the input
  std::size_t minima = 0;
  std::size_t saddles = 0;
  std::size_t saddle_multiplicity = 0;
  std::size_t maxima = 0;
  double change = 0;  ///< the largest change of a value by this iteration, in the field's unit

  std::size_t total() const { return minima + saddles + maxima; }
  friend bool operator==(const IterationRecord&, const IterationRecord&) = default;
};

/// A field, what the parameters came to on this mesh, and what a method has to tell besides
/// ("iterations_run": 7).
struct MethodResult {
  ScalarField field;
  Parameters parameters;
  Parameters details;
  std::vector<IterationRecord> iterations = {};  ///< from the input on, where they were counted
  std::vector<std::string> warnings = {};        ///< what the method could not do here, a sentence each
};

/// Whom an iterative method tells of its iterations, and of which ones.
class IterationCallback {
 public:
  /// Told the number of each iteration, 1 to the last, and the field that it made; false ends the method
  /// there. One that iterates on another field than it was given tells that first, as 0. A method that has to
  /// begin again begins again with its first number.
  using Call = std::function<bool(int iteration, const ScalarField& field)>;
  using Choice = std::function<bool(int iteration)>;

  /// No callback is set: no iteration is wanted.
  IterationCallback() = default;
  /// Without `wants` all iterations are wanted.
  template <class Told>
  requires(!std::same_as<Told, IterationCallback> && std::convertible_to<Told, Call>)
      IterationCallback(Told call, Choice wants = {})
      : call_(std::move(call)), wants_(std::move(wants)) {}

  /// Whether this iteration is to be told; of one that is not a method need not make a field.
  bool wants(int iteration) const { return call_ && (!wants_ || wants_(iteration)); }
  /// Tells the iteration if it is wanted; whether the method is to go on.
  bool operator()(int iteration, const ScalarField& field) const {
    return !wants(iteration) || call_(iteration, field);
  }
  explicit operator bool() const { return static_cast<bool>(call_); }

 private:
  Call call_;
  Choice wants_;
};

/// What a method may need besides the field.
struct MethodContext {
  /// Takes the field's Morse function again on another surface with the same triangles; empty if there is
  /// none.
  std::function<ScalarField(const TriangleMesh&)> morse_function = {};
  Progress progress = {};
  /// Whether an iterative method is to count the critical points of all its iterations.
  bool count_iterations = false;
  IterationCallback on_iteration = {};
};

/// What is peculiar about a method, for whoever composes methods.
struct MethodTraits {
  /// It takes critical points away pair by pair: what cancels fewer of them is this method as well.
  bool cancels_pairs = false;
  /// It takes the Morse function again whatever field it is given: nothing can come before it.
  bool retakes_field = false;
  /// The field that MethodContext::on_iteration is told after i iterations is, bit for bit, what this method
  /// with `iterations=i` returns: then one run gives the results of all smaller numbers.
  bool tells_results = false;
  /// What it returns is not the field of its last iteration but something else that was made on the way.
  bool returns_other = false;
};

/// A method: a function from a scalar field to a scalar field on the same mesh. It never measures, and what
/// measures never knows the method. Immutable, may be applied from several threads at once.
class Method {
 public:
  virtual ~Method() = default;
  virtual MethodResult apply(const ScalarField& input, const MethodContext& context) const = 0;
  virtual MethodTraits traits() const { return {}; }
};

}  // namespace morsel::core
