#include "morsel/tools/study/target.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/tracking.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/tools/study/comparison.h"
#include "support/fields.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

tools::ChainOutcome apply(const std::string& method, const ScalarField& input, std::size_t target,
                          morse::CriticalPointTracker* tracker = nullptr) {
  const core::LoadedMesh loaded{input.mesh(), {}};
  return tools::apply_chain(tools::Registry::standard().make_method(method), loaded,
                            tools::Registry::standard().make_function("height"), input,
                            {target, false, tracker});
}

std::size_t total(const ScalarField& field) { return morse::classify(field).total(); }

}  // namespace

TEST_CASE("a target is reached where parity and topology allow") {
  for (const char* method : {"salient:iterations=2,sigma=0.6", "laplacian:iterations=4", "tps:threshold=30%",
                             "conventional", "laplacian:iterations=1+tps", "laplacian:iterations=400"})
    for (const NamedMesh& entry : mesh_zoo())
      for (const unsigned seed : {1u, 2u}) {
        const ScalarField input(entry.mesh, random_values(entry.mesh.vertex_count(), seed));
        const std::size_t least =
            total(persistence::cancel(input, {persistence::Threshold::percent(100), {}}).field);
        for (const std::size_t wanted :
             {std::size_t{5}, std::size_t{12}, 1 + total(input) / 2, 2 * total(input)}) {
          INFO(entry.name << ", " << method << ", " << wanted << " of " << total(input));
          const tools::ChainOutcome outcome = apply(method, input, wanted);
          REQUIRE(outcome.target);
          const tools::TargetOutcome& target = *outcome.target;
          CHECK(target.wanted == wanted);
          CHECK(target.reached == total(outcome.field));
          CHECK(target.note.empty() == (target.reached == wanted));
          if (target.reached > wanted) CHECK(persistence::pair_extrema(outcome.field).count_above(0) == 0);
          const long parity = static_cast<long>(wanted) - entry.mesh.euler_characteristic();
          if (parity % 2 == 0 && wanted >= least && wanted <= target.before_cancelling)
            CHECK(target.reached == wanted);
          double largest = 0;
          for (const auto& pair : target.cancelled) largest = std::max(largest, pair.persistence());
          CHECK(target.largest_cancelled == largest);
        }
      }
}

TEST_CASE("a method's own field with too few points says so, and is not blended with its input") {
  const TriangleMesh mesh = sphere(4).mesh();
  const ScalarField input(mesh, random_values(mesh.vertex_count(), 5));
  const std::string far = "salient:iterations=1,sigma=1,range=1000std";
  const tools::ChainOutcome alone =
      tools::apply_chain(tools::Registry::standard().make_method(far), {mesh, {}},
                         tools::Registry::standard().make_function("height"), input);
  REQUIRE(total(alone.field) < 100);
  const tools::ChainOutcome outcome = apply(far, input, 400);
  CHECK(outcome.target->reached < 400);
  CHECK(outcome.target->iterations == 1);
  CHECK(outcome.target->before_cancelling == total(alone.field));
  CHECK_THAT(outcome.target->note, Catch::Contains("own field has " + std::to_string(total(alone.field)) +
                                                   " critical points, fewer than 400"));
}

TEST_CASE("a last step whose input the caller ends at is not run; a target cancels the input itself") {
  const tools::Registry& registry = tools::Registry::standard();
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField input(mesh, random_values(mesh.vertex_count(), 8));
  const tools::NamedFunction function = registry.make_function("height");
  for (const char* text : {"salient:iterations=3,sigma=0.4", "tps:count=6"})
    for (const std::optional<std::size_t> target :
         {std::optional<std::size_t>(), std::optional<std::size_t>(10)}) {
      std::vector<int> called;
      morse::CriticalPointTracker tracker(input, 0.5);
      tools::ChainOptions options{target, false, &tracker};
      options.on_iteration = [&](int number, const ScalarField& field) {
        called.push_back(number);
        CHECK(std::ranges::equal(field.values(), input.values()));
        return false;
      };
      const tools::ChainOutcome outcome =
          tools::apply_chain(registry.make_method(text), {mesh, {}}, function, input, options);
      CHECK(called == std::vector<int>{0});
      CHECK(outcome.steps.back().end->iterations_run == 0);
      CHECK(outcome.steps.back().end->stopped_by == "caller");
      if (target) {
        CHECK(outcome.target->reached == total(outcome.field));
        CHECK(outcome.target->iterations == 0);
        CHECK(outcome.target->reached <= *target + 1);
        CHECK(std::ranges::equal(tracker.field().ranks(), outcome.field.ranks()));
      } else {
        CHECK(std::ranges::equal(outcome.field.values(), input.values()));
        CHECK_FALSE(outcome.target);
      }
    }
}

TEST_CASE("regression: a target returned the input where that had no more points, whatever the method") {
  const tools::Registry& registry = tools::Registry::standard();
  const tools::NamedFunction function = registry.make_function("mean-curvature");
  for (const TriangleMesh& mesh :
       {jittered(sphere(3).mesh(), 0.03, 5), jittered(torus(16, 12).mesh(), 0.03, 7)})
    for (const char* text :
         {"conventional", "denoise:iterations=2", "fair:extrema=5", "gaussian:sigma=0.4,iterations=2",
          "laplacian:iterations=4", "laplacian:scheme=implicit,iterations=2,time=0.3,weights=cotangent",
          "saliency:scales=0.3/0.5", "salient:iterations=3,sigma=0.4",
          "salient:iterations=2,sigma=0.4,classify=saliency", "salient:scale=1edges,iterations=2",
          "spectral:modes=6", "tps:threshold=10%", "tps:count=20"}) {
      const tools::MethodChain chain = registry.make_method(text);
      const core::LoadedMesh loaded{mesh, {}};
      // Two inputs: one with many points, and one with few, which some methods add to.
      const ScalarField rough = function.function->evaluate(mesh, {}).field;
      for (const ScalarField& input : {rough, ScalarField(mesh, smooth_values(mesh, 1, 3))}) {
        std::vector<ScalarField> fields;  // that the method passes through
        tools::ChainOptions watching;
        watching.on_iteration = [&](int, const ScalarField& field) {
          fields.push_back(field);
          return true;
        };
        const ScalarField alone = tools::apply_chain(chain, loaded, function, input, watching).field;
        const core::MethodTraits traits = chain.steps.front().method->traits();
        if (!traits.cancels_pairs) fields.erase(fields.begin());  // its input
        if (traits.returns_other) fields.clear();
        fields.push_back(alone);
        std::size_t most = 0;
        for (const ScalarField& field : fields) most = std::max(most, total(field));
        std::set<std::size_t> wanted = {5, 2 * total(input)};
        for (const std::size_t k : {total(input), total(alone)}) wanted.insert({k - 1, k, k + 1, k + 2});
        wanted.erase(0);
        for (const std::size_t k : wanted) {
          INFO(text << ", " << k << " of " << total(alone) << ", of the input's " << total(input));
          const tools::ChainOutcome outcome =
              tools::apply_chain(chain, loaded, function, input, {k, false, nullptr});
          const tools::TargetOutcome& target = *outcome.target;
          CHECK(target.reached == total(outcome.field));
          CHECK(target.note.empty() == (target.reached == k));
          // The result is one of the method's own fields, but for what was cancelled and unfolded.
          const auto differs_by = [&](const ScalarField& field) {
            double most_apart = 0;
            for (Index v = 0; v < mesh.vertex_count(); ++v)
              most_apart = std::max(most_apart, std::abs(field.value(v) - outcome.field.value(v)));
            return most_apart;
          };
          const double allowed = (target.largest_cancelled +
                                  target.largest_unfolding * static_cast<double>(target.unfolded.size())) *
                                 (1 + 1e-12);
          CHECK(std::ranges::any_of(fields,
                                    [&](const ScalarField& field) { return differs_by(field) <= allowed; }));
          CHECK((target.before_cancelling >= k) == (most >= k));
          if (most < k) CHECK(target.before_cancelling == total(alone));
          // Nothing is unfolded in vain.
          if (most < k && target.reached != k)
            CHECK(std::ranges::equal(outcome.field.values(), alone.values()));
          if (most < k && target.reached != k)
            CHECK_THAT(target.note,
                       Catch::StartsWith("the method's own field has " + std::to_string(total(alone)) +
                                         " critical points, fewer than " + std::to_string(k)));
          if (most >= k && target.reached != k) CHECK_THAT(target.note, Catch::StartsWith("no number of"));
        }
      }
    }
}

TEST_CASE("the iterations before the target are run and the ones after are not") {
  const TriangleMesh mesh = sphere(4).mesh();
  const ScalarField input(mesh, random_values(mesh.vertex_count(), 5));
  const core::LoadedMesh loaded{mesh, {}};
  const tools::ChainOutcome all =
      tools::apply_chain(tools::Registry::standard().make_method("laplacian:iterations=30"), loaded,
                         tools::Registry::standard().make_function("height"), input, {{}, true, nullptr});
  const auto& curve = all.steps[0].iterations;
  REQUIRE(curve.size() == 31);
  const std::size_t wanted = curve[7].total() - 1;
  const tools::ChainOutcome outcome =
      tools::apply_chain(tools::Registry::standard().make_method("laplacian:iterations=30"), loaded,
                         tools::Registry::standard().make_function("height"), input, {wanted, true, nullptr});
  std::size_t first = 0;
  while (curve[first].total() >= wanted) ++first;
  CHECK(outcome.steps[0].iterations.size() == first + 1);  // the last of them went too far
  CHECK(outcome.target->iterations == static_cast<int>(first) - 1);
  CHECK(outcome.target->left_by_next == curve[first].total());
  CHECK_THAT(tools::early_end(*outcome.target),
             Catch::EndsWith("the next iteration leaves " + std::to_string(curve[first].total())));
  CHECK(outcome.target->reached == wanted - wanted % 2);
}

TEST_CASE("origins lead through a chain and a target to critical points of the input") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const ScalarField input(entry.mesh, random_values(entry.mesh.vertex_count(), 11));
    morse::CriticalPointTracker tracker(input, entry.mesh.bounding_box().diagonal());
    const tools::ChainOutcome outcome =
        apply("laplacian:iterations=2+salient:iterations=2,sigma=0.4+tps:threshold=1%", input, 8, &tracker);
    REQUIRE(tracker.points().points == morse::classify(outcome.field).points);
    for (std::size_t i = 0; i < tracker.origins().size(); ++i)
      if (tracker.origins()[i] != core::kNone)
        CHECK(morse::classify_vertex(input, tracker.origins()[i]).type == tracker.points().points[i].type);
  }
}

TEST_CASE("a target gives the same bits at any number of threads") {
  const TriangleMesh mesh = torus(90, 80).mesh();
  const ScalarField input(mesh, smooth_values(mesh, 1, 3));
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    morse::CriticalPointTracker tracker(input, 1);
    const tools::ChainOutcome outcome = apply("salient:iterations=3,sigma=0.3", input, 60, &tracker);
    return std::tuple{std::vector<double>(outcome.field.values().begin(), outcome.field.values().end()),
                      std::vector<Index>(tracker.origins().begin(), tracker.origins().end()),
                      *outcome.target};
  };
  CHECK(run(1) == run(4));
}

TEST_CASE("persistence gives the most persistent extrema") {
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField input(mesh, random_values(mesh.vertex_count(), 5));
  const persistence::Diagram diagram = persistence::pair_extrema(input);
  const std::vector<Index> four = persistence::persistent_extrema(diagram, 4);
  REQUIRE(four.size() == 4);
  CHECK(four[0] == input.order().front());
  CHECK(four[1] == input.order().back());
  CHECK(four[2] == diagram.pairs[diagram.finite_count - 1].extremum);
  CHECK(four[3] == diagram.pairs[diagram.finite_count - 2].extremum);
  const morse::CriticalPoints points = morse::classify(input);
  CHECK(persistence::persistent_extrema(diagram, 1'000'000).size() == points.minima + points.maxima);
  CHECK(persistence::persistent_extrema(diagram, 0).empty());
}

TEST_CASE("a target of 0 is refused") {
  tools::ComparisonRequest request;
  request.target = 0;
  CHECK_THROWS_AS(tools::prepare(request), core::InvalidArgument);
  CHECK_THROWS_WITH(tools::prepare(request), Catch::Contains("target of 0"));
}

TEST_CASE("a method that evaluates the function again gives the target its initial field") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.02, 5);
  const core::LoadedMesh loaded{mesh, {}};
  const ScalarField input =
      tools::Registry::standard().make_function("mean-curvature").function->evaluate(mesh, {}).field;
  const ScalarField at_scale = tools::Registry::standard()
                                   .make_function("mean-curvature:scale=1edges")
                                   .function->evaluate(mesh, {})
                                   .field;
  REQUIRE(total(at_scale) < total(input));
  const auto reach = [&](std::size_t wanted) {
    return tools::apply_chain(tools::Registry::standard().make_method("salient:scale=1edges,iterations=3"),
                              loaded, tools::Registry::standard().make_function("mean-curvature"), input,
                              {wanted, false, nullptr});
  };
  const tools::ChainOutcome begin = reach(total(at_scale));
  CHECK(std::ranges::equal(begin.field.values(), at_scale.values()));
  CHECK(begin.target->iterations == 1);
  CHECK(begin.target->cancelled.empty());
  const tools::ChainOutcome less = reach(total(at_scale) - 2);
  CHECK(less.target->reached == total(at_scale) - 2);
  CHECK(less.target->iterations >= 1);
  const tools::ChainOutcome more = reach(2 * total(input));
  CHECK(more.target->reached < 2 * total(input));
  CHECK_THAT(more.target->note, Catch::Contains("own field has"));
}
