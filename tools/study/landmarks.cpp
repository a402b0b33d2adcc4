#include "morsel/tools/study/landmarks.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/rethrow.h"
#include "morsel/tools/study/chance_points.h"
#include "morsel/tools/study/made_field.h"
#include "morsel/tools/study/tasks.h"

namespace morsel::tools {
namespace {

using core::Index;
using Chance = LandmarksPlan::Chance;

/// All rows on one mesh.
class MeshRun {
 public:
  MeshRun(const LandmarksPlan& plan, const MarkedMesh& marked, const core::Progress& progress)
      : plan_(plan),
        loaded_(marked.loaded),
        progress_(progress),
        distances_(loaded_.mesh),
        scorer_(distances_, marked.marks, plan.request.radius.on(loaded_.mesh), curve()),
        maker_(plan.choice, loaded_) {
    result_.marks = marked.marks.size();
    result_.wanted = plan.request.count.value_or(result_.marks);
    result_.radius = plan.request.radius.on(loaded_.mesh);
    result_.spacing = plan.choice.request.spacing.on(loaded_.mesh);
    result_.warnings = marked.warnings;
  }

  LandmarksOnMesh run() {
    for (const NamedFunction& function : plan_.functions) {
      const FieldOutcome field =
          named(function.specification, [&] { return evaluate_field(loaded_, function, progress_); });
      result_.fields.push_back(summary_of(field));
      for (const MethodChain& chain : plan_.chains)
        result_.rows.push_back(named(function.specification + ", " + chain.specification,
                                     [&] { return made_row(function, field, chain); }));
    }
    for (const Chance chance : LandmarksPlan::kChances) result_.rows.push_back(chance_row(chance));
    return std::move(result_);
  }

 private:
  std::vector<double> curve() const {
    const double largest = plan_.request.largest_radius.on(loaded_.mesh);
    std::vector<double> radii;
    for (std::size_t step = 0; step <= LandmarksPlan::kCurveSteps; ++step)
      radii.push_back(largest * static_cast<double>(step) / LandmarksPlan::kCurveSteps);
    return radii;
  }

  LandmarkRow made_row(const NamedFunction& function, const FieldOutcome& field, const MethodChain& chain) {
    progress_.throw_if_cancelled();
    const MadeField made{field, apply_chain(chain, loaded_, function, field.field, {}, progress_)};
    const MadePoints points = maker_.make(made.for_points(), result_.wanted, progress_);
    LandmarkRow row;
    for (const StepOutcome& step : made.outcome.steps) {
      row.steps.push_back({step.name, step.parameters, {}, {}});
      for (const std::string& warning : step.warnings) row.warnings.push_back(step.name + ": " + warning);
    }
    row.min = made.field().min();
    row.max = made.field().max();
    if (points.fill) row.fill = summary_of(*points.fill);
    row.scale = points.scale;
    row.note = points.note;
    std::vector<Index> vertices;
    for (const morse::ChosenPoint& point : points.chosen.points)
      vertices.push_back(point.candidate.point.vertex);
    add_points(row, vertices);
    return row;
  }

  LandmarkRow chance_row(Chance chance) {
    progress_.throw_if_cancelled();
    const std::uint64_t seed = plan_.request.seed;
    LandmarkRow row;
    if (chance == Chance::farthest) {
      add_points(row,
                 spread_points(distances_, result_.wanted, RandomStream(seed, RandomUse::spread_points, {})));
    } else {
      for (std::uint64_t set = 0; set < kPlacements; ++set)
        add_set(row, random_points(loaded_.mesh, distances_, result_.wanted, result_.spacing,
                                   RandomStream(seed, RandomUse::random_points, {set})));
    }
    return row;
  }

  void add_points(LandmarkRow& row, const std::vector<Index>& vertices) const {
    add_set(row, vertices);
    for (const Index v : vertices) row.points.push_back(loaded_.source.numbering.input_vertex(v));
  }

  void add_set(LandmarkRow& row, std::span<const Index> vertices) const {
    row.sets.push_back(scorer_.score(vertices));
    if (!row.sets.back().one_to_one.is_least && row.warnings.empty())
      row.warnings.push_back("points and marks are too many for the least sum of distances of matched ones");
  }

  /// Calls `work`; its errors begin with `where`.
  template <class Work>
  static std::invoke_result_t<const Work&> named(const std::string& where, const Work& work) {
    try {
      return work();
    } catch (const core::Cancelled&) {
      throw;
    } catch (const core::Error& error) {
      core::rethrow_at(error, where);
    }
  }

  const LandmarksPlan& plan_;
  const core::LoadedMesh& loaded_;
  const core::Progress& progress_;
  morse::SurfaceDistances distances_;
  MarkScorer scorer_;
  PointMaker maker_;
  LandmarksOnMesh result_;
};

void check_radius(const char* what, const core::Length& radius) {
  if (!(radius.value >= 0) || !std::isfinite(radius.value))
    throw core::InvalidArgument(std::string(what) + " must be 0 or more, not " + core::to_string(radius));
}

}  // namespace

std::string LandmarksPlan::name_of(std::size_t row) const {
  if (row >= made_rows()) return kChances[row - made_rows()] == Chance::random ? "random" : "farthest points";
  const std::string& field = functions[field_of(row)].specification;
  const std::string& method = chains[method_of(row)].specification;
  if (chains.size() == 1 && method == "conventional") return field;
  return chains.size() > 1 && functions.size() == 1 ? method : field + ", " + method;
}

LandmarksPlan prepare(const LandmarksRequest& request, const Registry& registry) {
  if (request.fields.empty() || request.methods.empty())
    throw core::InvalidArgument("a field and a method are needed");
  if (request.count == 0) throw core::InvalidArgument("the number of points must be at least 1, not 0");
  check_radius("the radius of a hit", request.radius);
  check_radius("the largest radius", request.largest_radius);
  if (request.largest_radius.value == 0) throw core::InvalidArgument("the largest radius must be above 0");
  if (request.first > 1) throw core::InvalidArgument("the first vertex of a mesh is 0 or 1");
  static_cast<void>(Bootstrap(0, request.resamples, request.seed));  // which checks their number
  LandmarksPlan plan{request, {}, {}, prepare(request.choice, registry)};
  for (const std::string& field : request.fields) plan.functions.push_back(registry.make_function(field));
  for (const std::string& method : request.methods) plan.chains.push_back(registry.make_method(method));
  return plan;
}

std::vector<LandmarksOnMesh> run_landmarks(MarkedMeshes& meshes, const LandmarksPlan& plan,
                                           const core::Progress& progress, LandmarksStore* store) {
  std::vector<LandmarksOnMesh> results(meshes.size());
  const auto run_one = [&](std::size_t i, const core::Progress& silent) {
    if (store != nullptr)
      if (std::optional<LandmarksOnMesh> known = store->find(i)) {
        results[i] = std::move(*known);
        return;
      }
    silent.throw_if_cancelled();
    const Stopwatch watch;
    const MarkedMesh marked = meshes.load(i, silent);  // whose errors name the file
    try {
      results[i] = MeshRun(plan, marked, silent).run();
    } catch (const core::Cancelled&) {
      throw;
    } catch (const core::Error& error) {
      core::rethrow_at(error, meshes.name(i));
    }
    results[i].seconds = watch.seconds();
    if (store != nullptr) store->add(i, results[i]);
  };
  run_tasks(meshes.size(), "meshes", run_one, progress);
  return results;
}

std::vector<LandmarksSummary> summarize(const LandmarksPlan& plan,
                                        const std::vector<LandmarksOnMesh>& meshes) {
  const Bootstrap bootstrap(meshes.size(), plan.request.resamples, plan.request.seed);
  const auto values_of = [&](std::size_t row, const auto& quantity) {
    std::vector<double> values;
    for (const LandmarksOnMesh& mesh : meshes) values.push_back(mesh.rows[row].mean(quantity));
    return values;
  };
  const auto mean_of = [](const std::vector<double>& values) { return estimate(values).mean; };
  const auto mean_with_interval = [&](const std::vector<double>& values) {
    return MeshMean{mean_of(values), bootstrap.of_mean(values)};
  };
  const auto f_score = [](const MarkScore& score) { return score.f_score(); };
  const std::vector<double> first_f_scores = values_of(0, f_score);

  std::vector<LandmarksSummary> summaries;
  for (std::size_t row = 0; row < plan.rows(); ++row) {
    const auto mean = [&](const auto& quantity) { return mean_with_interval(values_of(row, quantity)); };
    LandmarksSummary& sum = summaries.emplace_back();
    sum.points = mean([](const MarkScore& score) { return static_cast<double>(score.points()); });
    sum.recall = mean([](const MarkScore& score) { return score.recall(); });
    sum.precision = mean([](const MarkScore& score) { return score.precision(); });
    sum.f_score = mean(f_score);
    sum.matched_recall = mean([](const MarkScore& score) { return score.one_to_one.recall(); });
    sum.matched_precision = mean([](const MarkScore& score) { return score.one_to_one.precision(); });
    sum.matched_f_score = mean([](const MarkScore& score) { return score.one_to_one.f_score(); });
    sum.false_negatives = mean([](const MarkScore& score) { return score.false_negatives(); });
    sum.false_positives = mean([](const MarkScore& score) { return score.false_positives(); });
    std::vector<double> gains = values_of(row, f_score);
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i] -= first_f_scores[i];
    sum.f_score_gain = mean_with_interval(gains);

    std::vector<double> distances;
    for (const LandmarksOnMesh& mesh : meshes) {
      Agreement all;
      for (const MarkScore& score : mesh.rows[row].sets) {
        all.matched += score.one_to_one.matched;
        all.distances += score.one_to_one.distances;
      }
      if (all.drift() && mesh.radius > 0) distances.push_back(*all.drift() / mesh.radius);
      if (std::ranges::any_of(mesh.rows[row].sets,
                              [&](const MarkScore& score) { return score.points() < mesh.wanted; }))
        ++sum.fewer;
    }
    if (!distances.empty()) sum.distance = mean_of(distances);
    for (std::size_t step = 0; step <= LandmarksPlan::kCurveSteps; ++step) {
      sum.false_negatives_within.push_back(
          mean_of(values_of(row, [step](const MarkScore& score) { return score.false_negatives(step); })));
      sum.false_positives_within.push_back(
          mean_of(values_of(row, [step](const MarkScore& score) { return score.false_positives(step); })));
    }
  }
  return summaries;
}

}  // namespace morsel::tools
