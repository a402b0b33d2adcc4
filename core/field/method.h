#pragma once
/// The common interface: Morse functions make a field from a mesh, methods make a field from a field.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"

namespace morsel::core {

struct MeshSource;    // mesh_io.h: the data in the mesh's file besides the mesh
struct VertexValues;  // vertex_values.h: a file of values, or a property of the mesh's file

/// A field and every parameter as resolved on this mesh (such as a σ of 8ε in the mesh's unit).
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

/// Traits of a Morse function.
struct FunctionTraits {
  /// It has values for the vertices of the mesh's file alone: none for vertices that are added to the
  /// surface.
  bool needs_input_vertices = false;
};

/// A Morse function: a way to make a scalar field from a mesh alone (and its file's vertex data). Immutable,
/// may be evaluated from several threads at once.
class MorseFunction {
 public:
  virtual ~MorseFunction() = default;
  virtual FunctionResult evaluate(const TriangleMesh& mesh, const FunctionContext& context) const = 0;
  virtual FunctionTraits traits() const { return {}; }
  /// The values that it takes as they are; null if it computes its own. A mesh can be made without the
  /// vertices where they are nan (BuildOptions::needed).
  virtual const VertexValues* given_values() const { return nullptr; }
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

/// How many iterations a method ran, and what ended them.
struct IterationEnd {
  std::int64_t iterations_run = 0;
  std::string
      stopped_by;  ///< "iterations", the key of another condition, or "caller": MethodContext's callback
};

/// A field, the parameters as resolved on this mesh, and further details of the run
/// ("iterations_run": 7).
struct MethodResult {
  ScalarField field;
  Parameters parameters;
  Parameters details;
  std::vector<IterationRecord> iterations = {};  ///< from the input on, where they were counted
  std::optional<IterationEnd> end = {};          ///< of a method that iterates
  /// The standard deviation of the weight of distances, in the mesh's unit, of a method that averages by one.
  std::optional<double> sigma = {};
  std::vector<std::string> warnings = {};  ///< what the method could not do here, a sentence each
};

/// A callback for the iterations of an iterative method, and the choice of those for which it is called.
class IterationCallback {
 public:
  /// Called with the number of each iteration, 1 to the last, and its field; returning false ends the method
  /// there. A method that iterates on another field than its input reports that one first, as iteration 0. A
  /// method that has to start again starts again at its first number.
  using Call = std::function<bool(int iteration, const ScalarField& field)>;
  using Choice = std::function<bool(int iteration)>;

  /// No callback is set: no iteration is wanted.
  IterationCallback() = default;
  /// Without `wants` all iterations are wanted.
  template <class Callable>
  requires(!std::same_as<Callable, IterationCallback> && std::convertible_to<Callable, Call>)
      IterationCallback(Callable call, Choice wants = {})
      : call_(std::move(call)), wants_(std::move(wants)) {}

  /// Whether this iteration is to be reported; if not, the method need not make its field.
  bool wants(int iteration) const { return call_ && (!wants_ || wants_(iteration)); }
  /// Reports the iteration if it is wanted; returns whether the method is to continue.
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
  /// Evaluates the field's Morse function again on another surface with the same triangles; empty if there is
  /// none.
  std::function<ScalarField(const TriangleMesh&)> morse_function = {};
  Progress progress = {};
  /// Whether an iterative method is to count the critical points of all its iterations.
  bool count_iterations = false;
  IterationCallback on_iteration = {};
};

/// The key of every method that iterates: how many iterations at most. 0 returns the input.
inline constexpr std::string_view kIterationsKey = "iterations";

/// Traits of a method, for composing methods.
struct MethodTraits {
  /// It removes critical points pair by pair: a run that cancels fewer of them is the same method.
  bool cancels_pairs = false;
  /// It evaluates the Morse function again whatever its input: no method can come before it in a chain.
  bool reevaluates_function = false;
  /// It has the key kIterationsKey, and passes the fields of its iterations to MethodContext::on_iteration.
  bool iterates = false;
  /// It iterates, and the field that MethodContext::on_iteration receives for iteration i is, bit for bit,
  /// what this method returns with `iterations=i`: so one run gives the results for all smaller numbers.
  bool iterates_are_results = false;
  /// What its values are ("saliency") if they are not of the input's quantity but a number without a unit;
  /// otherwise empty.
  std::string quantity = {};
  /// It does not return the field of its last iteration but another one, computed during the iterations.
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
