#pragma once
/// Stability of critical points: how well they repeat on perturbed surfaces.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/study/agreement.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/perturbation.h"
#include "morsel/tools/study/statistics.h"

namespace morsel::tools {

/// Which critical points are compared with each other.
enum class PointChoice : std::uint8_t { all, extrema };
/// "all", "extrema".
std::string_view to_string(PointChoice points);

/// A stability study in the syntax of the command line.
struct StabilityRequest {
  std::vector<std::string> fields = {"mean-curvature"};
  std::vector<std::string> methods = {"conventional", "salient", "tps"};
  std::vector<double> noise;  ///< standard deviations in mean edge lengths
  NoiseKind noise_kind = NoiseKind::normal;
  std::vector<double> decimate;         ///< shares of the vertices that are left
  std::vector<double> subdivide;        ///< pieces that edges are cut into
  std::size_t trials = 10;              ///< of each perturbation that is random
  std::uint64_t seed = 1;               ///< of all trials
  std::optional<std::size_t> target;    ///< critical points of each field, besides each method's own count
  std::string radius = "0.02rootarea";  ///< of matching: a length on the clean mesh
  PointChoice points = PointChoice::all;
  std::string reference_field;  ///< each row's own if empty
  std::string reference = "conventional";
};

/// Fills in the perturbations that a request leaves out: if it has none, noise of 0.05, 0.15, 0.3 and 0.5.
StabilityRequest with_defaults(StabilityRequest request);

/// A request whose names and numbers have been looked up.
struct StabilityPlan {
  std::vector<NamedFunction> functions;
  std::vector<MethodChain> chains;
  std::vector<Perturbation> perturbations;
  std::vector<std::optional<std::size_t>> targets;  ///< none: the method's own count
  std::size_t trials = 1;
  std::uint64_t seed = 1;
  core::Length radius;  ///< of matching, on the clean mesh
  PointChoice points = PointChoice::all;
  std::optional<NamedFunction> reference_function;  ///< none: each row's own
  MethodChain reference;

  /// The number of trials of a perturbation: one if nothing is random.
  std::size_t trials_of(const Perturbation& perturbation) const {
    return perturbation.is_random() ? trials : 1;
  }
};

/// Throws InvalidArgument on unknown names and keys, bad values and options that exclude each other. Touches
/// no file.
StabilityPlan prepare(const StabilityRequest& request, const Registry& registry = Registry::standard());

/// One perturbed surface.
struct Trial {
  morse::CriticalPoints points;  ///< counts only
  Agreement agreement;           ///< the clean surface's points are the reference
  double chance = 0;             ///< expected F-score of as many points of the same types at random vertices
};

struct PerturbationOutcome {
  Perturbation perturbation;
  std::vector<Trial> trials;

  /// The estimate of a quantity over the trials that have it.
  template <class Quantity>
  Estimate over_trials(const Quantity& quantity) const {
    std::vector<double> values;
    for (const Trial& trial : trials)
      if (const std::optional<double> value = quantity(trial)) values.push_back(*value);
    return estimate(values);
  }
  Estimate recall() const;
  Estimate precision() const;
  Estimate f_score() const;
  Estimate chance() const;
  Estimate drift() const;
  Estimate found() const;  ///< points that are compared with the clean ones
};

/// The outcome of a method on a field, at its own count or at the wanted one.
struct StabilityOutcome {
  std::size_t field = 0;  ///< its number in the request
  std::size_t method = 0;
  std::optional<std::size_t> target;
  ChainOutcome clean;
  morse::CriticalPoints points;  ///< on the clean surface
  Agreement with_reference;      ///< `found`: the method's clean points; those of the reference method at the
                                 ///< same count, by default on the row's own field
  double chance = 0;  ///< expected agreement of as many points of the same types at random vertices
  std::vector<PerturbationOutcome> perturbations;

  /// Share of the clean points that the reference has too.
  double agreement() const { return with_reference.precision(); }
};

struct StabilityResult {
  double radius = 0;                       ///< in the mesh's unit
  double mean_edge_length = 0;             ///< likewise
  std::vector<FieldOutcome> fields;        ///< on the clean surface
  std::vector<StabilityOutcome> outcomes;  ///< by target, field and method
  double clean_seconds = 0;
  double trial_seconds = 0;

  /// A sentence where trials have more points within the radius than a least sum of distances is found for
  /// (MatchingBounds).
  std::vector<std::string> warnings() const;
};

/// Trials that are known, and a callback for new trials: an interrupted run continues from them.
class TrialStore {
 public:
  virtual ~TrialStore() = default;
  /// A trial for each outcome, in their order, or nothing if they are not known. May be called from several
  /// threads at once, as add().
  virtual std::optional<std::vector<Trial>> find(const Perturbation& perturbation,
                                                 std::size_t number) const = 0;
  virtual void add(const Perturbation& perturbation, std::size_t number,
                   const std::vector<Trial>& trials) = 0;
};

/// Makes all fields with all methods on the clean surface and on every perturbed one, and matches their
/// critical points with the clean ones (PointMatcher, type by type) by where they lie on the clean surface
/// (PerturbedMesh::places): a point that stays at its vertex has not moved. Points of a subdivided surface
/// keep their positions.
///
/// The chance level is the mean F-score of kPlacements sets of as many points of each type at vertices of the
/// perturbed surface, all equally likely and no two of a set the same.
///
/// Trials run in parallel; a trial's result depends on its perturbation, the seed and its number alone, so it
/// is the same whatever else runs and at any number of threads. Throws what functions and methods throw; an
/// error in a trial names the perturbation, trial, field and method, and of several it is that of the first.
/// Trials that the `store`, if there is one, has are taken from it.
StabilityResult run_stability(const core::LoadedMesh& clean, const StabilityPlan& plan,
                              const core::Progress& progress = {}, TrialStore* store = nullptr);

}  // namespace morsel::tools
