#include "morsel/tools/study/stability.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/rethrow.h"
#include "morsel/tools/study/point_matching.h"
#include "morsel/tools/study/random_stream.h"
#include "morsel/tools/study/tasks.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;
using morse::CriticalType;

constexpr std::array kTypes = {CriticalType::minimum, CriticalType::saddle, CriticalType::maximum};

/// The compared points of a field by type.
using PointsByType = std::array<std::vector<Point>, kTypes.size()>;

bool is_compared(CriticalType type, PointChoice choice) {
  return choice == PointChoice::all || type != CriticalType::saddle;
}

PointsByType by_type(const morse::CriticalPoints& points, PointChoice choice, std::span<const Point> places) {
  PointsByType result;
  for (std::size_t k = 0; k < kTypes.size(); ++k)
    for (const morse::CriticalPoint& point : points.points)
      if (point.type == kTypes[k] && is_compared(kTypes[k], choice))
        result[k].push_back(places[point.vertex]);
  return result;
}

/// The clean points of one outcome, to match others with.
class CleanPoints {
 public:
  CleanPoints(const PointsByType& points, double radius)
      : matchers_{PointMatcher(points[0], radius), PointMatcher(points[1], radius),
                  PointMatcher(points[2], radius)} {}

  Agreement match(const PointsByType& found) const {
    Agreement agreement;
    for (std::size_t k = 0; k < kTypes.size(); ++k) {
      agreement.reference += matchers_[k].size();
      agreement.found += found[k].size();
      const PointMatches matches = matchers_[k].match(found[k]);
      agreement.matched += matches.pairs.size();
      for (const PointPair& pair : matches.pairs) agreement.distances += pair.distance;
      if (!matches.is_least) agreement.is_least = false;
    }
    return agreement;
  }

  /// The number of matched points alone.
  std::size_t count(const PointsByType& found) const {
    std::size_t matched = 0;
    for (std::size_t k = 0; k < kTypes.size(); ++k) matched += matchers_[k].count(found[k]);
    return matched;
  }

 private:
  std::array<PointMatcher, kTypes.size()> matchers_;
};

/// The mean number of matches if as many points of each type as were found were at random vertices of their
/// surface.
double matches_by_chance(const CleanPoints& clean, const PointsByType& found, std::span<const Point> places,
                         RandomStream random) {
  std::vector<Index> vertices(places.size());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  double sum = 0;
  for (std::size_t placement = 0; placement < kPlacements; ++placement) {
    PointsByType placed;
    std::size_t used = 0;
    for (std::size_t k = 0; k < kTypes.size(); ++k)
      for (std::size_t i = 0; i < found[k].size(); ++i, ++used) {
        std::swap(vertices[used], vertices[used + random.below(vertices.size() - used)]);
        placed[k].push_back(places[vertices[used]]);
      }
    sum += static_cast<double>(clean.count(placed));
  }
  return sum / kPlacements;
}

/// The trials of one run, those of all perturbations one after the other.
class Trials {
 public:
  Trials(const core::LoadedMesh& clean, const StabilityPlan& plan, StabilityResult& result,
         std::vector<CleanPoints> points, TrialStore* store)
      : clean_(clean), plan_(plan), result_(result), points_(std::move(points)), store_(store) {
    for (std::size_t p = 0; p < plan.perturbations.size(); ++p)
      for (std::size_t t = 0; t < plan.trials_of(plan.perturbations[p]); ++t) trials_.emplace_back(p, t);
    for (StabilityOutcome& outcome : result.outcomes)
      for (const Perturbation& perturbation : plan.perturbations)
        outcome.perturbations.push_back({perturbation, std::vector<Trial>(plan.trials_of(perturbation))});
  }

  void run(const core::Progress& progress) {
    const auto run_one = [&](std::size_t i, const core::Progress& silent) {
      run_trial(trials_[i].first, trials_[i].second, silent);
    };
    run_tasks(trials_.size(), "trials", run_one, progress);
  }

 private:
  void run_trial(std::size_t p, std::size_t t, const core::Progress& progress) {
    const Perturbation& perturbation = plan_.perturbations[p];
    if (const std::optional<std::vector<Trial>> known =
            store_ == nullptr ? std::nullopt : store_->find(perturbation, t)) {
      take(p, t, *known);
      return;
    }
    std::vector<Trial> trials(result_.outcomes.size());
    std::string where = to_string(perturbation);
    if (perturbation.is_random()) where += ", trial " + std::to_string(t + 1);
    try {
      progress.throw_if_cancelled();
      const PerturbedMesh mesh = perturb(clean_, perturbation, plan_.seed, t);
      for (std::size_t f = 0; f < plan_.functions.size(); ++f) {
        const NamedFunction& function = plan_.functions[f];
        where += ", " + function.specification;
        const core::ScalarField field = evaluate_field(mesh.loaded, function, progress).field;
        for (std::size_t i = 0; i < result_.outcomes.size(); ++i) {
          const StabilityOutcome& outcome = result_.outcomes[i];
          if (outcome.field != f) continue;
          const MethodChain& chain = plan_.chains[outcome.method];
          const std::size_t length = where.size();
          where += ", " + chain.specification;
          trials[i] = measured(mesh, function, field, outcome, points_[i], perturbation, t, progress);
          where.resize(length);
        }
        where.resize(where.size() - function.specification.size() - 2);
      }
    } catch (const core::Cancelled&) {
      throw;
    } catch (const core::Error& error) {
      core::rethrow_at(error, where);
    }
    take(p, t, trials);
    if (store_ != nullptr) store_->add(perturbation, t, trials);
  }

  void take(std::size_t p, std::size_t t, const std::vector<Trial>& trials) {
    for (std::size_t i = 0; i < trials.size(); ++i)
      result_.outcomes[i].perturbations[p].trials[t] = trials[i];
  }

  Trial measured(const PerturbedMesh& mesh, const NamedFunction& function, const core::ScalarField& field,
                 const StabilityOutcome& outcome, const CleanPoints& clean, const Perturbation& perturbation,
                 std::size_t t, const core::Progress& progress) const {
    const ChainOutcome made = apply_chain(plan_.chains[outcome.method], mesh.loaded, function, field,
                                          {.target = outcome.target}, progress);
    Trial trial;
    trial.points = morse::classify(made.field, progress);
    const PointsByType found = by_type(trial.points, plan_.points, mesh.places);
    trial.points.points = {};
    trial.agreement = clean.match(found);
    const RandomStream random(
        plan_.seed, RandomUse::placement,
        {std::uint64_t(perturbation.kind), std::bit_cast<std::uint64_t>(perturbation.amount), t});
    trial.chance = 2 * matches_by_chance(clean, found, mesh.places, random) /
                   static_cast<double>(trial.agreement.reference + trial.agreement.found);
    return trial;
  }

  const core::LoadedMesh& clean_;
  const StabilityPlan& plan_;
  StabilityResult& result_;
  std::vector<CleanPoints> points_;  // by outcome
  TrialStore* store_;                // may be null
  std::vector<std::pair<std::size_t, std::size_t>> trials_;
};

/// All outcomes on the clean surface, and their points to be matched with.
std::vector<CleanPoints> run_clean(const core::LoadedMesh& clean, const StabilityPlan& plan,
                                   StabilityResult& result, const core::Progress& progress) {
  for (const NamedFunction& function : plan.functions)
    result.fields.push_back(evaluate_field(clean, function, progress));
  std::optional<FieldOutcome> reference_input;
  if (plan.reference_function) reference_input = evaluate_field(clean, *plan.reference_function, progress);
  std::vector<CleanPoints> points;
  for (const std::optional<std::size_t>& target : plan.targets)
    for (std::size_t f = 0; f < plan.functions.size(); ++f)
      for (std::size_t m = 0; m < plan.chains.size(); ++m) {
        ChainOutcome made = apply_chain(plan.chains[m], clean, plan.functions[f], result.fields[f].field,
                                        {.target = target}, progress);
        morse::CriticalPoints critical = morse::classify(made.field, progress);
        const PointsByType compared = by_type(critical, plan.points, clean.mesh.positions());
        const NamedFunction& function =
            plan.reference_function ? *plan.reference_function : plan.functions[f];
        const core::ScalarField& unsmoothed =
            reference_input ? reference_input->field : result.fields[f].field;
        const morse::CriticalPoints reference = morse::classify(
            apply_chain(plan.reference, clean, function, unsmoothed, {.target = critical.total()}, progress)
                .field);
        const CleanPoints of_reference(by_type(reference, plan.points, clean.mesh.positions()),
                                       result.radius);
        points.emplace_back(compared, result.radius);
        const Agreement agreement = of_reference.match(compared);
        const double chance = matches_by_chance(of_reference, compared, clean.mesh.positions(),
                                                {plan.seed, RandomUse::placement, {}}) /
                              static_cast<double>(agreement.found);
        result.outcomes.push_back(
            {f, m, target, std::move(made), std::move(critical), agreement, chance, {}});
      }
  return points;
}

}  // namespace

std::string_view to_string(PointChoice points) { return points == PointChoice::all ? "all" : "extrema"; }

Estimate PerturbationOutcome::recall() const {
  return over_trials([](const Trial& t) { return std::optional(t.agreement.recall()); });
}
Estimate PerturbationOutcome::precision() const {
  return over_trials([](const Trial& t) { return std::optional(t.agreement.precision()); });
}
Estimate PerturbationOutcome::f_score() const {
  return over_trials([](const Trial& t) { return std::optional(t.agreement.f_score()); });
}
Estimate PerturbationOutcome::chance() const {
  return over_trials([](const Trial& t) { return std::optional(t.chance); });
}
Estimate PerturbationOutcome::drift() const {
  return over_trials([](const Trial& t) { return t.agreement.drift(); });
}
Estimate PerturbationOutcome::found() const {
  return over_trials([](const Trial& t) { return std::optional(static_cast<double>(t.agreement.found)); });
}

std::vector<std::string> StabilityResult::warnings() const {
  std::size_t all = 0;
  std::size_t bounded = 0;
  for (const StabilityOutcome& outcome : outcomes)
    for (const PerturbationOutcome& perturbed : outcome.perturbations)
      for (const Trial& trial : perturbed.trials) {
        ++all;
        if (!trial.agreement.is_least) ++bounded;
      }
  if (bounded == 0) return {};
  return {"in " + std::to_string(bounded) + " of " + std::to_string(all) +
          " trials too many points are within the matching radius for the least sum of distances, so that "
          "their drift may be too large; a smaller radius would help"};
}

StabilityRequest with_defaults(StabilityRequest request) {
  if (request.noise.empty() && request.decimate.empty() && request.subdivide.empty())
    request.noise = {0.05, 0.15, 0.3, 0.5};
  return request;
}

StabilityPlan prepare(const StabilityRequest& given, const Registry& registry) {
  const StabilityRequest request = with_defaults(given);
  check_target(request.target);
  if (request.trials < 1) throw core::InvalidArgument("there must be at least one trial");
  if (request.fields.empty() || request.methods.empty())
    throw core::InvalidArgument("a field and a method are needed");
  StabilityPlan plan{{},
                     {},
                     {},
                     {std::nullopt},
                     request.trials,
                     request.seed,
                     core::parse_length(request.radius, "the matching radius"),
                     request.points,
                     {},
                     registry.make_method(request.reference, "the reference method")};
  if (!request.reference_field.empty())
    plan.reference_function = registry.make_function(request.reference_field, "the reference Morse function");
  if (!(plan.radius.value >= 0))
    throw core::InvalidArgument("the matching radius must be 0 or more, not " + request.radius);
  if (request.target) plan.targets.push_back(request.target);
  for (const std::string& field : request.fields) plan.functions.push_back(registry.make_function(field));
  for (const std::string& method : request.methods) plan.chains.push_back(registry.make_method(method));
  for (const double amount : request.noise)
    plan.perturbations.push_back({PerturbationKind::noise, amount, request.noise_kind});
  for (const double amount : request.decimate)
    plan.perturbations.push_back({PerturbationKind::decimation, amount, NoiseKind::normal});
  for (const double amount : request.subdivide)
    plan.perturbations.push_back({PerturbationKind::subdivision, amount, NoiseKind::normal});
  for (const Perturbation& perturbation : plan.perturbations) check(perturbation);
  for (const NamedFunction& function : plan.functions)
    if (!request.subdivide.empty() && function.function->traits().needs_input_vertices)
      throw core::InvalidArgument(function.name + " has no values for the vertices that subdivision adds");
  return plan;
}

StabilityResult run_stability(const core::LoadedMesh& clean, const StabilityPlan& plan,
                              const core::Progress& progress, TrialStore* store) {
  StabilityResult result;
  result.radius = plan.radius.on(clean.mesh);
  result.mean_edge_length = core::mean_edge_length(clean.mesh);
  if (!(result.mean_edge_length > 0))
    throw core::BadInput("there is no noise in units of the mean edge length: all vertices coincide");
  const Stopwatch clean_watch;
  std::vector<CleanPoints> points = run_clean(clean, plan, result, progress);
  result.clean_seconds = clean_watch.seconds();
  const Stopwatch trial_watch;
  Trials(clean, plan, result, std::move(points), store).run(progress);
  result.trial_seconds = trial_watch.seconds();
  return result;
}

}  // namespace morsel::tools
