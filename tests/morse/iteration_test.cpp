#include "morsel/morse/smoothing/iteration.h"

#include <catch2/catch.hpp>

#include "morsel/core/error.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/smoothing/diffusion.h"
#include "morsel/morse/smoothing/gaussian.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::IterationControl;
using morse::StopCriteria;
namespace {

using MakeMethod = std::unique_ptr<core::Method> (*)(core::ParameterReader&);

core::MethodResult run(MakeMethod make, const ScalarField& field, Given given,
                       const core::MethodContext& context = {}) {
  return made(make, "method", std::move(given))->apply(field, context);
}

core::ParameterValue detail(const core::MethodResult& result, const std::string& name) {
  for (const auto& [key, value] : result.details)
    if (key == name) return value;
  throw std::out_of_range(name);
}

std::string stopped_by(const core::MethodResult& result) {
  return std::get<std::string>(detail(result, "stopped_by"));
}
std::int64_t iterations_run(const core::MethodResult& result) {
  return std::get<std::int64_t>(detail(result, "iterations_run"));
}

std::vector<double> halved(std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  for (double& value : result) value /= 2;
  return result;
}

ScalarField noisy(int subdivisions = 3) {
  const TriangleMesh mesh = sphere(subdivisions).mesh();
  return {mesh, random_values(mesh.vertex_count(), 3)};
}

constexpr MakeMethod kIterative[] = {morse::make_salient, morse::make_laplacian, morse::make_gaussian};

}  // namespace

TEST_CASE("iterations end at their number and count nothing unasked") {
  const ScalarField input = noisy(1);
  const core::MethodContext context;
  IterationControl control(input, {.iterations = 3}, context);
  int runs = 0;
  for (; control.more(); ++runs) control.record(halved(control.field().values()));
  CHECK(runs == 3);
  CHECK(control.iterations_run() == 3);
  CHECK(control.stopped_by() == "iterations");
  CHECK(control.field().value(5) == input.value(5) / 8);
  const core::MethodResult result = control.result({{"more", true}});
  CHECK(result.iterations.empty());
  CHECK(result.parameters == core::Parameters{{"iterations", std::int64_t{3}}, {"more", true}});
  REQUIRE(result.end);
  CHECK(result.end->iterations_run == 3);
  CHECK(result.end->stopped_by == "iterations");
  CHECK(iterations_run(result) == 3);
  CHECK(stopped_by(result) == "iterations");
  CHECK_FALSE(result.sigma);
  CHECK(run(morse::make_gaussian, input, {{"sigma", "0.25"}}).sigma == 0.25);
  CHECK(run(morse::make_salient, input, {{"sigma", "0.25"}, {"classify", "saliency"}}).sigma == 0.25);
  IterationControl none(input, {.iterations = 0}, context);
  CHECK_FALSE(none.more());
}

TEST_CASE("a change below the asked share of the extent ends the iterations") {
  const ScalarField input = noisy(1);
  const core::MethodContext context;
  IterationControl control(input, {.iterations = 100, .until_change = 0.01}, context);
  std::vector<double> values(input.values().begin(), input.values().end());
  const Index top = input.order().back();
  for (const double step : {0.5, 0.1, 0.0101, 0.0099}) {
    REQUIRE(control.more());
    values[top] += step * input.extent();
    control.record(values);
  }
  CHECK(control.stopped_by() == "until-change");
  CHECK(control.iterations_run() == 4);
}

TEST_CASE("equal counts in a row end the iterations") {
  core::MethodContext context;
  context.count_iterations = true;
  const ScalarField input = noisy(1);
  IterationControl control(input, {.iterations = 100, .until_stable = 4}, context);
  while (control.more()) control.record(halved(control.field().values()));  // the input and three like it
  CHECK(control.stopped_by() == "until-stable");
  CHECK(control.iterations_run() == 3);
  REQUIRE(control.result({}).iterations.size() == 4);
  CHECK(control.result({}).iterations[1].change == Approx(input.max() / 2));
}

TEST_CASE("every iterative method stops at the first iteration with few enough critical points") {
  const ScalarField input = noisy();
  for (const MakeMethod make : kIterative) {
    core::MethodContext context;
    context.count_iterations = true;
    const core::MethodResult all = run(make, input, {{"iterations", "12"}}, context);
    REQUIRE(all.iterations.size() == 13);
    CHECK(all.iterations[0].total() == morse::classify(input).total());
    CHECK(all.iterations[0].change == 0);
    CHECK(all.iterations.back().total() == morse::classify(all.field).total());
    const std::size_t wanted = all.iterations[5].total();
    std::size_t first = 0;
    while (all.iterations[first].total() > wanted) ++first;
    const core::MethodResult some = run(make, input, {{"until-count", std::to_string(wanted)}});
    CHECK(iterations_run(some) == static_cast<std::int64_t>(first));
    CHECK(stopped_by(some) == "until-count");
    CHECK(morse::classify(some.field).total() == all.iterations[first].total());
    CHECK(some.parameters[0] == core::Parameters::value_type{"iterations", std::int64_t{1000}});
    const core::MethodResult none = run(make, input, {{"until-count", "100000"}});
    CHECK(iterations_run(none) == 0);
    const core::MethodResult too_few = run(make, input, {{"until-count", "2"}, {"iterations", "1"}});
    CHECK(stopped_by(too_few) == "iterations");
    const core::MethodResult settled = run(make, input, {{"until-change", "0.05"}});
    CHECK(stopped_by(settled) == "until-change");
  }
}

TEST_CASE("an observer of an iterative method gets every field and may end it") {
  const ScalarField input = noisy();
  for (const MakeMethod make : kIterative) {
    core::MethodContext context;
    int seen = 0;
    double last = 0;
    context.on_iteration = [&](int iteration, const ScalarField& field) {
      CHECK(iteration == ++seen);
      last = field.value(0);
      return iteration < 3;
    };
    const core::MethodResult result = run(make, input, {{"iterations", "10"}}, context);
    CHECK(seen == 3);
    CHECK(stopped_by(result) == "caller");
    CHECK(result.field.value(0) == last);
    CHECK(result.iterations.empty());
    // Where the method would have ended anyway, that reason is reported.
    seen = 0;
    CHECK(stopped_by(run(make, input, {{"iterations", "3"}}, context)) == "iterations");
  }
}

TEST_CASE("an observer of some iterations gets these alone, and nothing else changes") {
  const ScalarField field = noisy();
  for (const MakeMethod make : kIterative) {
    std::vector<int> told;
    std::vector<double> third;
    core::MethodContext context;
    const auto tell = [&](int iteration, const ScalarField& passed) {
      told.push_back(iteration);
      if (iteration == 3) third = values_of(passed);
      return true;
    };
    context.on_iteration = {tell, [](int iteration) { return iteration % 3 == 0; }};
    const core::MethodResult watched = run(make, field, {{"iterations", "7"}}, context);
    CHECK(told == std::vector<int>{3, 6});
    CHECK(third == values_of(run(make, field, {{"iterations", "3"}}).field));
    CHECK(values_of(watched.field) == values_of(run(make, field, {{"iterations", "7"}}).field));
    CHECK(iterations_run(watched) == 7);
  }
}

TEST_CASE("iterations that nothing looks at need no field") {
  const ScalarField input = noisy(1);
  const auto needed = [&](const core::MethodContext& context, const StopCriteria& criteria) {
    std::vector<int> numbers;
    IterationControl control(input, criteria, context);
    while (control.more()) {
      if (!control.needs_field()) {
        control.skip();
        continue;
      }
      numbers.push_back(control.iterations_run() + 1);
      control.record(halved(control.field().values()));
    }
    return numbers;
  };
  using Numbers = std::vector<int>;
  const auto go_on = [](int, const ScalarField&) { return true; };
  core::MethodContext some;
  some.on_iteration = {go_on, [](int iteration) { return iteration == 2; }};
  core::MethodContext all;
  all.on_iteration = go_on;
  CHECK(needed({}, {.iterations = 4}) == Numbers{4});
  CHECK(needed(some, {.iterations = 4}) == Numbers{2, 4});
  CHECK(needed(all, {.iterations = 4}) == Numbers{1, 2, 3, 4});
  CHECK(needed({.count_iterations = true}, {.iterations = 2}) == Numbers{1, 2});
  CHECK(needed({}, {.iterations = 2, .until_change = 0}) == Numbers{1, 2});
}

TEST_CASE("a callback of iterations tells those that are wanted") {
  const ScalarField field = noisy(1);
  const core::IterationCallback none;
  CHECK_FALSE(none);
  CHECK_FALSE(none.wants(1));
  CHECK(none(1, field));
  const auto end = [](int, const ScalarField&) { return false; };
  const core::IterationCallback all = end;
  CHECK(all);
  CHECK(all.wants(1));
  CHECK_FALSE(all(1, field));
  const core::IterationCallback second(end, [](int iteration) { return iteration == 2; });
  CHECK_FALSE(second.wants(1));
  CHECK(second(1, field));
  CHECK_FALSE(second(2, field));
}

TEST_CASE("conditions to stop are checked when the method is made") {
  const ScalarField field = noisy(1);
  const Given bad = {{"iterations", "-1"},  {"until-count", "-1"},   {"until-count", "few"},
                     {"until-stable", "1"}, {"until-stable", "1.5"}, {"until-change", "-1"},
                     {"until-change", "2"}, {"until-change", "1%"}};
  for (const MakeMethod make : kIterative)
    for (const auto& [key, value] : bad) {
      INFO(key << "=" << value);
      CHECK_THROWS_AS(run(make, field, {{key, value}}), core::InvalidArgument);
      CHECK_THROWS_WITH(run(make, field, {{key, value}}), Catch::Contains("method:" + key));
    }
  const core::MethodContext context;
  CHECK_THROWS_AS(IterationControl(field, {.iterations = -1}, context), core::InvalidArgument);
  CHECK_THROWS_AS(IterationControl(field, {.until_stable = 1}, context), core::InvalidArgument);
  CHECK_THROWS_AS(IterationControl(field, {.until_change = 1.5}, context), core::InvalidArgument);
}
