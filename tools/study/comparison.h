#pragma once
/// Comparison of several methods on one field of one mesh, each measured by the same code.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/text/specification.h"
#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/persistence/pairing.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/field_outcome.h"
#include "morsel/tools/study/made_points.h"
#include "morsel/tools/study/matching.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/stopwatch.h"

namespace morsel::tools {

/// A comparison in the syntax of the command line.
struct ComparisonRequest {
  std::string field = "mean-curvature";
  /// A row of the comparison each. `tps:count=NAME` takes the number of critical points of an earlier row, by
  /// what it is as a whole or by its methods' names: by default persistence simplification is held to the
  /// number that salient smoothing leaves.
  std::vector<std::string> methods = {"conventional", "salient", "tps:count=salient"};
  std::optional<std::size_t> target;         ///< every method is to end with so many critical points
  bool snap = false;                         ///< critical points are reported at their origins
  std::optional<PointsRequest> points = {};  ///< of every row points are chosen
};

/// Everything that is measured on one field. It never knows which method made the field.
struct Measurement {
  morse::CriticalPoints critical_points;
  persistence::Diagram diagram;
  mscomplex::MorseSmaleComplex complex;
  mscomplex::Segmentation segmentation;
  core::Index cells = 0;  ///< quads of the complex that have area
};

/// The points that were chosen of a method's field.
struct ChosenOutcome {
  MadePoints made;
  morse::CriticalPoints points;     ///< the same, ascending by vertex
  std::vector<core::Index> places;  ///< of `points`: as MethodOutcome's
  Matching compared_to_first;       ///< with the points chosen of the first method's field
};

/// A method's field and its measurement.
struct MethodOutcome {
  std::string specification;  ///< as given
  std::string name;
  std::vector<StepOutcome> steps;
  core::ScalarField field;
  double input_extent = 0;  ///< of the field before any method: what shares of the extent are of
  std::optional<TargetOutcome> target;
  Measurement measurement;
  /// For each critical point, the vertex of the one of the input field that it came from; kNone if it has no
  /// origin.
  std::vector<core::Index> origins;
  /// For each critical point, the vertex at whose position it is reported: its own, or its origin's if
  /// `snap` is set.
  std::vector<core::Index> places;
  Matching compared_to_first;
  Timings timings;
  std::string quantity = {};                 ///< MethodChain::quantity()
  std::optional<ChosenOutcome> chosen = {};  ///< if points were asked for

  /// What tables and pictures show: the chosen points where there are such, else all critical points; and the
  /// vertices at whose positions they are.
  const morse::CriticalPoints& shown_points() const {
    return chosen ? chosen->points : measurement.critical_points;
  }
  const std::vector<core::Index>& shown_places() const { return chosen ? chosen->places : places; }
  const Matching& shown_matching() const { return chosen ? chosen->compared_to_first : compared_to_first; }
};

/// Critical points, diagram, complex and segments of one field; each step's seconds are appended to
/// `timings`.
Measurement measure(const core::ScalarField& field, Timings& timings, const core::Progress& progress = {});

/// Receives the parts of a comparison as they are made, so that no more than one method's results need be in
/// memory.
class ComparisonSink {
 public:
  virtual ~ComparisonSink() = default;
  virtual void begin_method(const std::string& name) { static_cast<void>(name); }
  virtual void field(const FieldOutcome& outcome) = 0;
  virtual void method(const MethodOutcome& outcome) = 0;
  /// What run_comparison() calls: for sinks that keep outcomes without copying them.
  virtual void keep_field(const std::shared_ptr<const FieldOutcome>& outcome) { field(*outcome); }
  virtual void keep_method(const std::shared_ptr<const MethodOutcome>& outcome) { method(*outcome); }
};

/// A `count` of a step that is the number of critical points of an earlier row.
struct RowCount {
  std::size_t step = 0;
  std::size_t row = 0;
};

/// The row that `count` of a method's step is of; none if it is a number, or not given.
std::optional<std::string> named_row(const core::Specification& step);

/// A checked request: its names have been looked up.
struct ComparisonPlan {
  NamedFunction function;
  std::vector<MethodChain> chains;  ///< by row; a count that is another row's is not in it yet
  std::optional<std::size_t> target;
  bool snap = false;
  std::vector<std::vector<RowCount>> counts;  ///< by row
  Registry registry;                          ///< a copy of the one that it was made with
  std::optional<PointsPlan> points = {};
};

/// Throws InvalidArgument on unknown names and keys, bad values, a target of 0, and the name of no earlier
/// row or of several. Touches no file.
ComparisonPlan prepare(const ComparisonRequest& request, const Registry& registry = Registry::standard());

/// Evaluates the function and then applies each chain in turn, calling every sink. Throws what functions,
/// methods and sinks throw.
void run_comparison(const core::LoadedMesh& loaded, const ComparisonPlan& plan,
                    const std::vector<ComparisonSink*>& sinks, const core::Progress& progress = {});

}  // namespace morsel::tools
